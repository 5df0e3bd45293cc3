"""Recursive least squares: what the batch says, what is held, and errors as large as their deviations say."""

import numpy as np
import pytest
from scipy.stats import chi2

from pdr_core.gait.least_squares import LeastSquares
from pdr_core.records import Floats

TRUE = np.array([0.4, 0.2])
PRIOR, PRIOR_SD = np.array([0.0, 0.1]), np.array([1.0, 0.2])


def fitted(
    terms: Floats, values: Floats, sd: float = 0.1, weights_count: float = 1e9, prior_sd: Floats = PRIOR_SD
) -> LeastSquares:
    squares = LeastSquares(PRIOR, prior_sd, weights_count)
    for row, value in zip(terms, values, strict=True):
        squares.add(row, value, sd)
    return squares


def drawn(seed: int, count: int = 30, spread: float = 1.0) -> Floats:
    return np.column_stack([np.ones(count), 4.0 + spread * np.random.default_rng(seed).standard_normal(count)])


def test_it_is_the_batch_solution() -> None:
    terms = drawn(1)
    values = terms @ TRUE + 0.05 * np.random.default_rng(2).standard_normal(len(terms))
    estimate = fitted(terms, values, prior_sd=np.array([1e6, 1e6])).estimate()
    batch, (squares,), *_ = np.linalg.lstsq(terms, values, rcond=None)
    assert estimate.coefficients == pytest.approx(batch, abs=1e-6)
    assert estimate.residual_sd == pytest.approx(np.sqrt(squares / (len(terms) - 2)), rel=1e-6)


def test_without_noise_it_finds_the_truth() -> None:
    terms = drawn(3)
    estimate = fitted(terms, terms @ TRUE, sd=1e-4).estimate()
    assert estimate.coefficients == pytest.approx(TRUE, abs=1e-5)
    assert not estimate.held.any()


@pytest.mark.parametrize("spread", [0.0, 1e-3])
def test_terms_that_do_not_vary_are_held(spread: float) -> None:
    terms = drawn(4, spread=spread)
    estimate = fitted(terms, terms @ TRUE).estimate()
    assert estimate.held.tolist() == [False, True]
    assert estimate.coefficients[1] == PRIOR[1]
    assert terms[0] @ estimate.coefficients == pytest.approx(terms[0] @ TRUE, abs=0.01)  # the other makes up for it


def test_one_that_varies_enough_is_free_again() -> None:
    terms = np.concatenate([drawn(5, spread=0.0), drawn(5)])
    assert not fitted(terms, terms @ TRUE).estimate().held.any()


def test_one_that_hardly_varies_is_told_by_many_who_scatter_little() -> None:
    """A hundredth of its size: the condition number of the terms themselves is 400."""
    terms = drawn(6, count=400, spread=0.04)
    values = terms @ TRUE + 0.01 * np.random.default_rng(16).standard_normal(len(terms))
    assert fitted(terms[:20], values[:20]).estimate().held.tolist() == [False, True]
    told = fitted(terms, values, weights_count=0.01).estimate()  # they scatter by a tenth of what is said
    assert not told.held.any()
    assert told.coefficients[1] == pytest.approx(TRUE[1], abs=3.0 * told.covariance[1, 1] ** 0.5)
    assert told.covariance[1, 1] ** 0.5 == pytest.approx(0.01 / (0.04 * 20.0), rel=0.15)


def test_nothing_observed_is_the_prior() -> None:
    estimate = LeastSquares(PRIOR, PRIOR_SD, 30.0).estimate()
    assert estimate.coefficients.tolist() == PRIOR.tolist()
    assert np.isnan(estimate.residual_sd)


def test_errors_are_as_large_as_the_covariance_says() -> None:
    squared = []
    for seed in range(200):
        rng = np.random.default_rng([seed, 7])
        true, terms = PRIOR + PRIOR_SD * rng.standard_normal(2), drawn(seed, count=8)
        values = terms @ true + 0.1 * rng.standard_normal(len(terms))
        estimate = fitted(terms, values).estimate()
        error = estimate.coefficients - true
        squared.append(error @ np.linalg.solve(estimate.covariance, error))
    low, high = chi2.ppf([0.005, 0.995], 2 * len(squared))
    assert low < np.sum(squared) < high

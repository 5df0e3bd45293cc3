"""The four states of paper 004: transition, measurement, and whether the covariance is true."""

import numpy as np
import pytest
from scipy.stats import chi2

from pdr_core.fusion.heading_error import DRIFT, SIZE, TURN, HeadingError, transition

RNG = np.random.default_rng(1)


def track(error, heading_rad, length_m, duration_s):
    """Return the errors (4,) after a stride whose estimated heading is given: eq. 8 for the estimate and the truth."""
    estimated = length_m * np.array([np.cos(heading_rad), np.sin(heading_rad)])
    true_rad = heading_rad - error[TURN]
    true = length_m * np.array([np.cos(true_rad), np.sin(true_rad)])
    return np.array([*(error[:2] + estimated - true), error[TURN] + duration_s * error[DRIFT], error[DRIFT]])


def test_the_transition_is_the_derivative_of_a_stride():
    for heading_rad, length_m, duration_s in RNG.uniform([-3.1, 0.2, 0.5], [3.1, 2.0, 1.5], (20, 3)):
        displacement_m = length_m * np.array([np.cos(heading_rad), np.sin(heading_rad), 0.1])
        moved = [
            (track(e, heading_rad, length_m, duration_s) - track(-e, heading_rad, length_m, duration_s)) / 2e-5
            for e in 1e-5 * np.eye(SIZE)
        ]
        assert transition(displacement_m, duration_s) == pytest.approx(np.array(moved).T, abs=1e-8)


def test_without_noise_the_truth_is_found():
    found, truth = HeadingError(0.0, 1.0, 0.01, 0.0), np.array([0.0, 0.0, 0.2, 0.002])
    for _ in range(30):
        displacement_m = 1.4 * np.array([np.cos(0.5), np.sin(0.5)])
        truth = transition(displacement_m, 1.1) @ truth
        found.predict(displacement_m, 1.1)
        found.measure(truth[TURN], 1e-12)
    assert found.error == pytest.approx(truth, abs=1e-5)
    assert found.turn_before(33.0)[0] == pytest.approx(0.2, abs=1e-5)


def test_the_covariance_is_that_of_the_errors():
    runs, freedom, squares = 200, SIZE, []
    for _ in range(runs):
        truth = RNG.standard_normal(SIZE) * [0.0, 0.0, 0.1, 0.002]
        found = HeadingError(0.0, 0.1**2, 0.002, 0.003)
        for _ in range(25):
            displacement_m = RNG.normal([1.3, 0.3], 0.1)
            truth = transition(displacement_m, 1.1) @ truth
            truth[TURN] += 0.003 * RNG.standard_normal()
            found.predict(displacement_m, 1.1)
            found.measure(truth[TURN] + 0.02 * RNG.standard_normal(), 0.02**2)
        error = truth - found.error
        squares.append(error @ np.linalg.solve(found.P, error))
    low, high = chi2.ppf([0.025, 0.975], runs * freedom) / runs
    assert low < np.mean(squares) < high


def test_half_turns_of_half_a_difference_are_the_same():
    found = HeadingError(1.5, 0.1**2, 0.0, 0.0)
    found.measure(-1.6, 0.01**2)
    assert found.turn_rad == pytest.approx(np.pi - 1.6, abs=0.01)

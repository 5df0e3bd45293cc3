import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import chi2

from pdr_core.maths import kalman, vector

SEEDS = st.integers(0, 2**32 - 1)


def problem(seed, n=15, m=3):
    rng = np.random.default_rng(seed)
    A, B = rng.standard_normal((n, n)), rng.standard_normal((m, m))
    P, R = A @ A.T + 1e-3 * np.eye(n), B @ B.T + 1e-3 * np.eye(m)
    return P, rng.standard_normal((m, n)), R, rng.standard_normal(m), rng.standard_normal((n, m))


def joseph(P, H, R, K):
    rest = np.eye(len(P)) - K @ H
    return rest @ P @ rest.T + K @ R @ K.T


@given(SEEDS, st.lists(st.integers(0, 14), max_size=15))
def test_the_correction_is_josephs_form_for_any_gain(seed, zero_rows):
    P, H, R, residual, K = problem(seed)
    K[zero_rows] = 0.0
    expected, corrected = joseph(P, H, R, K), P.copy()
    kalman.correct(corrected, K, kalman.innovation(P, H, R, residual))
    np.testing.assert_allclose(corrected, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
    assert np.array_equal(corrected, corrected.T)
    assert np.linalg.eigvalsh(corrected)[0] > -1e-10 * np.abs(corrected).max()


@given(SEEDS)
def test_with_the_optimal_gain_it_is_the_short_form(seed):
    P, H, R, residual, _ = problem(seed)
    y = kalman.innovation(P, H, R, residual)
    K = kalman.gain(y)
    np.testing.assert_allclose(K, P @ H.T @ np.linalg.inv(H @ P @ H.T + R), rtol=1e-7, atol=1e-7)
    corrected = P.copy()
    kalman.correct(corrected, K, y)
    np.testing.assert_allclose(corrected, (np.eye(15) - K @ H) @ P, atol=1e-8 * np.abs(P).max())


@given(SEEDS)
def test_the_estimated_error_and_the_cross_covariance_are_plain_products(seed):
    P, H, R, residual, K = problem(seed)
    C = np.random.default_rng(seed + 1).standard_normal((15, 6))
    expected = (np.eye(15) - K @ H) @ C
    np.testing.assert_allclose(
        kalman.estimated_error(K, kalman.innovation(P, H, R, residual)), K @ residual, atol=1e-12
    )
    kalman.correct_cross(C, K, H @ C)
    np.testing.assert_allclose(C, expected, atol=1e-11)


@given(SEEDS)
def test_normalising_the_innovation(seed):
    P, H, R, residual, _ = problem(seed)
    y = kalman.innovation(P, H, R, residual)
    expected = residual @ np.linalg.solve(H @ P @ H.T + R, residual)
    assert kalman.normalised_squared(y) == pytest.approx(expected, rel=1e-8)


def test_the_normalised_innovation_is_chi_square_distributed():
    P, H, R, _, _ = problem(3)
    draws = np.random.default_rng(4).multivariate_normal(np.zeros(3), H @ P @ H.T + R, 4000)
    values = [kalman.normalised_squared(kalman.innovation(P, H, R, draw)) for draw in draws]
    assert np.mean(values) == pytest.approx(3.0, abs=4 * np.sqrt(6 / 4000))
    assert np.mean(np.array(values) > chi2.ppf(0.95, 3)) == pytest.approx(0.05, abs=0.015)


@given(SEEDS)
def test_small_vectors_and_matrices(seed):
    rng = np.random.default_rng(seed)
    A, B, u, v = rng.standard_normal((3, 3)), rng.standard_normal((3, 5)), *rng.standard_normal((2, 3))
    np.testing.assert_allclose(vector.cross(u, v), np.cross(u, v), atol=1e-14)
    np.testing.assert_allclose(vector.transposed(A), A.T)
    np.testing.assert_allclose(vector.rotated(A, v), A @ v, atol=1e-14)
    np.testing.assert_allclose(vector.product(A, B), A @ B, atol=1e-14)
    np.testing.assert_allclose(vector.mean(u, v), (u + v) / 2)
    np.testing.assert_allclose(vector.difference(u, v), u - v)
    assert vector.norm(u) == pytest.approx(np.linalg.norm(u))


@given(SEEDS, st.integers(1, 6))
def test_the_inverse_of_a_covariance_is_its_inverse(seed, size):
    A = np.random.default_rng(seed).standard_normal((size, size))
    S = A @ A.T + 0.1 * np.eye(size)
    np.testing.assert_allclose(vector.inverse_positive(S) @ S, np.eye(size), atol=1e-9)

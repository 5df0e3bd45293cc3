"""The smoother's algebra on small linear systems, for which everything can be written down at once."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.maths.kalman import correct, estimated_error, gain, innovation, smoothed, smoother_gain
from pdr_core.maths.vector import solve_positive

SEEDS = st.integers(0, 2**32 - 1)
SIZE, SHOWN, SAMPLES = 5, 2, 8


class System:
    """x' = F x + w; z = H x + v."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.F = np.eye(SIZE) + 0.3 * rng.standard_normal((SIZE, SIZE))
        self.H = rng.standard_normal((SHOWN, SIZE))
        self.Q, self.R, self.P0 = (np.diag(rng.uniform(0.2, 2.0, n)) for n in (SIZE, SHOWN, SIZE))


def optimal(K):
    return K


def leaving_alone(K):
    """A gain as a stance has it: some errors are not corrected."""
    K = K.copy()
    K[-2:] = 0.0
    return K


def both_ways(system, z, chosen):
    """Return the smoothed estimates, their covariances and the gains C; z (samples, shown)."""
    x, P, passes = np.zeros(SIZE), system.P0.copy(), []
    for k, shown in enumerate(z):
        cross = system.F @ P
        if k:
            x, P = system.F @ x, system.F @ P @ system.F.T + system.Q
        y = innovation(P, system.H, system.R, shown - system.H @ x)
        K, P_before, x_before = chosen(gain(y)), P.copy(), x
        x = x + estimated_error(K, y)
        correct(P, K, y)
        passes.append((x, P.copy(), x_before, P_before, cross))
    xs, Ps, Cs = [x], [P], []
    for (x, P, *_), (_, _, x_before, P_before, cross) in zip(passes[-2::-1], passes[:0:-1], strict=True):
        C = smoother_gain(cross, P_before)
        xs.append(x + C @ (xs[-1] - x_before))
        smoothed(P, C, P_before, Ps[-1])
        Ps.append(P)
        Cs.append(C)
    return np.array(xs[::-1]), np.array(Ps[::-1]), Cs[::-1]


def least_squares(system, z):
    """Return all states at once, by least squares, and their covariance."""
    n = SIZE * len(z)
    information, right = np.zeros((n, n)), np.zeros(n)
    information[:SIZE, :SIZE] += np.linalg.inv(system.P0)
    for k, shown in enumerate(z):
        here = slice(SIZE * k, SIZE * (k + 1))
        information[here, here] += system.H.T @ np.linalg.solve(system.R, system.H)
        right[here] += system.H.T @ np.linalg.solve(system.R, shown)
        if k:
            J = np.zeros((SIZE, n))
            J[:, here], J[:, SIZE * (k - 1) : SIZE * k] = np.eye(SIZE), -system.F
            information += J.T @ np.linalg.solve(system.Q, J)
    covariance = np.linalg.inv(information)
    return (covariance @ right).reshape(len(z), SIZE), covariance


def block(covariance, a, b):
    return covariance[SIZE * a : SIZE * (a + 1), SIZE * b : SIZE * (b + 1)]


def errors_of(system, chosen):
    """Return the covariance of all smoothed errors, from what each source of error alone does to them."""
    deviations = np.sqrt(np.concatenate([np.diag(system.P0), *[np.diag(system.Q), np.diag(system.R)] * SAMPLES]))
    effects = []
    for i, deviation in enumerate(deviations):
        noise = np.zeros(len(deviations))
        noise[i] = deviation
        x, steps = noise[:SIZE], noise[SIZE:].reshape(SAMPLES, SIZE + SHOWN)
        true, z = [], []
        for k, step in enumerate(steps):
            x = system.F @ x + step[:SIZE] if k else x
            true.append(x)
            z.append(system.H @ x + step[SIZE:])
        effects.append((np.array(true) - both_ways(system, np.array(z), chosen)[0]).ravel())
    return np.array(effects).T @ np.array(effects)


@given(SEEDS)
def test_with_optimal_gains_it_is_the_least_squares_of_all(seed):
    system = System(seed)
    z = np.random.default_rng(seed + 1).standard_normal((SAMPLES, SHOWN))
    x, P, _ = both_ways(system, z, optimal)
    expected, covariance = least_squares(system, z)
    np.testing.assert_allclose(x, expected, atol=1e-9)
    for k in range(SAMPLES):
        np.testing.assert_allclose(P[k], block(covariance, k, k), atol=1e-9)


@pytest.mark.parametrize("chosen", [optimal, leaving_alone])
@pytest.mark.parametrize("seed", range(5))
def test_with_any_gain_the_covariance_is_that_of_the_errors(seed, chosen):
    system = System(seed)
    covariance = errors_of(system, chosen)
    _, P, C = both_ways(system, np.zeros((SAMPLES, SHOWN)), chosen)
    for a in range(SAMPLES):
        together = P[-1]
        for k in range(SAMPLES - 2, a - 1, -1):
            together = C[k] @ together
        np.testing.assert_allclose(P[a], block(covariance, a, a), atol=1e-9)
        np.testing.assert_allclose(together, block(covariance, a, SAMPLES - 1), atol=1e-9)


@given(SEEDS, st.integers(1, 15))
def test_solving_with_a_covariance(seed, size):
    rng = np.random.default_rng(seed)
    A, B = rng.standard_normal((size, size)), rng.standard_normal((size, 3))
    S, found = A @ A.T + 0.1 * np.eye(size), B.copy()
    solve_positive(S, found)
    np.testing.assert_allclose(S @ found, B, atol=1e-9)


def test_errors_of_any_size_and_a_certain_one():
    sd = np.array([1e6, 1e-7, 0.0, 1.0])
    P = np.outer(sd, sd) * (np.eye(4) + 0.5) / 1.5
    C = smoother_gain(P.copy(), P)
    assert (np.abs(C * sd - np.diag(sd)) <= 1e-9 * sd[:, None]).all()

"""Feet are never farther apart than legs reach."""

import numpy as np
import pytest

from pdr_core.fusion.separation import Reach, nearest_within, place_error

REACH = Reach(plan_m=1.0, height_m=0.5, sd_m=0.01)
RNG = np.random.default_rng(3)


def covariance():
    A = RNG.standard_normal((3, 3)) * [[0.3], [0.2], [0.1]]
    return A @ A.T + 1e-4 * np.eye(3)


def corrected(error, P):
    """Return by how much a filter of covariance P moves the place it is told the error of, and what it thinks then."""
    S = P + error.covariance_m2
    return -P @ np.linalg.solve(S, error.error_m), P - P @ np.linalg.solve(S, P)


def test_no_place_on_the_surface_is_more_likely():
    for _ in range(20):
        P, apart_m = covariance(), RNG.uniform(-1, 1, 3)
        apart_m *= RNG.uniform(1.1, 5.0) / np.sqrt(apart_m @ REACH.E @ apart_m)
        found, W = nearest_within(apart_m, P, REACH), np.linalg.inv(P)
        assert found @ REACH.E @ found == pytest.approx(1.0, abs=1e-9)
        others = found + RNG.standard_normal((500, 3)) * np.geomspace(1e-4, 1.0, 500)[:, None]
        others /= np.sqrt(np.einsum("ij,jk,ik->i", others, REACH.E, others))[:, None]
        away = np.einsum("ij,jk,ik->i", others - apart_m, W, others - apart_m)
        assert (away >= (found - apart_m) @ W @ (found - apart_m) - 1e-9).all()


def test_feet_within_reach_are_left_alone():
    for _ in range(100):
        apart_m = RNG.uniform(-1, 1, 3)
        apart_m *= RNG.uniform(0.0, 1.0) / np.sqrt(apart_m @ REACH.E @ apart_m)
        assert place_error(apart_m, covariance(), covariance(), REACH) is None


def test_nan_is_left_alone():
    assert place_error(np.array([np.nan, 3.0, 0.0]), np.eye(3), np.eye(3), REACH) is None


def test_feet_that_are_too_far_apart_come_within_reach_and_nearer_to_the_truth():
    """Both feet move together, each by its share; the true places are within reach."""
    before, after = [], []
    for _ in range(200):
        P_left, P_right = covariance(), covariance()
        true_m = RNG.uniform(-0.4, 0.4, 3) * [1, 1, 0.5]
        errors = [RNG.multivariate_normal(np.zeros(3), P) for P in (P_left, P_right)]
        apart_m = true_m + errors[0] - errors[1]
        told = place_error(apart_m, P_left, P_right, REACH)
        if told is None:
            continue
        other = place_error(-apart_m, P_right, P_left, REACH)
        moved_left, _ = corrected(told, P_left)
        moved_right, _ = corrected(other, P_right)
        nearer = apart_m + moved_left - moved_right
        assert nearer @ REACH.E @ nearer < 1.1
        before.append(np.linalg.norm(apart_m - true_m))
        after.append(np.linalg.norm(nearer - true_m))
        W = np.linalg.inv(P_left + P_right)
        assert (nearer - true_m) @ W @ (nearer - true_m) <= (apart_m - true_m) @ W @ (apart_m - true_m) + 1e-9
    assert len(before) > 20
    assert np.mean(after) < 0.8 * np.mean(before)


def test_nothing_is_told_of_directions_along_the_surface():
    P = np.diag([0.2, 0.1, 0.05])
    told = place_error(np.array([2.0, 0.0, 0.0]), P, P, REACH)
    moved_m, left = corrected(told, P)
    assert moved_m == pytest.approx([-0.5, 0.0, 0.0], abs=0.01)
    assert left[1, 1] == pytest.approx(P[1, 1], rel=1e-3)

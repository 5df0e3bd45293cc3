import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from pdr_core.evaluation import alignment, metrics

CORNERS_M = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 1.0], [4.0, 3.0, 1.0], [0.0, 3.0, 0.0]])
coordinate = st.floats(-50, 50)


def moved(points, yaw_rad, shift):
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return points @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T + shift


@given(yaw=st.floats(-3.1, 3.1), x=coordinate, y=coordinate, z=coordinate)
def test_a_known_turn_and_shift_is_recovered_by_both_alignments(yaw, x, y, z):
    truth = moved(CORNERS_M, yaw, [x, y, z])
    for found in (alignment.over_whole(CORNERS_M, truth), alignment.at_start(CORNERS_M, truth, 3.0)):
        assert found.yaw_rad == pytest.approx(yaw, abs=1e-9)
        np.testing.assert_allclose(found.apply(CORNERS_M), truth, atol=1e-9)
    assert metrics.ate2_m(CORNERS_M, truth) == pytest.approx(0, abs=1e-9)
    assert metrics.ate3_m(CORNERS_M, truth) == pytest.approx(0, abs=1e-9)
    assert metrics.end_error_percent(CORNERS_M, truth) == pytest.approx(0, abs=1e-9)


def test_alignment_keeps_two_dimensions_two():
    found = alignment.over_whole(CORNERS_M[:, :2], CORNERS_M[:, :2] + 1.0)
    np.testing.assert_allclose(found.apply(CORNERS_M[:, :2]), CORNERS_M[:, :2] + 1.0)


def test_a_track_ten_percent_too_long():
    """On a straight line of 0, 1 .. 10 m the aligned errors are 0.1 (x - 5): rms 0.1 sqrt(10); 1 m at the end."""
    truth = np.column_stack([np.arange(11.0), np.zeros(11), np.zeros(11)])
    estimate = 1.1 * truth
    assert metrics.ate2_m(estimate, truth) == pytest.approx(0.1 * math.sqrt(10))
    assert metrics.end_error_m(estimate, truth) == pytest.approx(1.0)
    assert metrics.end_error_percent(estimate, truth) == pytest.approx(10.0)


def test_a_constant_sideways_ripple_is_its_own_size():
    """Errors of +-0.2 m across a line, too regular for any turn to help: ATE2 0.2 m, no division by sqrt(2)."""
    x = np.arange(8.0)
    truth = np.column_stack([x, 0 * x, 0 * x])
    estimate = truth + np.outer([1, -1, -1, 1, 1, -1, -1, 1], [0, 0.2, 0])
    assert metrics.ate2_m(estimate, truth) == pytest.approx(0.2, rel=1e-12)


def test_height_errors_count_only_in_three_dimensions_and_without_their_mean():
    estimate = CORNERS_M + np.array([0, 0, 7.0]) + np.outer([1, -1, 1, -1], [0, 0, 0.3])
    assert metrics.ate2_m(estimate, CORNERS_M) == pytest.approx(0, abs=1e-12)
    assert metrics.ate3_m(estimate, CORNERS_M) == pytest.approx(0.3)


def test_end_error_uses_only_the_first_metres_for_the_yaw():
    """A right angle turned by 0.1 rad after the first 4 m moves the end by a chord of 2 * 3 m * sin(0.05)."""
    truth = np.array([[0.0, 0], [2, 0], [4, 0], [4, 3]])
    estimate = np.array([[0.0, 0], [2, 0], [4, 0], [4 - 3 * math.sin(0.1), 3 * math.cos(0.1)]])
    assert metrics.end_error_m(estimate, truth, 3.0) == pytest.approx(6 * math.sin(0.05))
    assert metrics.end_error_m(estimate, truth, 100.0) < 6 * math.sin(0.05)


def test_closure_and_path():
    assert metrics.closure_2d_m(np.zeros(3), np.array([3.0, 4.0, 12.0])) == 5.0
    assert metrics.closure_3d_m(np.zeros(3), np.array([3.0, 4.0, 12.0])) == 13.0
    assert metrics.path_length_m(CORNERS_M) == 11.0


def test_stride_distance_is_horizontal(make):
    assert metrics.stride_distance_m(make.steps_at(CORNERS_M)) == pytest.approx(11.0)


def test_nothing_to_compare_is_nan():
    one = np.zeros((1, 3))
    values = [f(one, one) for f in (metrics.ate2_m, metrics.ate3_m, metrics.end_error_m, metrics.end_error_percent)]
    assert np.isnan(values).all()
    assert math.isnan(metrics.end_error_percent(np.zeros((5, 3)), np.zeros((5, 3))))


def test_ate_equals_a_brute_force_search():
    """The same figure by searching the yaw numerically, the shift being the mean of what is left."""
    rng = np.random.default_rng(3)
    truth = np.cumsum(rng.normal(0, 1, (200, 3)), axis=0)
    estimate = moved(truth + np.cumsum(rng.normal(0, 0.2, truth.shape), axis=0), 2.0, [5, -3, 2])

    def rmse(yaw, axes):
        left = (moved(estimate, yaw, 0) - truth)[:, :axes]
        return np.sqrt(np.mean(np.sum((left - left.mean(axis=0)) ** 2, axis=1)))

    grid = np.linspace(-np.pi, np.pi, 721)
    best = grid[np.argmin([rmse(yaw, 2) for yaw in grid])]
    yaw = minimize_scalar(rmse, bounds=(best - 0.01, best + 0.01), args=(2,), options={"xatol": 1e-10}).x
    assert metrics.ate2_m(estimate, truth) == pytest.approx(rmse(yaw, 2), rel=1e-9)
    assert metrics.ate3_m(estimate, truth) == pytest.approx(rmse(yaw, 3), rel=1e-6)

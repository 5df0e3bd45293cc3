"""I am at A, later I am at B: the map's frame from two points, and its covariance."""

import numpy as np
import pytest
from scipy.stats import chi2

from pdr_core.external.known_points import between_known_points, corrected, grown_since
from pdr_core.maths.circular import wrapped_rad
from pdr_core.records_external import about_up, lever

OURS_M = np.array([[1.0, 2.0, 0.0], [21.0, -3.0, 0.1]])
TURN_RAD, SHIFT_M = 2.5, np.array([100.0, 50.0, 7.0])
MAP_M = OURS_M @ about_up(TURN_RAD).T + SHIFT_M


def test_two_points_fix_place_and_heading():
    frame = between_known_points(OURS_M, np.zeros((2, 2)), MAP_M, 0.1)
    assert frame.yaw_rad == pytest.approx(TURN_RAD)
    np.testing.assert_allclose(frame.theirs_m(OURS_M), MAP_M, atol=1e-9)
    np.testing.assert_allclose(frame.ours_m(MAP_M), OURS_M, atol=1e-9)


def test_the_covariance_is_honest():
    """NEES of the yaw, and the squares of the middle, over 400 draws of points and ways."""
    rng, squares, point_sd_m = np.random.default_rng(5), [], 0.2
    way_m2 = np.array([[0.09, 0.03], [0.03, 0.16]])
    for _ in range(400):
        said_m = MAP_M + point_sd_m * np.append(rng.standard_normal((2, 2)), np.zeros((2, 1)), axis=1)
        walked_m = OURS_M.copy()
        error_m = rng.multivariate_normal(np.zeros(2), way_m2)
        walked_m[0, :2] -= 0.5 * error_m  # the way is wrong by this: half at each end
        walked_m[1, :2] += 0.5 * error_m
        frame = between_known_points(walked_m, way_m2, said_m, point_sd_m)
        middle_m = 0.5 * (OURS_M[0] + OURS_M[1])
        off_m = (frame.theirs_m(middle_m) - middle_m @ about_up(TURN_RAD).T - SHIFT_M)[:2]
        squares.append([wrapped_rad(frame.yaw_rad - TURN_RAD) ** 2 / frame.covariance[2, 2], off_m @ off_m])
    low, high = chi2.ppf([0.025, 0.975], 400) / 400
    yaw, off_m2 = np.mean(squares, axis=0)
    assert low < yaw < high
    assert off_m2 == pytest.approx(2 * 0.5 * point_sd_m**2, rel=0.15)  # the way's halves cancel here


def drawn_walk(rng, points_m, point_sd_m, yaw_step_rad, step_m):
    """Places of a track that drifts between points: what it shows, what it has lost since the start, and the map."""
    pose, covariance, turn = np.zeros(2), np.zeros((3, 3)), 0.0
    shown, lost = [np.zeros(3)], [covariance]
    for way_m in np.diff(points_m[:, :2], axis=0):
        for _ in range(20):
            moved = about_up(turn)[:2, :2] @ (way_m / 20.0) + step_m * rng.standard_normal(2)
            T = lever(moved)
            covariance = T @ covariance @ T.T + np.diag([step_m**2, step_m**2, yaw_step_rad**2])
            pose, turn = pose + moved, turn + yaw_step_rad * rng.standard_normal()
        shown.append(np.append(pose, 0.0))
        lost.append(covariance)
    map_m = points_m @ about_up(TURN_RAD).T + SHIFT_M
    map_m[:, :2] += point_sd_m * rng.standard_normal((len(points_m), 2))
    return np.array(shown), lost, map_m, turn


def test_more_points_correct_place_and_heading_and_the_covariance_is_honest():
    """NEES of x, y and yaw of the person on the map after four points, over 400 walks, between both 99.9 % bounds."""
    rng, squares, point_sd_m = np.random.default_rng(2), [], 0.2
    points_m = np.array([[0.0, 0.0, 0.0], [30.0, 0.0, 0.0], [30.0, 25.0, 0.0], [5.0, 25.0, 0.0]])
    for _ in range(400):
        ours_m, lost, map_m, turned_rad = drawn_walk(rng, points_m, point_sd_m, 0.003, 0.02)
        ways = [grown_since(lost[i], lost[i + 1], (ours_m[i + 1] - ours_m[i])[:2]) for i in range(3)]
        frame = between_known_points(ours_m[:2], ways[0][:2, :2], map_m[:2], point_sd_m)
        frame.covariance[2, 2] += ways[0][2, 2]
        for i in (1, 2):
            frame = corrected(frame, ours_m[i + 1], ways[i], map_m[i + 1], point_sd_m, 1e9)
        off = np.append(
            (frame.theirs_m(ours_m[3]) - points_m[3] @ about_up(TURN_RAD).T - SHIFT_M)[:2],
            wrapped_rad(frame.yaw_rad + turned_rad - TURN_RAD),
        )
        squares.append(off @ np.linalg.solve(frame.pose_covariance(ours_m[3]), off))
    low, high = chi2.ppf([0.0005, 0.9995], 3 * 400) / 400
    assert low < np.mean(squares) < high


def test_what_a_way_has_lost_is_what_it_adds_and_not_the_turn_that_was_there_before():
    before, grown = np.diag([0.5, 0.4, 0.01]), np.array([[0.3, 0.1, 0.0], [0.1, 0.2, 0.02], [0.0, 0.02, 0.03]])
    T = lever(np.array([20.0, -7.0]))
    np.testing.assert_allclose(grown_since(before, T @ before @ T.T + grown, np.array([20.0, -7.0])), grown, atol=1e-9)
    assert np.linalg.eigvalsh(grown_since(before, 0.5 * before, np.zeros(2)))[0] >= 0.0


def test_a_later_point_that_cannot_be_is_refused():
    frame = between_known_points(OURS_M, np.zeros((2, 2)), MAP_M, 0.1)
    with pytest.raises(ValueError, match=r"5\.0 m from where the points before have us"):
        corrected(frame, OURS_M[1], np.zeros((3, 3)), MAP_M[1] + [3.0, 4.0, 0.0], 0.1, 13.8)


@pytest.mark.parametrize(
    ("ours_m", "map_m", "words"),
    [
        (OURS_M, MAP_M * [2.0, 2.0, 1.0], "is it the right point"),
        (OURS_M * 0.01, MAP_M * 0.01, "too near to each other"),
        (OURS_M, np.repeat(MAP_M[:1], 2, axis=0), "too near to each other"),
    ],
)
def test_points_that_cannot_be_are_refused(ours_m, map_m, words):
    with pytest.raises(ValueError, match=words):
        between_known_points(ours_m, 0.01 * np.eye(2), map_m, 0.1)

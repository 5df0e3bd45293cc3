"""Their frame from a foot's world and from that of the body: the same places of theirs, whichever way."""

import numpy as np
import pytest

from pdr_core.external.worlds import ORIGIN_AND_X, from_another, midway, seen_back
from pdr_core.records_external import ExternalFrame, about_up

FRAME = ExternalFrame(2.0, np.array([5.0, 6.0, 0.5]), 7, np.eye(4), np.array([3.0, 1.0]))
FOOT_M = np.array([*ORIGIN_AND_X, [4.0, -3.0, 0.2]])
TURNS_RAD = [0.0, 1.2]


def body_m(turn_rad):
    """The same places in the world of the body."""
    return FOOT_M @ about_up(turn_rad).T + [0.0, 0.1, 0.3]


@pytest.mark.parametrize("turn_rad", TURNS_RAD)
def test_their_frame_from_the_body_is_that_of_a_foot_seen_from_there(turn_rad):
    found = from_another(FRAME, body_m(turn_rad)[:2])
    np.testing.assert_allclose(found.theirs_m(body_m(turn_rad)), FRAME.theirs_m(FOOT_M), atol=1e-12)
    np.testing.assert_allclose(found.pose_covariance(body_m(turn_rad)[2]), FRAME.pose_covariance(FOOT_M[2]), atol=1e-12)
    assert found.clock_ns == FRAME.clock_ns


@pytest.mark.parametrize("turn_rad", TURNS_RAD)
def test_there_and_back_it_is_the_same_frame(turn_rad):
    placed_m = body_m(turn_rad)[:2]
    np.testing.assert_allclose(seen_back(seen_back(placed_m)), placed_m, atol=1e-12)
    again = from_another(from_another(FRAME, placed_m), seen_back(placed_m))
    assert again.yaw_rad == pytest.approx(FRAME.yaw_rad)
    np.testing.assert_allclose(again.shift_m, FRAME.shift_m, atol=1e-12)
    np.testing.assert_allclose(again.about_m, FRAME.about_m, atol=1e-12)


def test_midway_of_two_frames_places_lie_between_and_are_no_surer():
    covariance = np.diag([0.3, 0.1, 0.02, 0.5])
    covariance[2, 3] = covariance[3, 2] = 0.05
    one = ExternalFrame(3.1, np.array([5.0, 6.0, 0.5]), 6, covariance, np.array([3.0, 1.0]))
    other = ExternalFrame(-3.1, np.array([5.4, 6.2, 0.7]), 10, covariance, np.array([5.0, 3.0]))  # turned on beyond pi
    found, about_m = midway([one, other]), np.array([4.0, 2.0, 0.0])
    between_m = 0.5 * (one.theirs_m(about_m) + other.theirs_m(about_m))
    np.testing.assert_allclose(found.theirs_m(about_m), between_m, atol=1e-12)
    assert abs(found.yaw_rad) == pytest.approx(np.pi)
    assert found.clock_ns == 8
    mean = 0.5 * (one.pose_covariance(about_m) + other.pose_covariance(about_m))
    np.testing.assert_allclose(found.pose_covariance(about_m), mean, atol=1e-12)
    assert found.clock_sd_s == pytest.approx(np.sqrt(0.5))
    assert found.covariance[2, 3] == pytest.approx(0.05)
    np.testing.assert_allclose(midway([one, one]).covariance, one.covariance, atol=1e-12)

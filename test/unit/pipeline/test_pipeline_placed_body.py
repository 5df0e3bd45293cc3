"""A body that somebody has placed: turned, shifted, and as uncertain as both say."""

import numpy as np
import pytest
from feet_cases import Together, samples

from pdr_core.maths.quaternion import from_euler, yaw_rad
from pdr_core.pipeline import PlacedBody
from pdr_core.records import PoseEstimate, joined, length, part
from pdr_core.records_external import about_up

THERE_M, TOLD = np.array([50.0, -30.0, 2.0]), np.diag([0.25, 0.16, 0.04, 1e-6, 1e-6, 0.01])
YAW_RAD = 1.9


@pytest.fixture(scope="module")
def body():
    return Together(samples(walk="straight", length_m=24.0)).body


def placed(body, quat_xyzw, at):
    stage = PlacedBody()
    before = stage.run(part(body, 0, at))
    stage.place(PoseEstimate(THERE_M, quat_xyzw, TOLD))
    return joined(
        [
            before,
            stage.run(part(body, at, at)),
            *(stage.run(part(body, i, i + 50)) for i in range(at, length(body), 50)),
        ]
    )


def test_the_way_goes_on_from_there_turned_as_a_whole(body):
    at = length(body) // 2
    nav = placed(body, np.array(from_euler(0.0, 0.0, YAW_RAD)), at)
    np.testing.assert_array_equal(nav.position_m[:at], body.position_m[:at])
    turn_rad = YAW_RAD - float(yaw_rad(body.quat_xyzw[at]))
    expected_m = THERE_M + (body.position_m[at:] - body.position_m[at]) @ about_up(turn_rad).T
    np.testing.assert_allclose(nav.position_m[at:], expected_m, atol=1e-9)
    assert float(yaw_rad(nav.quat_xyzw[at])) == pytest.approx(YAW_RAD)
    np.testing.assert_array_equal(nav.velocity_mps, body.velocity_mps)


def test_it_is_as_uncertain_as_what_was_told_and_the_way_since(body):
    at = length(body) // 2
    nav = placed(body, np.array(from_euler(0.0, 0.0, YAW_RAD)), at)
    np.testing.assert_allclose(
        nav.pose_covariance[at][np.ix_([0, 1, 5], [0, 1, 5])], np.diag([0.25, 0.16, 0.01]), atol=1e-9
    )
    last = nav.pose_covariance[-1]
    way_m = float(np.linalg.norm((nav.position_m[-1] - THERE_M)[:2]))
    across = np.array([-np.sin(YAW_RAD), np.cos(YAW_RAD)])
    assert across @ last[:2, :2] @ across > (0.1 * way_m) ** 2
    for covariance in nav.pose_covariance[at:]:
        assert np.linalg.eigvalsh(covariance)[0] > 0.0


def test_a_pose_without_a_heading_keeps_it(body):
    at = length(body) // 2
    nav = placed(body, None, at)
    np.testing.assert_allclose(nav.quat_xyzw, body.quat_xyzw, atol=1e-12)
    np.testing.assert_allclose(nav.position_m[at], THERE_M)

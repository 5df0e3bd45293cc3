from types import SimpleNamespace

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from scipy.spatial.transform import Rotation

from pdr_core.records import joined, length
from pdr_msgs.msg import FilterHealth, StanceImu, StepEvent
from pdr_nodes.convert import nav_block
from pdr_nodes.qos import STATUS
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.walks import judged, stamps, stance_messages, straight_walk

STRIDES, STRIDE_M = 3, 1.2


@pytest.fixture(scope="module", params=[0.0, 2.0, -1.2])
def walked(request):
    """What the node says of a straight walk that begins at some yaw."""
    block = judged(straight_walk(STRIDES).imu)
    with Bench(ZuptEkfNode, filter__initial_yaw_rad=request.param, node__idle_s=0.3) as bench:
        odometry, steps = bench.hear(Odometry, "odom"), bench.hear(StepEvent, "step")
        health = bench.hear(FilterHealth, "filter_health", STATUS)
        bench.feed(bench.publisher(StanceImu, "stance"), stance_messages(block))
        bench.until(lambda: len(odometry) >= length(block), "an estimate for every sample")
        bench.until(lambda: len(steps) >= STRIDES, "every step")
        bench.until(lambda: health and health[-1].samples == length(block), "the health after the last sample")
    nav = joined([nav_block(m) for m in odometry])
    return SimpleNamespace(yaw=request.param, block=block, odometry=odometry, nav=nav, steps=steps, health=health[-1])


def test_each_sample_gives_one_estimate_with_its_stamp_and_frames(walked):
    assert stamps(walked.odometry) == walked.block.imu.stamp_ns.tolist()
    assert {(m.header.frame_id, m.child_frame_id) for m in walked.odometry} == {("odom", "foot")}


def test_quaternions_are_unit(walked):
    np.testing.assert_allclose(np.linalg.norm(walked.nav.quat_xyzw, axis=1), 1.0, atol=1e-12)


@pytest.mark.parametrize("which", ["pose_covariance", "twist_covariance"])
def test_covariances_are_symmetric_and_positive(walked, which):
    covariance = getattr(walked.nav, which)
    np.testing.assert_allclose(covariance, covariance.transpose(0, 2, 1), rtol=0.0, atol=1e-15)
    smallest, largest = np.linalg.eigvalsh(covariance)[:, [0, -1]].T
    assert (smallest >= -1e-12 * largest).all()
    assert (largest[-1] > 0.0).all()


def swinging(walked):
    """The middle of every swing, where the foot is fast."""
    return np.linalg.norm(walked.nav.velocity_mps, axis=1) > 1.0


def test_the_twist_is_in_the_foot_frame(walked):
    velocity = walked.nav.velocity_mps[swinging(walked)]
    assert len(velocity) > 50
    assert (velocity[:, 0] > 0.5).all()
    assert np.abs(velocity[:, 1]).max() < 0.05


def test_the_twist_is_the_derivative_of_the_pose(walked):
    nav = walked.nav
    centre = Rotation.from_quat(nav.quat_xyzw[1:-1]).apply(nav.velocity_mps[1:-1])
    slope = (nav.position_m[2:] - nav.position_m[:-2]) / 0.02
    fast = swinging(walked)[1:-1]
    np.testing.assert_allclose(centre[fast], slope[fast], atol=0.05)


def test_every_stride_is_a_step_along_the_yaw(walked):
    assert [s.index for s in walked.steps] == [1, 2, 3]
    lengths = [s.length for s in walked.steps]
    np.testing.assert_allclose(lengths, STRIDE_M, rtol=0.02)
    off = [np.angle(np.exp(1j * (s.heading - walked.yaw))) for s in walked.steps]
    np.testing.assert_allclose(off, 0.0, atol=0.02)
    assert all(s.start == before.header.stamp for before, s in zip(walked.steps, walked.steps[1:], strict=False))
    assert {(s.header.frame_id, s.child_frame_id) for s in walked.steps} == {("odom", "foot")}


def test_health_describes_the_walk(walked):
    health = walked.health
    assert health.state == FilterHealth.STATE_NAVIGATING
    assert (health.header.frame_id, health.child_frame_id) == ("odom", "foot")
    assert health.header.stamp == walked.odometry[-1].header.stamp
    assert 0.9 < health.nav_quality <= 1.0
    assert health.zero_velocity_updates > 300
    assert health.gravity == pytest.approx(9.8, abs=0.2)
    assert 0.0 < health.position_stddev < 0.5

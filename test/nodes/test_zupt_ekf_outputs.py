import numpy as np
import pytest
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from pdr_core.records import joined, length, part
from pdr_msgs.msg import FilterHealth, StanceImu
from pdr_nodes.convert import nav_block
from pdr_nodes.qos import STATUS
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.walks import judged, stamps, stance_messages, straight_walk


def test_no_transform_unless_it_is_asked_for():
    messages = stance_messages(part(judged(straight_walk(1).imu), 0, 50))
    with Bench(ZuptEkfNode) as bench:
        odometry = bench.hear(Odometry, "odom")
        bench.feed(bench.publisher(StanceImu, "stance"), messages)
        bench.until(lambda: len(odometry) == 50, "estimates")
        assert bench.me.count_publishers("odom") == 1
        assert bench.me.count_publishers("/tf") == 0


def test_the_transform_is_the_pose():
    messages = stance_messages(part(judged(straight_walk(1).imu), 0, 400))
    with Bench(ZuptEkfNode, node__publish_tf=True, node__world_frame="map", node__foot_frame="l_sole") as bench:
        odometry, transforms = bench.hear(Odometry, "odom"), bench.hear(TFMessage, "/tf", 1000)
        bench.until(lambda: bench.me.count_publishers("/tf") == 1, "a broadcaster")
        bench.feed(bench.publisher(StanceImu, "stance"), messages)
        bench.until(lambda: len(odometry) == len(transforms) == 400, "a transform for every estimate")
    single = [m.transforms[0] for m in transforms]
    assert stamps(single) == stamps(odometry)
    assert {(t.header.frame_id, t.child_frame_id) for t in single} == {("map", "l_sole")}
    for t, pose in zip(single, (m.pose.pose for m in odometry), strict=True):
        assert t.transform.rotation == pose.orientation
        assert t.transform.translation.x == pose.position.x
        assert t.transform.translation.z == pose.position.z


@pytest.fixture(scope="module")
def without_gyro():
    """States and estimates of a walk whose gyro is off from the middle of its last swing until well in the rest."""
    raw = straight_walk(2).imu
    raw.gyro_radps[500:600], raw.gyro_sd_radps[500:600] = 0.0, -1.0
    block, states = judged(raw), []
    with Bench(ZuptEkfNode) as bench:
        odometry = bench.hear(Odometry, "odom")
        health = bench.hear(FilterHealth, "filter_health", STATUS)
        publisher = bench.publisher(StanceImu, "stance")
        for start, stop in ((0, 500), (500, 600), (600, length(block))):
            bench.feed(publisher, stance_messages(part(block, start, stop)))
            bench.until(lambda n=stop: health and health[-1].samples == n == len(odometry), "health")
            states.append(health[-1].state)
    return states, joined([nav_block(m) for m in odometry])


def test_health_says_when_the_estimate_coasts(without_gyro):
    navigating, coasting = FilterHealth.STATE_NAVIGATING, FilterHealth.STATE_COASTING
    assert without_gyro[0] == [navigating, coasting, navigating]


def test_without_gyro_the_position_is_held_and_trusted_less_and_less(without_gyro):
    nav = without_gyro[1]
    assert np.ptp(nav.position_m[500:600], axis=0).max() < 1e-9
    variance = nav.pose_covariance[499:600, 0, 0]
    assert (np.diff(variance) > 0.0).all()
    assert variance[-1] > 1.0


def test_the_estimate_goes_on_when_the_gyro_is_back(without_gyro):
    nav = without_gyro[1]
    assert np.isfinite(nav.position_m).all()
    assert np.isfinite(nav.pose_covariance).all()
    assert np.linalg.norm(nav.velocity_mps[-50:], axis=1).max() < 0.05

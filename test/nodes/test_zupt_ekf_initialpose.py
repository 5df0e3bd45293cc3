"""Topic `initialpose`: the track goes on from where somebody says it is."""

import math

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry

from pdr_core.records import part
from pdr_msgs.msg import StanceImu
from pdr_nodes.placing import LEAST_VARIANCE, told_pose
from pdr_nodes.qos import ANSWERS, STATUS
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.walks import judged, stance_messages, still, straight_walk

YAW_RAD = 0.7


def pose(frame="odom", x=5.0, variance=0.25):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = x, -3.0
    message.pose.pose.orientation.z, message.pose.pose.orientation.w = math.sin(YAW_RAD / 2), math.cos(YAW_RAD / 2)
    covariance = np.zeros(36)
    covariance[[0, 7, 35]] = variance, variance, 0.07
    message.pose.covariance = covariance
    return message


def said(*elements):
    """A pose whose covariance has 5 at some elements of its 36."""
    message = pose()
    message.pose.covariance[list(elements)] = 5.0
    return message


@pytest.fixture
def run():
    with Bench(ZuptEkfNode, node__idle_s=0.3) as bench:
        bench.odometry = bench.hear(Odometry, "odom")
        bench.board = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        bench.stance = bench.publisher(StanceImu, "stance")
        bench.placing = bench.publisher(PoseWithCovarianceStamped, "initialpose", ANSWERS)
        walk = judged(straight_walk(2).imu)
        bench.feed(bench.stance, stance_messages(walk))
        bench.until(lambda: len(bench.odometry) == len(walk.stance), "the walk")
        bench.end_ns = int(walk.imu.stamp_ns[-1])
        yield bench


def rest(bench):
    """Feed a rest, and return where the track is then."""
    expected = len(bench.odometry) + 40
    bench.feed(bench.stance, stance_messages(part(judged(still(1.0, bench.end_ns + 10_000_000)), 0, 40)))
    bench.until(lambda: len(bench.odometry) >= expected, "the rest")
    found = bench.odometry[-1].pose
    return found.pose, np.array(found.covariance).reshape(6, 6)


def test_the_track_goes_on_there_with_the_deviations_that_were_told(run):
    run.placing.publish(pose())
    run.until(lambda: "placed by initialpose" in repr(run.board), "the notice")
    there, covariance = rest(run)
    assert (there.position.x, there.position.y) == pytest.approx((5.0, -3.0), abs=0.05)
    assert 2.0 * math.atan2(there.orientation.z, there.orientation.w) == pytest.approx(YAW_RAD, abs=0.02)
    assert covariance[0, 0] == pytest.approx(0.25, rel=0.05)
    assert covariance[5, 5] == pytest.approx(0.07, rel=0.05)


def test_what_is_told_with_a_variance_of_zero_as_rviz_tells_the_height_is_not_known_for_sure():
    told = told_pose(pose().pose)
    assert np.linalg.eigvalsh(told.covariance)[0] == pytest.approx(LEAST_VARIANCE)
    assert np.diag(told.covariance)[[0, 5]] == pytest.approx([0.25, 0.07], rel=1e-4)


@pytest.mark.parametrize("beside", [(1,), (1, 6)], ids=["not symmetric", "not positive"])
def test_a_covariance_that_is_none_is_refused(beside):
    with pytest.raises(ValueError, match="the covariance is none"):
        told_pose(said(*beside).pose)


@pytest.mark.parametrize(
    ("message", "words"),
    [(pose("map"), "is in frame 'map': left out"), (pose(x=math.nan), "the pose holds NaN or infinity")],
)
def test_what_cannot_be_taken_is_left_out_and_named(run, message, words):
    run.placing.publish(message)
    run.until(lambda: words in repr(run.board), "the notice")
    there, _ = rest(run)
    assert there.position.x == pytest.approx(run.odometry[-41].pose.pose.position.x, abs=0.05)

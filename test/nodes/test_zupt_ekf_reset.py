import math

import pytest
from geometry_msgs.msg import Point, Pose, PoseWithCovariance, Quaternion
from nav_msgs.msg import Odometry

from pdr_core.records import length, part
from pdr_msgs.msg import FilterHealth, StanceImu, StepEvent
from pdr_msgs.srv import ResetEstimate
from pdr_nodes.qos import STATUS
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.walks import judged, stance_messages, still, straight_walk


class Run:
    """A walk through the node, and what comes after it."""

    def __init__(self, bench):
        self.bench = bench
        self.odometry, self.steps = bench.hear(Odometry, "odom"), bench.hear(StepEvent, "step")
        self.health = bench.hear(FilterHealth, "filter_health", STATUS)
        self.publisher = bench.publisher(StanceImu, "stance")
        self.end_ns = 0

    def walk(self):
        self.feed(judged(straight_walk(2).imu))

    def rest(self):
        """A rest too short for proof of the biases."""
        self.feed(part(judged(still(1.0, self.end_ns + 10_000_000)), 0, 40))

    def feed(self, block):
        expected = len(self.odometry) + length(block)
        self.bench.feed(self.publisher, stance_messages(block))
        self.bench.until(lambda: len(self.odometry) >= expected, "every estimate")
        self.end_ns = int(block.imu.stamp_ns[-1])

    def latest_health(self):
        """The health after the last sample."""
        stamp = self.odometry[-1].header.stamp
        self.bench.until(lambda: self.health and self.health[-1].header.stamp == stamp, "health")
        return self.health[-1]

    def reset(self, x, y, z, quaternion=(0.0, 0.0, 0.0, 0.0), keep=True):
        position, orientation = Point(x=x, y=y, z=z), Quaternion(**dict(zip("xyzw", quaternion, strict=True)))
        pose = PoseWithCovariance(pose=Pose(position=position, orientation=orientation))
        return self.bench.call(ResetEstimate, "reset_estimate", pose=pose, keep_biases=keep)

    def pose(self):
        p, q = self.odometry[-1].pose.pose.position, self.odometry[-1].pose.pose.orientation
        return [p.x, p.y, p.z, 2.0 * math.atan2(q.z, q.w)]


@pytest.fixture
def run():
    with Bench(ZuptEkfNode, node__idle_s=0.3) as bench:
        made = Run(bench)
        made.walk()
        yield made


YAW = 0.7
TURNED = (0.0, 0.0, math.sin(YAW / 2), math.cos(YAW / 2))


@pytest.mark.parametrize("keep", [True, False])
def test_a_reset_puts_the_pose_and_keeps_or_drops_the_biases(run, keep):
    before = run.latest_health().gyro_bias
    answer = run.reset(5.0, -3.0, 1.0, TURNED, keep)
    assert answer.success
    run.rest()
    assert run.pose() == pytest.approx([5.0, -3.0, 1.0, YAW], abs=0.01)
    after = run.latest_health().gyro_bias
    assert abs(before.y) > 5e-4
    assert after.y == pytest.approx(before.y if keep else 0.0, abs=2e-4)


def test_a_reset_without_orientation_keeps_the_yaw(run):
    assert run.reset(1.0, 0.0, 0.0, TURNED).success
    run.rest()
    assert run.reset(2.0, 0.0, 0.0).success
    run.rest()
    assert run.pose() == pytest.approx([2.0, 0.0, 0.0, YAW], abs=0.01)


def test_steps_count_from_one_after_a_reset(run):
    run.bench.until(lambda: len(run.steps) == 2, "both steps")
    assert run.reset(0.0, 0.0, 0.0).success
    walk = judged(straight_walk(1).imu)
    later_ns = run.end_ns + 10_000_000 - int(walk.imu.stamp_ns[0])
    run.feed(walk._replace(imu=walk.imu._replace(stamp_ns=walk.imu.stamp_ns + later_ns)))
    run.bench.until(lambda: len(run.steps) == 3, "the step after the reset")
    assert [s.index for s in run.steps] == [1, 2, 1]


@pytest.mark.parametrize("quaternion", [(0.0, 0.0, 0.0, 1.0), (0.0, math.inf, 0.0, 1.0)])
def test_a_reset_to_nonsense_is_refused_and_changes_nothing(run, quaternion):
    x = 0.0 if math.inf in quaternion else math.nan
    before = run.pose()
    answer = run.reset(x, 0.0, 0.0, quaternion)
    assert not answer.success
    assert answer.message == "the pose holds NaN or infinity"
    run.rest()
    assert run.pose() == pytest.approx(before, abs=0.02)

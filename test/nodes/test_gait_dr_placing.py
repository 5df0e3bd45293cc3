"""Topic `initialpose` and service `reset_estimate` of `gait_dr`: the track goes on from there, gyro or none."""

import math

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry

from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline import AdaptiveFoot
from pdr_core.records import joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_msgs.msg import StanceImu, StepEvent
from pdr_msgs.srv import ResetEstimate
from pdr_nodes.convert import nav_block
from pdr_nodes.gait_dr_node import GaitDrNode
from pdr_nodes.qos import ANSWERS, STATUS
from support.bench import Bench
from support.walks import BEGIN_NS, judged, stamps, stance_messages

WALK = SimulationParams(motion="smooth", walk="straight", walk_length_m=30.0, sample_rate_hz=100.0)
OFF, PLACED_WITH_GYRO, PLACED_WITHOUT = (
    14,
    8,
    18,
)  # the gyro is off from this stride on; strides before which she is placed
YAW_RAD, X_M, Y_M = 0.7, 50.0, -30.0


@pytest.fixture(scope="module")
def walked():
    """The judged samples, the samples amid the stances, and the track that nobody has placed."""
    walk = simulated_walk(WALK, start_ns=BEGIN_NS)
    changes = np.diff(walk.motion.stance.astype(int))
    leaves, lands = np.flatnonzero(changes == -1), np.flatnonzero(changes == 1)
    on = np.arange(length(walk.imu)) < leaves[OFF] - 10
    gyro_radps = np.where(on[:, None], walk.imu.gyro_radps, 0.0)
    block = judged(walk.imu._replace(gyro_sd_radps=np.where(on, walk.imu.gyro_sd_radps, -1.0), gyro_radps=gyro_radps))
    foot = AdaptiveFoot(Params())
    alone = joined([*(moved.output.nav for moved in foot.run(block)), foot.finish().nav])
    return block, (lands[:-1] + leaves[1:]) // 2, alone


def pose_message():
    message = PoseWithCovarianceStamped()
    message.header.frame_id = "odom"
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    place.x, place.y = X_M, Y_M
    turn.z, turn.w = math.sin(YAW_RAD / 2), math.cos(YAW_RAD / 2)
    message.pose.covariance = np.diag([0.04, 0.04, 0.01, 1e-4, 1e-4, 0.01]).ravel()
    return message


def placed(walked, stride, place):
    """Return the track of the node that is placed amid the stance before a stride, and its steps after that."""
    block, stances, _ = walked
    row = int(stances[stride - 1])
    with Bench(GaitDrNode, node__idle_s=1.0) as bench:
        odometry, steps = bench.hear(Odometry, "odom"), bench.hear(StepEvent, "step")
        stance = bench.publisher(StanceImu, "stance")
        bench.feed(stance, stance_messages(part(block, 0, row)))
        bench.until(lambda: not bench.node.waiting and len(steps) >= stride - 2, "the samples so far")
        for _ in range(20):
            bench.spin()
        before = len(steps)
        place(bench)
        bench.feed(stance, stance_messages(part(block, row)))
        bench.until(lambda: stamps(odometry[-1:]) == [int(block.imu.stamp_ns[-1])], "the last estimate")
    return joined([nav_block(message) for message in odometry]), steps[before:]


def by_topic(bench):
    board = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
    bench.publisher(PoseWithCovarianceStamped, "initialpose", ANSWERS).publish(pose_message())
    bench.until(lambda: "placed by initialpose" in repr(board), "the notice")


def by_service(bench):
    answer = bench.call(ResetEstimate, "reset_estimate", pose=pose_message().pose, keep_biases=True)
    assert answer.success


@pytest.mark.parametrize("place", [by_topic, by_service])
@pytest.mark.parametrize("stride", [PLACED_WITH_GYRO, PLACED_WITHOUT])
def test_the_track_goes_on_from_there(walked, stride, place):
    block, stances, alone = walked
    nav, steps = placed(walked, stride, place)
    at_m = alone.position_m[np.searchsorted(alone.stamp_ns, block.imu.stamp_ns[stances[stride - 1]])]
    way_m = float(np.linalg.norm((alone.position_m[-1] - at_m)[:2]))
    went_m = nav.position_m[-1, :2] - [X_M, Y_M]
    assert np.linalg.norm(went_m) == pytest.approx(way_m, abs=0.7)
    assert math.atan2(went_m[1], went_m[0]) == pytest.approx(YAW_RAD, abs=0.1)
    assert 1 in [step.index for step in steps]
    assert nav.pose_covariance[-1, 0, 0] > 0.04
    far_m = np.linalg.norm(nav.position_m[:, :2] - [X_M, Y_M], axis=1)
    between = (far_m > way_m + 2.0) & (nav.stamp_ns > block.imu.stamp_ns[stances[stride - 1]] + 2 * 10**8)
    assert not between.any()

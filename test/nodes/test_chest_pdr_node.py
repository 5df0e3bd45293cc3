"""The node says what the pipeline says, names what is wrong, and goes on."""

from types import SimpleNamespace

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from pdr_core.records import joined, length, part, picked
from pdr_msgs.msg import FilterHealth, StepEvent
from pdr_msgs.srv import ResetEstimate
from pdr_nodes.chest_pdr_node import ChestPdrNode
from pdr_nodes.convert import imu_message, nav_block, step_event
from pdr_nodes.qos import ANSWERS, STATUS
from support.bench import Bench
from support.chest import RATE_HZ, estimated, walk
from support.walks import stamps

SECONDS = 16
BEGIN_NS = 1_700_000_000_000_000_000


def stamped(imu):
    return imu._replace(stamp_ns=imu.stamp_ns + BEGIN_NS)


def told(imu):
    """What the node says of samples, and what the pipeline says of the same."""
    nav, steps, _ = estimated(imu)
    with Bench(ChestPdrNode, node__idle_s=0.3) as bench:
        odometry, said = bench.hear(Odometry, "odom"), bench.hear(StepEvent, "step")
        health = bench.hear(FilterHealth, "filter_health", STATUS)
        bench.feed(bench.publisher(Imu, "imu/data"), [imu_message(imu, i, "chest") for i in range(length(imu))])
        bench.until(lambda: len(odometry) >= length(nav), "an estimate for every sample")
        bench.until(lambda: len(said) >= len(steps), "every step")
        bench.until(lambda: health and health[-1].samples >= length(nav), "the health after the last sample")
    return SimpleNamespace(nav=nav, steps=steps, odometry=odometry, said=said, health=health[-1])


@pytest.fixture(scope="module")
def walked():
    return told(stamped(part(walk(3).imu, 0, SECONDS * RATE_HZ)))


def test_the_node_equals_the_pipeline_to_the_last_bit(walked):
    said = joined([nav_block(m) for m in walked.odometry])
    for here, there in zip(said, walked.nav, strict=True):
        assert np.array_equal(here, there)
    assert [m.header.stamp.sec for m in walked.said] == [s.stamp_ns // 10**9 for s in walked.steps]
    for message, step in zip(walked.said, walked.steps, strict=True):
        assert np.array_equal(step_event(message).position_m, step.position_m)
        assert step_event(message).yaw_rad == step.yaw_rad


def test_frames_and_stamps(walked):
    assert stamps(walked.odometry) == walked.nav.stamp_ns.tolist()
    assert {(m.header.frame_id, m.child_frame_id) for m in walked.odometry} == {("odom", "chest")}
    assert len(walked.said) > 8


def test_the_health_counts_rests(walked):
    assert walked.health.state == FilterHealth.STATE_NAVIGATING
    assert walked.health.zero_velocity_updates >= 1
    assert 0.0 < walked.health.nav_quality <= 1.0
    assert 0.0 < walked.health.gyro_bias_stddev.x < 0.01


def test_a_nan_and_a_gap_are_survived_and_named():
    imu = stamped(part(walk(3).imu, 0, SECONDS * RATE_HZ))
    gyro = imu.gyro_radps.copy()
    gyro[700] = np.nan
    second = np.r_[0 : 10 * RATE_HZ, 11 * RATE_HZ : length(imu)]
    said = told(picked(imu._replace(gyro_radps=gyro), second))
    assert all(np.isfinite(column).all() for m in said.odometry for column in nav_block(m))
    words = " ".join(said.health.notices)
    assert "NaN" in words
    assert "samples were missing" in words
    assert said.health.gaps == 1


def test_initialpose_and_reset_estimate_put_the_track_elsewhere():
    imu = stamped(walk(3).imu)
    with Bench(ChestPdrNode, node__idle_s=0.3) as bench:
        odometry, board = bench.hear(Odometry, "odom"), bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        samples = bench.publisher(Imu, "imu/data")
        placing = bench.publisher(PoseWithCovarianceStamped, "initialpose", ANSWERS)

        def rest(first):
            bench.feed(samples, [imu_message(imu, i, "chest") for i in range(first, first + RATE_HZ)])
            last = imu_message(imu, first + RATE_HZ - 1, "chest").header.stamp
            bench.until(lambda: odometry and odometry[-1].header.stamp == last, "the rest")
            return odometry[-1].pose.pose.position.x, odometry[-1].pose.pose.position.y

        assert rest(0) == (0.0, 0.0)
        told = PoseWithCovarianceStamped()
        told.header.frame_id, told.pose.pose.position.x, told.pose.pose.orientation.w = "odom", 5.0, 1.0
        placing.publish(told)
        bench.until(lambda: "placed by initialpose" in repr(board), "the notice")
        assert rest(RATE_HZ) == (5.0, 0.0)
        told.pose.pose.position.y = 2.0
        assert bench.call(ResetEstimate, "reset_estimate", pose=told.pose, keep_biases=True).success
        assert rest(2 * RATE_HZ) == (5.0, 2.0)

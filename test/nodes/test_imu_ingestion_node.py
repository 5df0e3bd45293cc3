import math

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu

from pdr_core.intake.stamp_faults import NOTICES, Fault
from pdr_core.maths import quaternion
from pdr_core.params import Params
from pdr_core.pipeline import OrientedIntake
from pdr_core.records import Level, length
from pdr_nodes.imu_ingestion_node import ImuIngestionNode
from pdr_nodes.notice_board import notices_from
from pdr_nodes.qos import OWN, STATUS
from support.bench import Bench
from support.walks import BEGIN_NS, imu_messages, stamps, still, straight_walk

FOREIGN = {
    kind.name: QoSProfile(depth=10, reliability=kind)
    for kind in (ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE)
}
NAMED_WITHIN_S = 3.0


def told(diagnostics):
    """The latest of what the node, named with its namespace, says is wrong with the samples: {kind: notice}."""
    status = [s for m in diagnostics for s in m.status if s.name.endswith("/imu_ingestion: samples")][-1:]
    return {notice.kind: notice for s in status for notice in notices_from(s.values)}


def driven(bench, messages, expected, qos=FOREIGN["BEST_EFFORT"]):
    """What comes out of the node for these messages of a foreign driver, and what it says on /diagnostics."""
    out, diagnostics = bench.hear(Imu, "imu/data"), bench.hear(DiagnosticArray, "/diagnostics", STATUS)
    bench.feed(bench.publisher(Imu, "imu/data_raw", qos), messages)
    bench.until(lambda: len(out) >= expected, f"{expected} samples")
    return out, diagnostics


@pytest.mark.parametrize("reliability", FOREIGN)
def test_any_driver_connects(reliability):
    block = still(1.0, BEGIN_NS)
    with Bench(ImuIngestionNode) as bench:
        out, _ = driven(bench, imu_messages(block), 100, FOREIGN[reliability])
    assert stamps(out) == block.stamp_ns.tolist()
    assert {m.header.frame_id for m in out} == {"foot"}


def test_the_orientation_of_each_sample_goes_out_with_it():
    walk = straight_walk(2)
    with Bench(ImuIngestionNode) as bench:
        out, _ = driven(bench, imu_messages(walk.imu), length(walk.imu), OWN)
    expected = OrientedIntake(Params()).run(walk.imu)[1]
    sent = [[m.orientation.x, m.orientation.y, m.orientation.z, m.orientation.w] for m in out]
    np.testing.assert_array_equal(sent, expected.quat_xyzw)
    covariances = np.array([m.orientation_covariance for m in out])
    np.testing.assert_array_equal(covariances, expected.attitude_covariance.reshape(-1, 9))
    assert (covariances[:, ::4] > 0.0).all()
    ends = np.array(sent[-1]), walk.motion.quat_xyzw[-1]
    up = [quaternion.matrix(xyzw)[2] for xyzw in ends]  # seen from the foot
    np.testing.assert_allclose(up[0], up[1], atol=0.02)


def with_faults(good):
    """The messages with a NaN, an infinity, a repeated stamp and a late sample among them."""
    bad = imu_messages(still(0.04, BEGIN_NS + 5_000_000))
    bad[0].angular_velocity.y, bad[1].linear_acceleration.z = math.nan, math.inf
    bad[2].header.stamp = good[59].header.stamp
    return [*good[:20], bad[0], *good[20:40], bad[1], *good[40:60], bad[2], *good[60:80], bad[3], *good[80:]]


def test_bad_samples_never_come_out_and_are_named():
    good = imu_messages(still(1.0, BEGIN_NS))
    with Bench(ImuIngestionNode) as bench:
        out, diagnostics = driven(bench, with_faults(good), 100)
        kinds = {"not_finite", "duplicate_stamp", "late_stamp"}
        bench.until(lambda: set(told(diagnostics)) == kinds, f"{kinds} on /diagnostics", NAMED_WITHIN_S)
    assert stamps(out) == stamps(good)
    values = [[m.angular_velocity.y, m.linear_acceleration.z, *m.angular_velocity_covariance] for m in out]
    assert np.isfinite(values).all()
    assert {notice.level for notice in told(diagnostics).values()} == {Level.WARN}
    assert told(diagnostics)["not_finite"].count == 2


def test_what_is_wrong_with_the_stamps_is_named_and_nothing_waits_for_ever():
    """Ten samples with one stamp, a stray, and a clock that is set an hour ahead with the last sample."""
    block = still(1.0, BEGIN_NS)
    block.gyro_radps[:, 0] = np.linspace(0.0, 0.1, 100)
    block.stamp_ns[40:50] = block.stamp_ns[49]
    block.stamp_ns[70] -= 10**10
    block.stamp_ns[99] += 3600 * 10**9
    with Bench(ImuIngestionNode, node__idle_s=0.4) as bench:
        out, diagnostics = driven(bench, imu_messages(block), 90)
        kinds = {"equal_stamps", "stray_stamp", "clock_jumped_forth"}
        bench.until(lambda: kinds <= set(told(diagnostics)), f"{kinds} on /diagnostics", NAMED_WITHIN_S)
    assert stamps(out) == np.delete(block.stamp_ns, np.r_[41:50, 70]).tolist()
    assert (told(diagnostics)["equal_stamps"].count, told(diagnostics)["equal_stamps"].text) == (
        9,
        NOTICES[Fault.EQUAL][2],
    )


@pytest.mark.parametrize(
    ("field", "factor", "kind"),
    [("accel_mps2", 1 / 9.80665, "accel_unit"), ("gyro_radps", 180 / np.pi, "gyro_unit")],
)
def test_a_wrong_unit_is_named(field, factor, kind):
    block = still(1.5, BEGIN_NS)
    block.gyro_radps[50:100, 1] = 3.0
    block = block._replace(**{field: getattr(block, field) * factor})
    with Bench(ImuIngestionNode) as bench:
        _, diagnostics = driven(bench, imu_messages(block), 150)
        bench.until(lambda: kind in told(diagnostics), f"{kind} on /diagnostics", NAMED_WITHIN_S)
    assert told(diagnostics)[kind].level is Level.ERROR
    assert f"set intake.{kind}" in told(diagnostics)[kind].text


def test_a_sensor_upside_down_is_only_rotated():
    block = still(1.5, BEGIN_NS)
    block.gyro_radps[:] = [0.1, 0.2, 0.3]
    block.accel_mps2[:] = [0.4, 0.5, -9.8]
    with Bench(ImuIngestionNode, intake__mounting_roll_rad=math.pi) as bench:
        out, diagnostics = driven(bench, imu_messages(block), 150)
        bench.until(lambda: len(diagnostics) >= 2, "two diagnoses")
    rates = [[m.angular_velocity.x, m.angular_velocity.y, m.angular_velocity.z] for m in out]
    forces = [[m.linear_acceleration.x, m.linear_acceleration.y, m.linear_acceleration.z] for m in out]
    np.testing.assert_allclose(rates, np.tile([0.1, -0.2, -0.3], (150, 1)), atol=1e-12)
    np.testing.assert_allclose(forces, np.tile([0.4, -0.5, 9.8], (150, 1)), atol=1e-12)
    assert stamps(out) == block.stamp_ns.tolist()
    assert told(diagnostics) == {}


def test_a_gyro_that_is_off_stays_off_and_is_named():
    block = still(1.0, BEGIN_NS)
    block.gyro_sd_radps[30:60] = -1.0
    with Bench(ImuIngestionNode) as bench:
        out, diagnostics = driven(bench, imu_messages(block), 100)
        bench.until(lambda: "gyro_off" in told(diagnostics), "gyro_off on /diagnostics", NAMED_WITHIN_S)
    assert [i for i, m in enumerate(out) if m.angular_velocity_covariance[0] == -1.0] == list(range(30, 60))
    assert told(diagnostics)["gyro_off"].count == 30

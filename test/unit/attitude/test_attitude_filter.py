"""Whole runs of the orientation filters over simulated walks."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.attitude import QuaternionFilter, UnjudgedQuaternionFilter
from pdr_core.intake import Ingestion
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.records import ImuBlock, joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.sensors import SENSOR_MODELS
from pdr_core.stance import StanceDetection

RATE_HZ = 200
WALK = SimulationParams(
    motion="smooth", walk="rectangle", walk_length_m=16.0, sample_rate_hz=float(RATE_HZ), sensor_model="ideal"
)
LOW_RANGE = 1.0  # rad/s
FIELD = np.array([0.9e-5, 1.6e-5, -4.3e-5])


def judged_by(raw, params=Params()):  # noqa: B008
    intake, stance = Ingestion(params.intake), StanceDetection(params.stance, params.place)
    return joined([stance.run(intake.run(raw)), stance.run(intake.finish()), stance.finish()])


IDEAL = simulated_walk(WALK)
JUDGED = judged_by(IDEAL.imu)
MOVING = np.flatnonzero(~JUDGED.stance)


def copied(imu):
    return ImuBlock(*(column.copy() for column in imu))


def errors_rad(quat_xyzw, motion=IDEAL.motion):
    return (Rotation.from_quat(motion.quat_xyzw[: len(quat_xyzw)]) * Rotation.from_quat(quat_xyzw).inv()).as_rotvec()


def with_field(imu, motion=IDEAL.motion, field=FIELD):
    return imu._replace(field_tesla=seen(field, motion.quat_xyzw), field_sd_tesla=np.zeros(length(imu)))


def seen(field, quat_xyzw):
    """What a magnetometer shows: values that are the same to the last bit would count as one that is repeated."""
    noise = 1e-9 * np.random.default_rng(0).standard_normal((len(quat_xyzw), 3))
    return Rotation.from_quat(quat_xyzw).inv().apply(field) + noise


def kinds():
    return [(QuaternionFilter, JUDGED), (UnjudgedQuaternionFilter, JUDGED.imu)]


def test_without_noise_it_is_the_truth():
    found = QuaternionFilter(Params()).run(JUDGED)
    assert np.abs(errors_rad(found.quat_xyzw)).max() < np.radians(0.05)
    assert np.abs(found.gyro_bias_radps).max() < 1e-4
    np.testing.assert_array_equal(found.stamp_ns, JUDGED.imu.stamp_ns)


def test_unjudged_it_is_the_truth_in_the_first_rest_and_near_it_on_the_way():
    found = UnjudgedQuaternionFilter(Params()).run(JUDGED.imu)
    assert np.abs(errors_rad(found.quat_xyzw[: 2 * RATE_HZ])).max() < 1e-3
    assert np.sqrt(np.mean(errors_rad(found.quat_xyzw)[:, :2] ** 2)) < np.radians(1.5)


def test_the_bias_is_found_and_the_tilt_is_as_good_as_the_accelerometer():
    gyro, accel = (0.003, -0.0025, 0.002), (0.03, -0.02, 0.02)
    model = replace(SENSOR_MODELS["consumer"], gyro_bias_radps=gyro, accel_bias_mps2=accel)
    walk = simulated_walk(WALK, model=model)
    one = QuaternionFilter(Params())
    found = one.run(judged_by(walk.imu))
    bias_sd = np.sqrt(np.diag(one.state.P)[4:])
    assert bias_sd.max() < 0.001
    assert np.all(np.abs(found.gyro_bias_radps[-1] - gyro) < 3.0 * bias_sd)
    normalised = errors_rad(found.quat_xyzw, walk.motion)[RATE_HZ:] / np.sqrt(
        np.diagonal(found.attitude_covariance[RATE_HZ:], axis1=1, axis2=2)
    )
    assert np.abs(normalised).max() < 4.0
    assert np.sqrt(np.mean(normalised**2)) > 0.1


@pytest.mark.parametrize("yaw_rad", [0.7, -2.5])
@pytest.mark.parametrize(("kind", "block"), kinds())
def test_a_turned_world_turns_the_result(kind, block, yaw_rad):
    plain = kind(Params()).run(block)
    turned = kind(changed(Params(), "filter", initial_yaw_rad=yaw_rad)).run(block)
    turn = Rotation.from_euler("z", yaw_rad)
    difference = (turn * Rotation.from_quat(plain.quat_xyzw)).inv() * Rotation.from_quat(turned.quat_xyzw)
    assert difference.magnitude().max() < 1e-8
    R = turn.as_matrix()
    np.testing.assert_allclose(turned.attitude_covariance, R @ plain.attitude_covariance @ R.T, atol=1e-10)


@pytest.mark.parametrize(("kind", "block"), kinds())
def test_later_stamps_shift_nothing(kind, block):
    imu = block.imu if block is JUDGED else block
    late_imu = imu._replace(stamp_ns=imu.stamp_ns + 10**18)
    late = block._replace(imu=late_imu) if block is JUDGED else late_imu
    np.testing.assert_array_equal(kind(Params()).run(late).quat_xyzw, kind(Params()).run(block).quat_xyzw)


@pytest.mark.parametrize("cuts", [[7], [3, 4, 5], [1500], [1501, 1502, 2300]])
@pytest.mark.parametrize(("kind", "block"), kinds())
def test_cutting_anywhere_changes_nothing(kind, block, cuts):
    whole, pieces = kind(Params()).run(block), kind(Params())
    ends = [0, *cuts, length(block)]
    found = joined([pieces.run(part(block, a, b)) for a, b in pairwise(ends)])
    for one, other in zip(whole, found, strict=True):
        np.testing.assert_array_equal(one, other)


def test_a_saved_state_goes_on_where_it_was():
    first = QuaternionFilter(Params())
    first.run(part(JUDGED, 0, 1300))
    saved = first.state.copy()
    expected = first.run(part(JUDGED, 1300))
    second = QuaternionFilter(Params())
    second.state = saved
    np.testing.assert_array_equal(second.run(part(JUDGED, 1300)).quat_xyzw, expected.quat_xyzw)


@pytest.mark.parametrize(("kind", "block"), kinds())
def test_quaternions_are_of_unit_length_and_covariances_have_a_root(kind, block):
    one = kind(Params())
    found = one.run(block)
    np.testing.assert_allclose(np.linalg.norm(found.quat_xyzw, axis=1), 1.0, atol=1e-14)
    assert np.linalg.eigvalsh(found.attitude_covariance).min() > 0.0
    assert np.abs(one.state.P[:4, :4] @ one.state.quat_xyzw).max() < 1e-18


def gapped(imu):
    kept = np.r_[0:1700, 2300 : length(imu)]
    return ImuBlock(*(column[kept] for column in imu)), 1700


def gyro_off(imu):
    imu.gyro_radps[1700:2300], imu.gyro_sd_radps[1700:2300] = 0.0, -1.0
    return imu, 1705


def saturated(imu):
    imu.gyro_radps[:] = np.clip(imu.gyro_radps, -LOW_RANGE, LOW_RANGE)
    return imu, 1700 + int(np.flatnonzero(np.abs(imu.gyro_radps[1700:]).max(axis=1) >= LOW_RANGE)[20])


def set_back(imu):
    imu.stamp_ns[1700:] -= 5_000_000_000
    return imu, 1700


@pytest.mark.parametrize("trouble", [gapped, gyro_off, saturated, set_back])
@pytest.mark.parametrize("kind", [QuaternionFilter, UnjudgedQuaternionFilter])
def test_after_trouble_it_trusts_itself_less_and_comes_back(kind, trouble):
    imu, at = trouble(copied(IDEAL.imu))
    params = changed(Params(), "intake", gyro_range_radps=LOW_RANGE) if trouble is saturated else Params()
    judged = judged_by(imu, params)
    rows = np.searchsorted(IDEAL.imu.stamp_ns, judged.imu.stamp_ns) if trouble is gapped else np.arange(length(imu))
    found = kind(Params()).run(judged if kind is QuaternionFilter else judged.imu)
    assert all(np.isfinite(column).all() for column in found)
    yaw_sd = np.sqrt(found.attitude_covariance[:, 2, 2])
    untroubled = kind(Params()).run(JUDGED if kind is QuaternionFilter else JUDGED.imu)
    assert yaw_sd[at + 1] > 1.2 * np.sqrt(untroubled.attitude_covariance[at + 1, 2, 2])
    truth = Rotation.from_quat(IDEAL.motion.quat_xyzw[rows])
    tilt = (truth * Rotation.from_quat(found.quat_xyzw).inv()).apply([0.0, 0.0, 1.0])
    assert np.arccos(np.clip(tilt[-RATE_HZ:, 2], -1, 1)).max() < np.radians(2.0)


@pytest.mark.parametrize("turn_rad", [(0.9, -0.7, 0.3), (2.2, -2.1, 0.3)])
@pytest.mark.parametrize("kind", [QuaternionFilter, UnjudgedQuaternionFilter])
def test_a_sensor_that_is_kicked_aside_is_level_again_and_it_says_so(kind, turn_rad):
    imu, aside = copied(IDEAL.imu), Rotation.from_rotvec(turn_rad)
    imu.gyro_radps[1700:], imu.accel_mps2[1700:] = (
        aside.apply(imu.gyro_radps[1700:]),
        aside.apply(imu.accel_mps2[1700:]),
    )
    judged, one = judged_by(imu), kind(Params())
    found = one.run(judged if kind is QuaternionFilter else judged.imu)
    up = Rotation.from_quat(found.quat_xyzw[-1]).apply(imu.accel_mps2[-1])
    assert np.hypot(up[0], up[1]) / up[2] < 0.02
    assert "attitude_doubted" in {notice.kind for notice in one.notices}
    assert not kind(Params()).notices


@pytest.mark.parametrize("turn_rad", [(0.9, -0.7, 0.0), (2.2, -2.1, 0.3), (np.pi, 0.0, 0.0)])
def test_one_doubt_is_enough_for_a_turn_of_any_size(turn_rad):
    imu = part(IDEAL.imu, 0, 450)
    accel = imu.accel_mps2.copy()
    accel[400:] = Rotation.from_rotvec(turn_rad).apply(accel[400:])
    one = UnjudgedQuaternionFilter(Params())
    found = one.run(imu._replace(accel_mps2=accel, gyro_sd_radps=np.full(450, 0.01)))
    up = Rotation.from_quat(found.quat_xyzw[425]).apply(accel[425])  # the release takes .1 s
    assert np.hypot(up[0], up[1]) < 1e-3 * up[2]
    assert one.state.doubted == 1


def test_the_field_holds_the_heading_that_a_bias_would_turn():
    imu = with_field(copied(IDEAL.imu))
    imu.gyro_radps[:] += [0.0, 0.0, 0.005]
    judged = judged_by(imu)._replace(rest_sd_radps=np.zeros(length(imu)))  # no rest tells the bias
    without = QuaternionFilter(Params()).run(judged)
    held = QuaternionFilter(changed(Params(), "attitude", use_field=True)).run(judged)
    assert abs(errors_rad(without.quat_xyzw)[-1, 2]) > np.radians(4.0)
    assert abs(errors_rad(held.quat_xyzw)[-1, 2]) < np.radians(2.0)
    assert held.attitude_covariance[-1, 2, 2] < without.attitude_covariance[-1, 2, 2]


def test_a_disturbed_field_turns_nothing_and_a_clean_one_tilts_nothing():
    params = changed(Params(), "attitude", use_field=True)
    imu = with_field(copied(IDEAL.imu))
    imu.field_tesla[1700:] = seen(FIELD + np.array([3e-5, -1e-5, 0.0]), IDEAL.motion.quat_xyzw[1700:])
    one = QuaternionFilter(params)
    found = one.run(judged_by(imu))
    assert np.abs(errors_rad(found.quat_xyzw)).max() < np.radians(0.05)
    assert "field_disturbed" in {notice.kind for notice in one.notices}
    off_north = with_field(copied(IDEAL.imu), field=FIELD)
    off_north.field_tesla[400:] = seen(Rotation.from_euler("z", 0.3).apply(FIELD), IDEAL.motion.quat_xyzw[400:])
    turned = QuaternionFilter(params).run(judged_by(off_north))
    assert np.abs(errors_rad(turned.quat_xyzw)[:, 2]).max() > 0.05
    tilt = Rotation.from_quat(turned.quat_xyzw).inv().apply([0.0, 0.0, 1.0])
    true = Rotation.from_quat(IDEAL.motion.quat_xyzw).inv().apply([0.0, 0.0, 1.0])
    assert np.abs(tilt - true).max() < 2e-3


def test_without_being_told_the_field_is_not_used():
    plain, fielded = (QuaternionFilter(Params()).run(judged_by(imu)) for imu in (IDEAL.imu, with_field(IDEAL.imu)))
    np.testing.assert_array_equal(plain.quat_xyzw, fielded.quat_xyzw)


def test_unjudged_a_moment_that_looks_like_rest_counts_little_after_a_motion():
    """Rest, a motion, and then ten samples as long as gravity but turned: without a memory they tilt more."""
    n, tilted = 500, Rotation.from_euler("y", 0.1).apply([0.0, 0.0, 9.806])
    accel = np.tile([0.0, 0.0, 9.806], (n, 1))
    accel[400:490], accel[490:] = [0.0, 0.0, 30.0], tilted
    imu = part(IDEAL.imu, 0, n)._replace(accel_mps2=accel, gyro_radps=np.zeros((n, 3)), gyro_sd_radps=np.full(n, 0.01))
    tilts = []
    for memory_s in (0.1, 0.0):
        found = UnjudgedQuaternionFilter(changed(Params(), "attitude", motion_memory_s=memory_s)).run(imu)
        tilts.append(Rotation.from_quat(found.quat_xyzw[-1]).magnitude())
    assert tilts[1] > 1e-4
    assert tilts[0] < 0.1 * tilts[1]


def test_a_faster_sensor_is_not_believed_more():
    sds = []
    for rate_hz in (100.0, 400.0):
        walk = simulated_walk(replace(WALK, sample_rate_hz=rate_hz, walk="still", walk_length_m=0.0))
        judged = judged_by(walk.imu)
        found = QuaternionFilter(Params()).run(
            judged._replace(zero_velocity_sd_mps=np.full_like(judged.zero_velocity_sd_mps, 0.005))
        )
        sds.append(np.sqrt(found.attitude_covariance[-1, 0, 0]))
    assert sds[1] == pytest.approx(sds[0], rel=0.1)

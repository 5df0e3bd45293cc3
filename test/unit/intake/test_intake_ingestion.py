import copy
import re

import numpy as np
import pytest
from intake_cases import only, taken
from scipy.spatial.transform import Rotation

from pdr_core.intake import Ingestion
from pdr_core.params import IntakeParams
from pdr_core.records import Level, inertial_block, length, part

MS, BEGIN_NS = 1_000_000, 10**18


def still(n=20, period_ms=10, begin_ns=BEGIN_NS):
    stamps = begin_ns + np.arange(n, dtype=np.int64) * period_ms * MS
    return inertial_block(stamps, np.full((n, 3), 0.01), np.tile([0.0, 0.0, 9.81], (n, 1)), np.zeros(n), np.zeros(n))


def test_good_samples_pass_unchanged_and_without_a_notice():
    imu = still()
    out, notices = taken(imu)
    assert not notices
    for name in ("stamp_ns", "gyro_radps", "accel_mps2"):
        np.testing.assert_array_equal(getattr(out, name), getattr(imu, name))


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e300, -1e6])
@pytest.mark.parametrize("column", ["gyro_radps", "accel_mps2"])
def test_what_is_no_number_is_left_out(column, value):
    imu = still()
    getattr(imu, column)[5, 1] = value
    out, notices = taken(imu)
    notice = only(notices, "not_finite")
    assert (notice.level, notice.count, notice.first_stamp_ns) == (Level.WARN, 1, imu.stamp_ns[5])
    assert notice.text == "samples hold NaN, infinity or absurd numbers: left out"
    np.testing.assert_array_equal(out.stamp_ns, np.delete(imu.stamp_ns, 5))


def test_a_saturated_gyro_is_told_and_trusted_less():
    imu = still()
    imu.gyro_radps[5, 2] = -34.9
    out, notices = taken(imu, change_noise=0.0)
    notice = only(notices, "gyro_saturated")
    assert (notice.level, notice.count) == (Level.WARN, 1)
    assert notice.text == "the gyro saturates: choose a larger range"
    assert out.gyro_sd_radps[5] == pytest.approx(np.hypot(0.001, 0.03) / 0.1)
    assert out.gyro_sd_radps[6] == pytest.approx(0.01)  # .001 / sqrt(.01 s)
    np.testing.assert_allclose(out.accel_sd_mps2[1:], 0.15, rtol=1e-6)


def test_a_saturated_accelerometer_is_told_and_trusted_less():
    imu = still()
    imu.accel_mps2[5, 0] = 156.9
    out, notices = taken(imu, change_noise=0.0)
    assert only(notices, "accel_saturated").text == "the accelerometer saturates: choose a larger range"
    assert out.accel_sd_mps2[5] == pytest.approx(np.hypot(0.015, 1.4) / 0.1)


def test_a_gyro_that_is_off_is_told_and_marked():
    imu = still()
    imu.gyro_sd_radps[5:8] = -1.0
    out, notices = taken(imu)
    notice = only(notices, "gyro_off")
    assert (notice.level, notice.count) == (Level.WARN, 3)
    assert notice.text == "the gyro is off: the track is held until it is on again"
    np.testing.assert_array_equal(np.flatnonzero(out.gyro_sd_radps == -1.0), [5, 6, 7])


def test_the_noise_of_a_sample_follows_from_density_and_interval():
    out, _ = taken(still(period_ms=40), gyro_noise_density=0.002, accel_noise_density=0.03)
    np.testing.assert_allclose(out.gyro_sd_radps[1:], 0.002 / np.sqrt(0.04), rtol=1e-4)
    np.testing.assert_allclose(out.accel_sd_mps2[1:], 0.03 / np.sqrt(0.04), rtol=1e-4)
    assert out.gyro_sd_radps[0] == pytest.approx(0.002 / np.sqrt(0.1), rel=1e-4)  # nothing before it: as after a gap


def test_units_are_converted():
    imu = still()
    imu.gyro_radps[:], imu.accel_mps2[:] = [180.0, -90.0, 0.0], [0.0, 0.0, 1.0]
    out, notices = taken(imu, gyro_unit="deg/s", accel_unit="g")
    assert not notices
    np.testing.assert_allclose(out.gyro_radps[3], [np.pi, -np.pi / 2, 0.0])
    np.testing.assert_allclose(out.accel_mps2[3], [0.0, 0.0, 9.80665])


def test_the_mounting_turns_the_sensors_axes_into_the_foots():
    imu, angles = still(), (0.3, -1.2, 2.5)
    imu.gyro_radps[:], imu.accel_mps2[:] = [1.0, 2.0, 3.0], [-4.0, 5.0, 6.0]
    out, _ = taken(imu, mounting_roll_rad=angles[0], mounting_pitch_rad=angles[1], mounting_yaw_rad=angles[2])
    foot_from_sensor = Rotation.from_euler("xyz", angles)
    np.testing.assert_allclose(out.gyro_radps, foot_from_sensor.apply(imu.gyro_radps))
    np.testing.assert_allclose(out.accel_mps2, foot_from_sensor.apply(imu.accel_mps2))


def test_saturation_is_judged_in_the_sensors_own_axes():
    imu = still()
    imu.gyro_radps[5] = [34.9, 0.0, 0.0]
    assert "gyro_saturated" in taken(imu, mounting_yaw_rad=np.pi / 4)[1]


def walking(scale_accel=1.0, scale_gyro=1.0, minus_g=0.0):
    imu = still(n=150)
    return imu._replace(
        accel_mps2=(imu.accel_mps2 - [0, 0, minus_g]) * scale_accel, gyro_radps=imu.gyro_radps * scale_gyro
    )


@pytest.mark.parametrize(
    ("imu", "text"),
    [
        (
            walking(1 / 9.80665),
            "typically 1 m/s^2 instead of 9.81: probably in g; set intake.accel_unit, or the unit in",
        ),
        (walking(minus_g=9.81), "typically 0 m/s^2 instead of 9.81: gravity seems to be removed; use the raw"),
        (walking(9.80665), "typically 96.2 m/s^2 instead of 9.81: check the unit and the calibration"),
        (walking(1.23), "typically 12.1 m/s^2 instead of 9.81 in the first second: stand still then; if the foot did,"),
        (walking(0.3), "typically 2.94 m/s^2 instead of 9.81: check the unit and the calibration"),
    ],
)
def test_an_implausible_acceleration_is_told_once(imu, text):
    notice = only(taken(imu)[1], "accel_unit")
    assert (notice.level, notice.count, notice.first_stamp_ns) == (Level.ERROR, 1, BEGIN_NS)
    assert text in notice.text


def test_rates_in_degrees_are_told():
    _, notices = taken(walking(scale_gyro=6500.0))
    notice = notices["gyro_unit"]
    assert (notice.level, notice.count) == (Level.ERROR, 150)
    assert (
        notice.text
        == "rates of over 60 rad/s: probably deg/s; set intake.gyro_unit, or the unit in the column map, to deg/s"
    )


def test_a_copy_goes_on_like_the_original():
    imu = still()
    imu.stamp_ns[10:] += 500 * MS
    intake = Ingestion(IntakeParams())
    intake.run(part(imu, 0, 10))
    other = copy.deepcopy(intake)
    for a, b in zip(intake.run(part(imu, 10)), other.run(part(imu, 10)), strict=True):
        np.testing.assert_array_equal(a, b)
    assert intake.notices == other.notices


def test_nothing_in_nothing_out():
    out, notices = taken(part(still(), 0, 0))
    assert length(out) == 0
    assert not notices


def steps(clip_mps2=np.inf, clip_radps=np.inf, rate_hz=100.0):
    """Ten steps of a second: rate and force swing by 8 rad/s and 50 m/s^2."""
    n = int(10 * rate_hz)
    t = np.arange(n) / rate_hz
    swing = np.column_stack([np.sin(2 * np.pi * t), np.zeros(n), np.zeros(n)])
    stamps = BEGIN_NS + np.rint(t * 1e9).astype(np.int64)
    rate, force = np.clip(8.0 * swing, -clip_radps, clip_radps), np.clip(50.0 * swing, -clip_mps2, clip_mps2)
    return inertial_block(stamps, rate, force + np.array([0.0, 0.0, 9.81]), np.zeros(n), np.zeros(n))


@pytest.mark.parametrize(
    ("clip", "kind", "level", "said"),
    [
        ({"clip_radps": 4.36}, "gyro_range", Level.ERROR, "stops at 250 deg/s again and again"),
        ({"clip_radps": 7.9}, "gyro_range", Level.WARN, "453 deg/s"),
        ({"clip_mps2": 19.6}, "accel_range", Level.ERROR, "stops at 2.0 g .* choose a larger range"),
        ({"clip_mps2": 39.2}, "accel_range", Level.WARN, "stops at 4.0 g"),
    ],
)
def test_a_range_that_ends_below_the_one_that_is_named_is_told(clip, kind, level, said):
    _, notices = taken(steps(**clip), clip_smallest_radps=1e6)
    assert re.search(said, notices[kind].text)
    assert (notices[kind].level, notices[kind].count) == (level, 1)
    _, notices = taken(steps(**clip), gyro_range_radps=clip.get("clip_radps", 34.9), accel_range_mps2=20.0)
    assert "gyro_range" not in notices


def test_the_end_of_a_range_is_told_the_same_in_whatever_pieces():
    imu, intake = steps(clip_mps2=19.6), Ingestion(IntakeParams())
    for i in range(0, length(imu), 7):
        intake.run(part(imu, i, i + 7))
    intake.finish()
    assert {n.kind: n for n in intake.notices}["accel_range"] == taken(imu)[1]["accel_range"]


def test_a_swing_that_is_not_cut_off_or_a_coarse_rest_has_no_end():
    coarse = still(2000)
    coarse.accel_mps2[::7] = [0.0, 0.0, 20.0]
    for imu in (steps(), coarse):
        assert {"gyro_range", "accel_range"}.isdisjoint(taken(imu, clip_smallest_radps=1e6)[1])


@pytest.mark.parametrize(
    ("period_ms", "level", "said"),
    [(25, Level.WARN, "40 times"), (5000, Level.ERROR, "0.2 times .* is the unit of the time right"), (20, None, "")],
)
def test_a_rate_that_is_too_low_is_told(period_ms, level, said):
    notices = taken(still(100, period_ms))[1]
    assert [(n.level, bool(re.search(said, n.text))) for k, n in notices.items() if k == "sample_rate"] == (
        [(level, True)] if level else []
    )


def test_a_rate_that_no_sensor_has_is_told():
    imu = still(100)._replace(stamp_ns=BEGIN_NS + np.arange(100, dtype=np.int64) * 10_000)
    assert "100000 times a second: is the unit of the time right?" in taken(imu)[1]["sample_rate"].text


def test_bursts_a_gap_and_a_clock_that_stands_are_no_rate():
    """The stamp policy tells of each."""
    at_ns = np.arange(100, dtype=np.int64) * 10 * MS
    late = np.where(np.arange(100) > 20, 60_000 * MS, 0)
    for stamps in (at_ns // (100 * MS) * (100 * MS), at_ns + late, np.zeros(100, np.int64)):
        assert "sample_rate" not in taken(still(100)._replace(stamp_ns=BEGIN_NS + stamps))[1]

import copy

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

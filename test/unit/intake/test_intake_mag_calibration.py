import subprocess
import sys

import numpy as np
import pytest

from pdr_core.intake.mag_axes import Axes, cross_matrices, found_axes, paired
from pdr_core.intake.mag_calibration import calibration
from pdr_core.intake.mag_checks import CalibrationError
from pdr_core.intake.mag_ellipsoid import algebraic, distance, fitted, repetition
from pdr_core.intake.mag_quality import coverage, directions, heading_sd_rad
from pdr_core.records import part
from support.turned_magnetometer import EARTH_FIELD, NORM_TESLA, Iron, heading_errors_rad, some_iron, turned

SWAPPED = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])  # as in the MPU-9250
MIRRORED = np.diag([1.0, 1.0, -1.0])
EXACT = {"noise_tesla": 0.0, "bias_radps": 0.0, "gyro_noise_radps": 0.0, "accel_noise_mps2": 0.0}


def deg(angle_rad):
    return float(np.rad2deg(angle_rad))


@pytest.mark.parametrize(
    "axes", [np.eye(3), SWAPPED, MIRRORED, -np.eye(3)], ids=["plain", "swapped", "mirrored", "all"]
)
def test_without_noise_the_truth_comes_back(axes):
    iron = some_iron(3, axes=axes)
    found = calibration(turned(iron, 3, **EXACT)[0], 48.0)
    scale = np.cbrt(abs(np.linalg.det(iron.distortion)))
    np.testing.assert_allclose(found.offset_tesla, iron.offset_tesla, atol=1e-11)
    np.testing.assert_allclose(found.matrix / scale, np.linalg.inv(iron.distortion), atol=2e-4)  # gyro: trapezoids
    assert found.field_norm_tesla == pytest.approx(NORM_TESLA * scale, rel=1e-6)
    assert deg(found.dip_rad) == pytest.approx(60.0, abs=0.01)
    assert np.linalg.det(found.axes) == pytest.approx(np.linalg.det(axes))
    assert deg(np.abs(heading_errors_rad(iron, found)).max()) < 0.02
    assert found.axes_from_gyro


def test_the_figures_of_a_calibration():
    found = calibration(turned(some_iron(1), 1, noise_tesla=0.8e-6)[0], 48.0)
    assert found.residual_tesla == pytest.approx(0.8e-6, rel=0.05)
    assert 0.05 < deg(found.heading_sd_rad) < 0.3
    assert found.coverage > 0.9
    assert (found.fields, found.duration_s) == (6000, pytest.approx(59.99))
    assert deg(found.dip_sd_rad) < 1.5


def test_south_of_the_equator_the_field_points_up():
    iron, earth = some_iron(2), EARTH_FIELD * [1.0, 1.0, -1.0]
    found = calibration(turned(iron, 2, earth=earth)[0], -34.0)
    assert deg(found.dip_rad) == pytest.approx(-60.0, abs=0.5)
    assert np.linalg.det(found.axes) > 0.0


def refusal(imu, latitude_deg=48.0):
    with pytest.raises(CalibrationError) as caught:
        calibration(imu, latitude_deg)
    text = str(caught.value)
    assert "\n" not in text
    assert any(word in text for word in ("turn the sensor", "set ", "record imu/mag"))
    return text


def test_a_field_that_points_up_needs_a_latitude():
    imu, _ = turned(some_iron(2, axes=MIRRORED), 2)
    assert "points 60 deg up" in refusal(imu, None)
    assert "place.latitude_deg" in refusal(imu, None)


@pytest.mark.parametrize("axes", [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)], ids=["yaw", "roll", "rest"])
@pytest.mark.parametrize("seed", [0, 2])
def test_a_turn_about_one_axis_is_refused(axes, seed):
    assert "turn the sensor slowly through all directions" in refusal(turned(some_iron(seed), seed, axes=axes)[0])


def test_a_small_part_of_the_sphere_is_refused():
    text = refusal(turned(some_iron(1), 1, axes=(0.1, 0.1, 1.0))[0])
    assert "of all directions that were seen leave the heading uncertain by" in text


def test_hardly_any_field_is_refused():
    imu, _ = turned(some_iron(0))
    none = imu._replace(field_sd_tesla=np.full(len(imu.stamp_ns), -1.0))
    assert refusal(none).startswith("there is no magnetic field")
    assert refusal(part(imu, 0, 300)).startswith("there are only 300 fields in 3.0 s")
    rare = imu.field_sd_tesla.copy()
    rare[np.arange(6000) % 40 > 0] = -1.0
    assert refusal(imu._replace(field_sd_tesla=rare)).startswith("there are only 150 fields in 59.6 s")


def test_a_disturbed_field_is_refused():
    imu, _ = turned(some_iron(1), 1)
    wander = np.sin(np.arange(6000)[:, None] / 500 + [0, 1, 2])
    assert "scatter by" in refusal(imu._replace(field_tesla=imu.field_tesla + 5e-6 * wander))
    assert "uncertain by" in refusal(imu._replace(field_tesla=imu.field_tesla + 2e-6 * wander))


@pytest.mark.parametrize("scale", [0.1, 1e4])
def test_a_wrong_unit_is_refused(scale):
    imu, _ = turned(some_iron(1), 1)
    assert "the Earth's is 22 to 67: set intake.mag_unit" in refusal(imu._replace(field_tesla=imu.field_tesla * scale))


def test_a_walk_makes_no_ellipsoid():
    rng = np.random.default_rng(0)
    x, y = rng.uniform(-1.0, 1.0, (2, 3000))
    saddle = np.column_stack([x, y, x * x - y * y]) * 20e-6 + 1e-7 * rng.standard_normal((3000, 3))
    assert fitted(saddle) is None


def test_a_second_beside_iron_counts_little():
    iron = some_iron(0)
    imu, _ = turned(iron, 0)
    imu.field_tesla[2000:2100] += [16e-6, 0.0, 8e-6]
    assert deg(np.abs(heading_errors_rad(iron, calibration(imu, 48.0))).max()) < 1.0


def without_gyro(imu):
    return imu._replace(gyro_sd_radps=np.full(len(imu.stamp_ns), -1.0))


def test_without_a_gyro_the_axes_are_taken_to_be_its_own():
    offset = np.array([1e-5, 0.0, -2e-5])
    shape = np.array([[1.1, 0.05, 0.0], [0.05, 0.95, 0.1], [0.0, 0.1, 1.0]])
    iron = Iron(offset, shape)
    found = calibration(without_gyro(turned(iron, 4)[0]), 48.0)
    assert not found.axes_from_gyro
    np.testing.assert_array_equal(found.axes, np.eye(3))
    assert deg(np.abs(heading_errors_rad(iron, found)).max()) < 1.0


def test_without_a_gyro_axes_that_do_not_fit_are_refused():
    assert "the dip differs by" in refusal(without_gyro(turned(some_iron(0, axes=SWAPPED), 0)[0]))


def test_a_gyro_that_has_nothing_to_do_with_it_tells_no_axes():
    imu, _ = turned(some_iron(0), 0)
    ellipsoid = fitted(imu.field_tesla)
    assert found_axes(imu, ellipsoid.sphere(imu.field_tesla)) is not None
    other = imu._replace(gyro_radps=np.roll(imu.gyro_radps, 3000, axis=0))
    assert found_axes(other, ellipsoid.sphere(imu.field_tesla)) is None


def test_turns_about_one_axis_do_not_tell_the_axes():
    imu, _ = turned(Iron(np.zeros(3), np.eye(3)), 0, axes=(0.0, 0.0, 0.0))
    assert found_axes(imu, imu.field_tesla / NORM_TESLA) is None


def test_a_sensor_that_is_never_slow_has_no_dip():
    imu, _ = turned(some_iron(0), 0)
    found = calibration(imu._replace(accel_mps2=2.0 * imu.accel_mps2), 48.0)
    assert found.dip_rad is None


def test_pairs_do_not_reach_across_a_gap():
    imu, _ = turned(some_iron(0), 0, rate_radps=0.5, **EXACT)
    whole = len(paired(imu, imu.field_tesla).before)
    imu.stamp_ns[3000:] += 10**9
    assert whole == pytest.approx(5950, abs=1)  # the window is found by seconds that are added up
    assert len(paired(imu, imu.field_tesla).before) == pytest.approx(whole - 50, abs=1)


def test_pairs_turn_as_their_fields_do():
    imu, _ = turned(Iron(np.zeros(3), np.eye(3)), 0, **EXACT)
    pairs = paired(imu, imu.field_tesla / NORM_TESLA)
    middle = 0.5 * (pairs.before + pairs.after)
    np.testing.assert_allclose(pairs.after - pairs.before, np.cross(middle, pairs.turn), atol=1e-5)
    np.testing.assert_allclose(
        np.einsum("nij,nj->ni", cross_matrices(middle), pairs.turn), np.cross(middle, pairs.turn)
    )


def test_half_a_sphere_with_noise_shows_its_centre_without_bias():
    """The sum of (| shape x | - 1)^2 is less for a smaller shape where there is noise; that of distances is not."""
    rng, up = np.random.default_rng(0), directions(4000)[:2000]
    noisy = (NORM_TESLA * (up + 0.014 * rng.standard_normal(up.shape)) for _ in range(15))
    off = np.array([fitted(field).centre_tesla[2] / NORM_TESLA for field in noisy])
    assert abs(off.mean()) < 3.0 * off.std() / np.sqrt(15)
    assert off.std() < 0.01


def test_distances_are_those_to_the_ellipsoid():
    shape, centre = np.diag([1.0, 0.5, 0.8]), np.array([0.1, -0.2, 0.3])
    surface = centre + directions(50) @ np.linalg.inv(shape)
    normal = directions(50) @ shape
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    np.testing.assert_allclose(distance(surface + 1e-4 * normal, centre, shape), 1e-4, rtol=1e-3)
    for found, true in zip(algebraic(surface), (centre, shape), strict=True):
        np.testing.assert_allclose(found, true, atol=1e-10)


def test_residuals_that_follow_each_other_tell_less():
    rng = np.random.default_rng(0)
    white = rng.standard_normal(20_000)
    correlated = np.empty_like(white)
    correlated[0] = white[0]
    for i in range(1, len(white)):
        correlated[i] = 0.9 * correlated[i - 1] + white[i]
    assert repetition(white) == pytest.approx(1.0, abs=0.1)
    assert repetition(correlated) == pytest.approx(19.0, rel=0.25)  # (1 + .9) / (1 - .9)
    assert repetition(np.zeros(10)) == 1.0


def test_coverage_counts_directions():
    assert coverage(directions(1000)) == 1.0
    assert coverage(np.tile([0.0, 0.0, 1.0], (10, 1))) == 1 / 64
    half = directions(1000)
    assert 0.45 < coverage(half[half[:, 2] > 0.0]) < 0.6


def test_a_steeper_field_leaves_the_heading_less_certain():
    ellipsoid = fitted(turned(some_iron(0), 0)[0].field_tesla)
    flat, steep = (heading_sd_rad(ellipsoid, None, np.deg2rad(dip)) for dip in (0.0, 60.0))
    assert steep == pytest.approx(2.0 * flat)


def test_axes_that_are_not_certain_leave_the_heading_less_certain():
    ellipsoid, one_degree = fitted(turned(some_iron(0), 0)[0].field_tesla), np.deg2rad(1.0)
    axes = Axes(np.eye(3), one_degree**2 * np.eye(3))
    alone = heading_sd_rad(ellipsoid, None, 0.0)
    assert heading_sd_rad(ellipsoid, axes, 0.0) == pytest.approx(np.hypot(alone, one_degree), rel=1e-6)


def test_starting_up_does_not_load_the_optimiser():
    code = "import sys, pdr_core.pipeline, pdr_core.intake; sys.exit('scipy.optimize' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0

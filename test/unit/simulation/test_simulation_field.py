"""The magnetic field along a walk, and what a magnetometer gives of it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import SimulationParams
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.magnetic_field import building_tesla, earth_tesla, field_tesla
from pdr_core.simulation.magnetometer import Magnetometer
from pdr_core.simulation.sensors import SENSOR_MODELS

WALK = SimulationParams(motion="smooth", walk="curve", walk_length_m=17.0, sensor_model="ideal", magnetometer=True)
NORTH_DOWN = 50e-6 * np.array([0.0, 0.5, -np.sqrt(0.75)])  # dip 60 degrees
UT = 1e-6


def with_magnetometer(**values):
    return SensorModel(magnetometer=Magnetometer(**values))


def in_world(walk):
    return Rotation.from_quat(walk.motion.quat_xyzw).apply(walk.imu.field_tesla)


def test_the_field_of_the_earth_points_north_and_down_and_declines_to_the_east():
    np.testing.assert_allclose(earth_tesla(WALK), NORTH_DOWN, atol=1e-20)
    east = earth_tesla(replace(WALK, field_declination_deg=90.0, field_dip_deg=-30.0, field_norm_tesla=40e-6))
    np.testing.assert_allclose(east, 40e-6 * np.array([np.sqrt(0.75), 0.0, 0.5]), atol=1e-20)


def test_a_perfect_magnetometer_gives_the_field_of_the_earth_along_its_axes():
    walk = simulated_walk(WALK)
    np.testing.assert_allclose(in_world(walk), np.tile(NORTH_DOWN, (len(walk.imu.stamp_ns), 1)), atol=1e-15)
    np.testing.assert_array_equal(walk.imu.field_sd_tesla, 0.0)
    mounting = Rotation.from_euler("xyz", [0.4, -0.7, 2.0])
    mounted = simulated_walk(
        replace(WALK, mounting_roll_rad=0.4, mounting_pitch_rad=-0.7, mounting_yaw_rad=2.0)
    ).imu.field_tesla
    np.testing.assert_allclose(mounting.apply(mounted), walk.imu.field_tesla, atol=1e-15)


def test_without_a_magnetometer_no_sample_has_a_field():
    imu = simulated_walk(replace(WALK, magnetometer=False)).imu
    np.testing.assert_array_equal(imu.field_sd_tesla, -1.0)
    np.testing.assert_array_equal(imu.field_tesla, 0.0)


@pytest.mark.parametrize("model", SENSOR_MODELS)
def test_a_magnetometer_changes_nothing_else(model):
    params = replace(WALK, sensor_model=model, shock_mps2=30.0, indoor_field=0.2)
    with_field, without = (simulated_walk(replace(params, magnetometer=m)).imu for m in (True, False))
    np.testing.assert_array_equal(with_field.gyro_radps, without.gyro_radps)
    np.testing.assert_array_equal(with_field.accel_mps2, without.accel_mps2)


def test_a_slower_magnetometer_leaves_samples_without_a_field():
    walk = simulated_walk(replace(WALK, magnetometer_rate_hz=50.0))
    measured = walk.imu.field_sd_tesla >= 0.0
    assert measured[:8].tolist() == [True, False, False, False] * 2
    assert measured.sum() == np.ceil(len(measured) / 4)
    np.testing.assert_array_equal(walk.imu.field_tesla[~measured], 0.0)
    np.testing.assert_array_equal(walk.imu.field_tesla[measured], simulated_walk(WALK).imu.field_tesla[measured])
    odd = simulated_walk(replace(WALK, magnetometer_rate_hz=70.0)).imu.field_sd_tesla >= 0.0
    assert odd.sum() == pytest.approx(0.35 * len(odd), abs=1.0)
    assert set(np.diff(np.flatnonzero(odd))) == {2, 3}
    assert np.all(simulated_walk(replace(WALK, magnetometer_rate_hz=1000.0)).imu.field_sd_tesla == 0.0)


def test_iron_noise_and_range():
    soft = ((1.1, 0.05, 0.0), (0.05, 0.9, 0.0), (0.0, 0.0, 1.0))
    true = simulated_walk(WALK).imu.field_tesla
    iron = simulated_walk(WALK, model=with_magnetometer(hard_iron_tesla=(10 * UT, -5 * UT, 0.0), soft_iron=soft)).imu
    np.testing.assert_allclose(iron.field_tesla, true @ np.array(soft).T + [10 * UT, -5 * UT, 0.0], atol=1e-15)
    noisy = simulated_walk(WALK, model=with_magnetometer(noise_tesla=0.4 * UT)).imu
    noise = noisy.field_tesla - true
    assert noise.std() == pytest.approx(0.4 * UT, rel=0.03)
    assert np.abs(np.corrcoef(noise[1:, 0], noise[:-1, 0])[0, 1]) < 0.1
    np.testing.assert_array_equal(noisy.field_sd_tesla, 0.4 * UT)
    clipped = simulated_walk(WALK, model=with_magnetometer(range_tesla=30 * UT)).imu.field_tesla
    np.testing.assert_array_equal(clipped, np.clip(true, -30 * UT, 30 * UT))
    assert np.abs(true).max() > 40 * UT


def test_iron_is_drawn_from_the_seed_where_the_model_says_so():
    magnetometer = Magnetometer(hard_iron_tesla=(1.0, 2.0, 3.0), hard_iron_sd_tesla=0.5, soft_iron_sd=0.1)
    drawn = [magnetometer.iron(seed) for seed in range(400)]
    soft, hard = np.array([d[0] for d in drawn]), np.array([d[1] for d in drawn])
    np.testing.assert_array_equal(soft[7], magnetometer.iron(7)[0])
    np.testing.assert_array_equal(soft, soft.transpose(0, 2, 1))
    np.testing.assert_allclose(hard.mean(0), [1.0, 2.0, 3.0], atol=0.1)
    np.testing.assert_allclose(hard.std(0), 0.5, rtol=0.15)
    np.testing.assert_allclose(soft.mean(0), np.eye(3), atol=0.02)
    np.testing.assert_allclose(soft.std(0), 0.1, rtol=0.15)


def test_a_disturbance_is_there_for_its_time_only():
    params = replace(
        WALK, disturbance_tesla=20 * UT, disturbance_azimuth_deg=30.0, disturbance_start_s=4.0, disturbance_s=3.0
    )
    walk = simulated_walk(params, start_ns=10**18)
    beside = in_world(walk) - NORTH_DOWN
    time_s = (walk.imu.stamp_ns - 10**18) * 1e-9
    on = (time_s >= 4.0) & (time_s < 7.0)
    np.testing.assert_allclose(beside[on], np.tile(20 * UT * np.array([np.sqrt(0.75), 0.5, 0.0]), (600, 1)), atol=1e-15)
    np.testing.assert_allclose(beside[~on], 0.0, atol=1e-15)


def test_a_building_disturbs_as_much_as_it_says():
    """Between stances norm +-20 %, azimuth +-20 degrees, as measured on real walks; and no two stances alike."""
    norms, azimuths, uprights = [], [], []
    places = np.column_stack([np.arange(0.0, 60.0, 1.4), np.zeros(43), np.zeros(43)])
    for seed in range(30):
        field = field_tesla(replace(WALK, indoor_field=0.25, seed=seed), np.zeros(43), places)
        norms.append(np.linalg.norm(field, axis=1) / 50e-6)
        azimuths.append(np.degrees(np.arctan2(field[:, 0], field[:, 1])))
        uprights.append((field - NORTH_DOWN)[:, 2])
    assert 0.15 < np.std(norms) < 0.3
    assert 15.0 < np.std(azimuths) < 32.0
    assert np.sqrt(np.mean(np.square(uprights))) == pytest.approx(0.25 * 50e-6, rel=0.1)
    neighbours = [np.corrcoef(u[1:], u[:-1])[0, 1] for u in uprights]
    assert np.mean(neighbours) < 0.8


def test_the_field_of_a_building_has_no_curl_and_is_the_same_for_a_standing_foot():
    def at(x_m, y_m):
        return building_tesla(10 * UT, 3, np.array([[x_m, y_m, 0.0]]))[0]

    step_m = 1e-4
    by_x = (at(1.0 + step_m, 2.0) - at(1.0 - step_m, 2.0)) / (2 * step_m)
    by_y = (at(1.0, 2.0 + step_m) - at(1.0, 2.0 - step_m)) / (2 * step_m)
    assert by_x[1] == pytest.approx(by_y[0], abs=1e-11)
    assert np.abs([by_x, by_y]).max() > 1 * UT
    still = simulated_walk(replace(WALK, walk="still", indoor_field=0.25)).imu.field_tesla
    np.testing.assert_allclose(still, np.tile(still[0], (len(still), 1)), atol=1e-18)
    assert np.linalg.norm(still[0] - NORTH_DOWN) > 1 * UT


def test_a_seed_repeats_the_field_and_another_does_not():
    params = replace(WALK, sensor_model="consumer", indoor_field=0.25)
    one, again, other = (simulated_walk(replace(params, seed=s)).imu.field_tesla for s in (1, 1, 2))
    np.testing.assert_array_equal(one, again)
    assert not np.any(one == other)

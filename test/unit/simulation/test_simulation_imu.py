"""What the simulated sensor gives: truth, Earth, mounting, bias, noise, range, shocks."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.conventions import gravity_mps2
from pdr_core.intake import Ingestion
from pdr_core.params import IntakeParams, PlaceParams, SimulationParams
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.imu_model import SensorModel, point_samples
from pdr_core.simulation.sensors import SENSOR_MODELS
from pdr_core.simulation.shocks import SHOCK_S
from pdr_core.simulation.walk import course

G = gravity_mps2(np.radians(45.0))
IDEAL = {"walk_length_m": 6.0, "motion": "smooth", "sensor_model": "ideal"}
STRAIGHT = {**IDEAL, "walk": "straight"}


def test_the_specific_force_is_acceleration_and_gravity_in_the_foot_frame():
    walk = simulated_walk(SimulationParams(**STRAIGHT))
    world = Rotation.from_quat(walk.motion.quat_xyzw).apply(walk.imu.accel_mps2)
    np.testing.assert_allclose(world, walk.motion.acceleration_mps2 + np.array([0.0, 0.0, G]), atol=1e-11)
    np.testing.assert_array_equal(walk.imu.gyro_radps, walk.motion.rate_radps)


def test_table_1_of_the_sensor():
    printed, deg = SENSOR_MODELS["gui_table_1"], SENSOR_MODELS["gui_table_1_deg"]
    np.testing.assert_allclose(np.degrees(printed.gyro_bias_radps), [1.5, 2.0, 1.2], atol=1e-3)
    assert printed.accel_bias_mps2 == (0.1, 0.2, 0.15)
    assert (printed.gyro_noise_density, printed.accel_noise_density) == (0.1, 0.1)
    assert np.degrees(deg.gyro_noise_density) == pytest.approx(0.1)
    assert replace(deg, gyro_noise_density=0.1) == printed


@pytest.mark.parametrize(
    "model", [name for name, sensor in SENSOR_MODELS.items() if not (sensor.filters or sensor.gyro_scale_sd)]
)
@pytest.mark.parametrize("motion", ["gui", "smooth"])
def test_the_samples_are_points_of_the_truth_with_bias_and_noise(model, motion):
    params = SimulationParams(motion=motion, walk="straight", walk_length_m=12.0, sensor_model=model)
    walk, sensor = simulated_walk(params, start_ns=10**18), SENSOR_MODELS[model]
    np.testing.assert_array_equal(walk.imu.stamp_ns[:3], 10**18 + np.array([0, 5_000_000, 10_000_000]))
    true_gyro, true_accel = point_samples(walk.motion, G)
    bent = true_accel * sensor.gyro_g_sensitivity
    gyro = walk.imu.gyro_radps - true_gyro - bent - sensor.gyro_bias_radps
    accel = walk.imu.accel_mps2 - true_accel - sensor.accel_bias_mps2
    for noise, density in ((gyro, sensor.gyro_noise_density), (accel, sensor.accel_noise_density)):
        sd = density * np.sqrt(200.0)
        assert noise.std() == pytest.approx(sd, rel=0.02, abs=1e-14)
        assert np.abs(noise.mean(0)).max() < 4 * sd / np.sqrt(len(noise)) + 1e-14


def test_biases_are_drawn_from_the_seed_where_the_model_says_so():
    model = SensorModel(gyro_bias_radps=(0.1, 0.2, 0.3), gyro_bias_sd_radps=0.01, accel_bias_sd_mps2=0.05)
    drawn = np.array([model.biases(seed) for seed in range(400)])  # (400, 2, 3)
    np.testing.assert_array_equal(drawn[7], model.biases(7))
    for kind, mean, sd in ((0, [0.1, 0.2, 0.3], 0.01), (1, [0.0, 0.0, 0.0], 0.05)):
        np.testing.assert_allclose(drawn[:, kind].mean(0), mean, atol=4 * sd / 20)
        np.testing.assert_allclose(drawn[:, kind].std(0), sd, rtol=0.15)
    walk = simulated_walk(SimulationParams(walk="still", seed=7), model=model)
    np.testing.assert_array_equal(walk.imu.gyro_radps[0], drawn[7, 0])


def test_a_seed_repeats_and_another_does_not():
    one, again, other = (simulated_walk(SimulationParams(seed=s, shock_mps2=50.0)).imu for s in (1, 1, 2))
    np.testing.assert_array_equal(one.gyro_radps, again.gyro_radps)
    np.testing.assert_array_equal(one.accel_mps2, again.accel_mps2)
    assert not np.any(one.gyro_radps == other.gyro_radps)


@pytest.mark.parametrize("latitude_deg", [-90.0, 0.0, 31.3])
def test_the_gyro_feels_the_earth_turn_on_request(latitude_deg):
    place = PlaceParams(latitude_deg=latitude_deg)
    walk = simulated_walk(SimulationParams(**STRAIGHT, earth_rate=True), place)
    beside = walk.imu.gyro_radps - walk.motion.rate_radps
    world = Rotation.from_quat(walk.motion.quat_xyzw).apply(beside)
    day_radps = 2.0 * np.pi / 86164.0905  # a sidereal day
    expected = day_radps * np.array([0.0, np.cos(np.radians(latitude_deg)), np.sin(np.radians(latitude_deg))])
    np.testing.assert_allclose(world, np.tile(expected, (len(world), 1)), atol=1e-10)


def test_gravity_is_that_of_the_place():
    pole = simulated_walk(SimulationParams(walk="still", sensor_model="ideal"), PlaceParams(latitude_deg=90.0))
    np.testing.assert_allclose(pole.imu.accel_mps2[:, 2], 9.8321849, atol=1e-6)


@pytest.mark.parametrize("angles", [(0.4, -0.7, 2.0), (3.1, 0.0, 0.0), (0.0, 1.2, -3.0)])
def test_the_intake_undoes_any_mounting(angles):
    mounting = dict(zip(("mounting_roll_rad", "mounting_pitch_rad", "mounting_yaw_rad"), angles, strict=True))
    plain = simulated_walk(SimulationParams(**STRAIGHT)).imu
    mounted = simulated_walk(SimulationParams(**STRAIGHT, **mounting)).imu
    assert np.abs(mounted.accel_mps2 - plain.accel_mps2).max() > 1.0
    back = Ingestion(IntakeParams(**mounting)).run(mounted)
    np.testing.assert_allclose(back.gyro_radps, plain.gyro_radps, atol=1e-12)
    np.testing.assert_allclose(back.accel_mps2, plain.accel_mps2, atol=1e-12)


def test_a_sensor_clips_at_its_range():
    free = simulated_walk(SimulationParams(**STRAIGHT)).imu
    clipped = simulated_walk(SimulationParams(**STRAIGHT, gyro_range_radps=5.0, accel_range_mps2=30.0)).imu
    for kind, limit in (("gyro_radps", 5.0), ("accel_mps2", 30.0)):
        whole, cut = getattr(free, kind), getattr(clipped, kind)
        assert np.abs(whole).max() > limit == np.abs(cut).max()
        inside = np.abs(whole) <= limit
        np.testing.assert_array_equal(cut[inside], whole[inside])
    sprint = SimulationParams(motion="smooth", walk="run", pace=2.5, sensor_model="consumer", shock_mps2=300.0)
    assert np.abs(simulated_walk(sprint).imu.accel_mps2).max() == 156.9  # as the model says


def test_shocks_are_felt_at_heel_strikes_and_do_not_move_the_foot():
    params = SimulationParams(**STRAIGHT, sample_rate_hz=2000.0)
    quiet, shaken = (simulated_walk(replace(params, shock_mps2=s)) for s in (0.0, 80.0))
    np.testing.assert_array_equal(quiet.motion.position_m, shaken.motion.position_m)
    np.testing.assert_array_equal(quiet.imu.gyro_radps, shaken.imu.gyro_radps)
    felt = shaken.imu.accel_mps2 - quiet.imu.accel_mps2
    time, strikes = shaken.imu.stamp_ns * 1e-9, course(params).strikes_s
    shocks = [felt[(time >= s) & (time < s + SHOCK_S)] for s in strikes]
    assert sum(np.any(s != 0.0, axis=1).sum() for s in shocks) == np.any(felt != 0.0, axis=1).sum()
    peaks = [np.linalg.norm(s, axis=1).max() for s in shocks]
    assert 38.0 < min(peaks) < max(peaks) < 80.0
    assert np.ptp(peaks) > 1.0
    assert min(s[:, 2].sum() for s in shocks) > 0.0


@pytest.mark.parametrize("rate_hz", [20.0, 133.0, 4000.0])
def test_any_rate_samples_the_same_motion(rate_hz):
    walk = simulated_walk(SimulationParams(**STRAIGHT, sample_rate_hz=rate_hz))
    duration_s = course(SimulationParams(**STRAIGHT)).duration_s
    assert len(walk.imu.stamp_ns) == round(duration_s * rate_hz)
    np.testing.assert_allclose(np.diff(walk.imu.stamp_ns), 1e9 / rate_hz, atol=1.0)
    np.testing.assert_allclose(walk.motion.position_m[-1], [5.6, 0.0, 0.0], atol=1e-12)

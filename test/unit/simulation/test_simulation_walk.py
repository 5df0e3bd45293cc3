import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.conventions import gravity_mps2
from pdr_core.params import DriverParams, PlaceParams
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.foot_motion import (
    MAX_PITCH_RAD,
    STANCE_S,
    STEP_HEIGHT_M,
    STEP_LENGTH_M,
    SWING_S,
    TURN_S,
    Phase,
    move,
    steps,
    turn,
)
from pdr_core.simulation.imu_model import SENSOR_MODELS, body_rate_radps, orientation, specific_force_mps2

PHASES = [Phase(0.5), *steps(2), *turn(1.3), *steps(1)]
H = 1e-5


def smooth_times():
    """Return times away from the joints of the phases, where the acceleration jumps."""
    joints = np.cumsum([0.0] + [p.duration_s for p in PHASES])
    time = np.linspace(0.01, joints[-1] - 0.01, 997)
    return time[np.abs(time[:, None] - joints).min(1) > 3 * H]


def test_the_derivatives_are_those_of_the_motion():
    t = smooth_times()
    before, at, after = (move(PHASES, t + s * H) for s in (-1, 0, 1))
    np.testing.assert_allclose((after.position_m - before.position_m) / (2 * H), at.velocity_mps, atol=1e-7)
    np.testing.assert_allclose((after.velocity_mps - before.velocity_mps) / (2 * H), at.acceleration_mps2, atol=1e-7)


def test_the_body_rate_turns_the_attitude():
    t = smooth_times()
    before, at, after = (move(PHASES, t + s * H) for s in (-1, 0, 1))
    turned = (orientation(before).inv() * orientation(after)).as_rotvec() / (2 * H)
    np.testing.assert_allclose(turned, body_rate_radps(at), atol=1e-7)


def test_the_specific_force_is_acceleration_and_gravity_in_the_foot_frame():
    at = move(PHASES, smooth_times())
    world = orientation(at).apply(specific_force_mps2(at, 9.8))
    np.testing.assert_allclose(world, at.acceleration_mps2 + np.array([0.0, 0.0, 9.8]), atol=1e-12)


def test_position_and_attitude_do_not_jump():
    motion = move(PHASES, np.arange(0.0, 7.0, 1e-4))
    assert np.abs(np.diff(motion.position_m, axis=0)).max() < 2.0 * 1e-4  # top speed pi / 2 * 1.2 m/s
    assert np.abs(np.diff(motion.velocity_mps, axis=0)).max() < 12.0 * 1e-4
    assert np.abs(np.diff(motion.pitch_rad)).max() < 2.0 * 1e-4


def test_one_step_has_the_numbers_of_table_1():
    assert (STEP_LENGTH_M, STEP_HEIGHT_M, SWING_S, STANCE_S, MAX_PITCH_RAD, TURN_S) == (1.2, 0.15, 1.0, 0.5, 0.6, 0.5)
    middle = move(steps(1), np.array([0.5]))
    np.testing.assert_allclose(middle.position_m, [[0.6, 0.0, 0.15]])
    assert middle.pitch_rad[0] == pytest.approx(-0.6)  # toe up: about the left axis it is negative
    toe = orientation(middle).apply([1.0, 0.0, 0.0])[0]
    assert toe[2] > 0.0
    np.testing.assert_allclose(move(steps(1), np.array([1.0, 1.5])).position_m, [[1.2, 0, 0]] * 2, atol=1e-12)


def test_table_1_of_the_sensor():
    model = SENSOR_MODELS["gui_table_1"]
    np.testing.assert_allclose(np.degrees(model.gyro_bias_radps), [1.5, 2.0, 1.2], atol=1e-3)
    assert model.accel_bias_mps2 == (0.1, 0.2, 0.15)
    assert (model.gyro_noise_density, model.accel_noise_density) == (0.1, 0.1)


def test_the_stance_flags_are_guis_phases():
    time = np.arange(0.0, 6.0, 0.01) + 0.001
    motion = move([*steps(2), *turn(np.pi / 2), *steps(1)], time)
    expected = np.array([t % 1.5 >= 1.0 if t < 3.0 else (3.5 <= t < 4.0 or t >= 5.0) for t in time])
    np.testing.assert_array_equal(motion.stance, expected)
    assert not motion.velocity_mps[motion.stance].any()
    assert not body_rate_radps(motion)[motion.stance].any()


def test_a_turn_is_on_the_spot_and_left_is_positive():
    end = move([*turn(np.pi / 2), *steps(1)], np.array([0.25, 0.5, 3.0]))
    np.testing.assert_allclose(end.yaw_rad, [np.pi / 4, np.pi / 2, np.pi / 2])
    np.testing.assert_allclose(end.position_m[1], 0.0, atol=1e-15)
    np.testing.assert_allclose(end.position_m[2], [0.0, 1.2, 0.0], atol=1e-12)


@pytest.mark.parametrize("length_m", [3.0, 24.0, 36.0, 100.0])
def test_the_rectangle_closes(length_m):
    walk = simulated_walk(DriverParams(walk="rectangle", walk_length_m=length_m))
    np.testing.assert_allclose(walk.motion.position_m[-1], 0.0, atol=1e-9)
    assert walk.motion.yaw_rad[-1] == pytest.approx(2 * np.pi)
    walked = np.linalg.norm(np.diff(walk.motion.position_m[:, :2], axis=0), axis=1).sum()
    assert walked == pytest.approx(max(length_m, 4.8), abs=2.5)


@pytest.mark.parametrize(("walk", "end_m"), [("straight", [12.0, 0, 0]), ("still", [0, 0, 0])])
def test_walks_by_name(walk, end_m):
    motion = simulated_walk(DriverParams(walk=walk, walk_length_m=12.0)).motion
    np.testing.assert_allclose(motion.position_m[-1], end_m, atol=1e-12)


@pytest.mark.parametrize("model", ["ideal", "consumer", "gui_table_1"])
def test_the_samples_are_points_of_the_truth_with_bias_and_noise(model):
    params = DriverParams(walk="straight", walk_length_m=12.0, sensor_model=model, sample_rate_hz=200.0)
    walk, sensor = simulated_walk(params, start_ns=10**18), SENSOR_MODELS[model]
    np.testing.assert_array_equal(walk.imu.stamp_ns[:3], 10**18 + np.array([0, 5_000_000, 10_000_000]))
    gravity = gravity_mps2(np.radians(45.0))
    gyro = walk.imu.gyro_radps - body_rate_radps(walk.motion) - sensor.gyro_bias_radps
    accel = walk.imu.accel_mps2 - specific_force_mps2(walk.motion, gravity) - sensor.accel_bias_mps2
    for noise, density in ((gyro, sensor.gyro_noise_density), (accel, sensor.accel_noise_density)):
        sd = density * np.sqrt(200.0)
        assert noise.std() == pytest.approx(sd, rel=0.02, abs=1e-14)
        assert np.abs(noise.mean(0)).max() < 4 * sd / np.sqrt(len(noise)) + 1e-14


def test_a_seed_repeats_and_another_does_not():
    one, again, other = (simulated_walk(DriverParams(seed=s)).imu for s in (1, 1, 2))
    np.testing.assert_array_equal(one.gyro_radps, again.gyro_radps)
    np.testing.assert_array_equal(one.accel_mps2, again.accel_mps2)
    assert not np.any(one.gyro_radps == other.gyro_radps)


def test_the_attitude_and_the_place_are_those_asked_for():
    pole = simulated_walk(DriverParams(walk="still", sensor_model="ideal"), PlaceParams(latitude_deg=90.0))
    np.testing.assert_allclose(pole.imu.accel_mps2[:, 2], 9.8321849, atol=1e-6)
    walk = simulated_walk(DriverParams())
    assert (Rotation.from_quat(walk.quat_xyzw).inv() * orientation(walk.motion)).magnitude().max() < 1e-9
    np.testing.assert_array_equal(walk.truth.position_m, walk.motion.position_m)

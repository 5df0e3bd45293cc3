"""The simulated chest: its derivatives, its way, and the figures that its sources give."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.conventions import seconds_between
from pdr_core.parameter import ParameterError
from pdr_core.params import SimulationParams
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.chest_person import STANDING_MPS2, WALK_RATIO, person
from pdr_core.simulation.chest_steps import CALIBRATION_M, stretches
from pdr_core.simulation.instability import wandering
from pdr_core.simulation.walk import course

IDEAL = SimulationParams(
    motion="chest", walk="rectangle", walk_length_m=44.0, sensor_model="ideal", sample_rate_hz=400.0, seed=3
)


@pytest.fixture(scope="module")
def walk():
    return simulated_walk(IDEAL)


def seconds(walk):
    return seconds_between(walk.imu.stamp_ns, 0)


def test_velocity_and_acceleration_are_the_derivatives(walk):
    time_s, true = seconds(walk), walk.motion
    assert np.allclose(np.gradient(true.position_m, time_s, axis=0)[1:-1], true.velocity_mps[1:-1], atol=1e-3)
    assert np.allclose(np.gradient(true.velocity_mps, time_s, axis=0)[1:-1], true.acceleration_mps2[1:-1], atol=1e-2)


def test_the_rate_turns_the_attitude(walk):
    attitude = Rotation.from_quat(walk.motion.quat_xyzw)
    turned = (attitude[:-1].inv() * attitude[1:]).as_rotvec() * IDEAL.sample_rate_hz
    mean = 0.5 * (walk.motion.rate_radps[1:] + walk.motion.rate_radps[:-1])
    assert np.allclose(turned, mean, atol=1e-3)


def test_a_rectangle_closes_and_has_its_length(walk):
    falls = np.interp(course(IDEAL).strikes_s, seconds(walk), walk.motion.position_m[:, 0])
    assert np.linalg.norm(walk.motion.position_m[-1]) < 0.02  # a standing body sways
    assert np.ptp(falls) == pytest.approx(44.0 / 3.0, abs=0.3)


def test_steps_are_as_long_as_the_walk_ratio_says():
    someone = person(5)
    assert 1.0 <= someone.speed_mps <= 1.5
    assert someone.step_m * someone.step_s == pytest.approx(WALK_RATIO)
    falls_s = course(replace(IDEAL, seed=5)).strikes_s
    assert np.median(np.diff(falls_s)) == pytest.approx(someone.step_s, rel=0.03)


def test_the_body_is_lowest_and_fastest_at_a_footfall(walk):
    falls_s = course(IDEAL).strikes_s[3:10]
    rows = np.searchsorted(seconds(walk), falls_s)
    between = np.searchsorted(seconds(walk), falls_s[:-1] + 0.5 * np.diff(falls_s))
    assert walk.motion.position_m[rows, 2].max() < walk.motion.position_m[between, 2].min()
    assert walk.motion.velocity_mps[rows, 0].min() > walk.motion.velocity_mps[between, 0].max()


def test_standing_people_show_what_was_measured():
    still = [simulated_walk(replace(IDEAL, walk="still", sample_rate_hz=50.0, seed=s)) for s in range(40)]
    shown = [w.imu.accel_mps2.T for w in still]
    level = np.concatenate([a[:2] - a[:2].mean(axis=1, keepdims=True) for a in shown], axis=1)
    assert np.sqrt(np.mean(level**2)) == pytest.approx(STANDING_MPS2, rel=0.2)


def test_a_long_walk_begins_with_a_short_one():
    assert [part.length_m for part in stretches("straight", 100.0)] == [CALIBRATION_M, 100.0]
    with pytest.raises(ParameterError, match="only rectangle, straight and still"):
        stretches("stairs", 10.0)


def test_a_bias_wanders_by_its_deviation_and_slowly():
    bias = wandering(200_000, 10.0, 0.3, 100.0, np.random.default_rng(1))
    assert np.std(bias) == pytest.approx(0.3, rel=0.15)
    later = np.mean(bias[1000:] * bias[:-1000]) / np.mean(bias**2)  # 100 s later
    assert later == pytest.approx(np.exp(-1.0), abs=0.15)


def test_the_seed_gives_another_person_and_another_sensor():
    real = replace(IDEAL, sensor_model="icm_20602", walk="still", sample_rate_hz=100.0)
    one, again, other = (simulated_walk(replace(real, seed=s)) for s in (1, 1, 2))
    assert np.array_equal(one.imu.gyro_radps, again.imu.gyro_radps)
    bias = one.imu.gyro_radps.mean(axis=0) - other.imu.gyro_radps.mean(axis=0)
    assert np.abs(bias).max() > np.radians(0.1)

"""Every method of orientation follows a sensor that turns on the spot, whose orientation gravity and field tell."""

import itertools
import sys

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.bench.mocap_gait import study
from pdr_core.bench.orientations import ORIENTATIONS, CannotOrient
from pdr_core.bench.trial import NoSamples, Walk
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.records import ImuBlock, StanceBlock, part
from pdr_core.simulation import simulated_walk

RATE_HZ, G = 100, 9.80665
FIELD = np.array([0.0, 2.0e-5, -4.0e-5])  # of a world whose y is north
SECONDS = 12.0


def turning(start=(0.1, -0.2, 0.6)):
    """Judged samples of a sensor that turns slowly about all its axes after a second of rest, and its orientations."""
    n = round(SECONDS * RATE_HZ)
    time_s = np.arange(n) / RATE_HZ
    swing = np.clip(time_s - 1.0, 0.0, None)[:, None]
    rate = swing.clip(0, 1) * np.column_stack([0.4 * np.sin(time_s), 0.3 * np.cos(0.7 * time_s), 0.2 + 0 * time_s])
    turns = [Rotation.from_euler("xyz", start)]
    for before, after in itertools.pairwise(rate):
        turns.append(turns[-1] * Rotation.from_rotvec((before + after) / 2 / RATE_HZ))
    true = Rotation.concatenate(turns)
    stamps = np.rint(time_s * 1e9).astype(np.int64)
    accel, field = true.inv().apply([0, 0, G]), true.inv().apply(FIELD)
    imu = ImuBlock(stamps, rate, accel, np.full(n, 0.002), np.full(n, 0.02), field, np.zeros(n))
    still, no_rest = np.full(n, 0.005), np.zeros((n, 3))
    return StanceBlock(imu, np.ones(n, bool), still, still, still, no_rest, np.zeros(n)), true


JUDGED, TRUE = turning()


@pytest.mark.parametrize("use_field", [False, True])
@pytest.mark.parametrize("name", ["quaternion_ekf", "gradient_descent", "complementary", "factored_quaternion"])
def test_a_turning_sensor_is_followed_in_our_axes(name, use_field):
    params = changed(changed(Params(), "attitude", use_field=use_field), "filter", initial_yaw_rad=0.6)
    found = Rotation.from_quat(ORIENTATIONS[name](JUDGED, params))
    assert (found[0] * TRUE[0].inv()).magnitude() < np.radians(0.5)
    assert (found * TRUE.inv()).magnitude().max() < np.radians(2.0)


def test_the_error_state_filter_is_one_of_them():
    found = Rotation.from_quat(ORIENTATIONS["error_state"](JUDGED, changed(Params(), "filter", initial_yaw_rad=0.6)))
    assert (found * TRUE.inv()).magnitude().max() < np.radians(1.0)


def test_the_field_holds_what_a_bias_would_turn():
    biased = JUDGED._replace(imu=JUDGED.imu._replace(gyro_radps=JUDGED.imu.gyro_radps + np.array([0.0, 0.0, 0.02])))
    turned_rad = []
    for use_field in (False, True):
        params = changed(changed(Params(), "attitude", use_field=use_field), "filter", initial_yaw_rad=0.6)
        found = Rotation.from_quat(ORIENTATIONS["gradient_descent"](biased, params))
        turned_rad.append((found * TRUE.inv()).magnitude()[-1])
    assert turned_rad[0] > np.radians(8.0)
    assert turned_rad[1] < np.radians(1.0)


def test_where_the_gyro_is_off_the_orientation_is_held():
    off = JUDGED._replace(imu=JUDGED.imu._replace(gyro_sd_radps=np.where(np.arange(1200) < 600, 0.002, -1.0)))
    found = ORIENTATIONS["gradient_descent"](off, Params())
    np.testing.assert_array_equal(found[600:], np.tile(found[599], (600, 1)))


def test_without_a_field_factored_quaternions_say_so():
    bare = JUDGED._replace(imu=JUDGED.imu._replace(field_sd_tesla=np.full(1200, -1.0)))
    with pytest.raises(CannotOrient, match="need a magnetometer"):
        ORIENTATIONS["factored_quaternion"](bare, Params())


def test_without_the_library_a_sentence_says_what_to_do(monkeypatch):
    monkeypatch.setitem(sys.modules, "ahrs", None)
    with pytest.raises(CannotOrient, match="pip install ahrs"):
        ORIENTATIONS["complementary"](JUDGED, Params())


@pytest.mark.parametrize("name", ["quaternion_ekf", "gradient_descent", "complementary"])
def test_nothing_gives_nothing(name):
    assert ORIENTATIONS[name](part(JUDGED, 0, 0), Params()).shape == (0, 4)


WALK = simulated_walk(SimulationParams(motion="smooth", walk="straight", walk_length_m=9.0, sample_rate_hz=200.0))


def test_all_methods_walk_the_same_walk():
    done = study(Walk("straight", [WALK.imu], WALK.truth), Params(), list(ORIENTATIONS))
    assert set(done.left_out) == {"factored_quaternion"}
    assert set(done.scores) == set(ORIENTATIONS) - set(done.left_out)
    assert len({score.strides for score in done.scores.values()}) == 1
    assert all(done.scores[name].ate2_m < 0.15 for name in ("error_state", "quaternion_ekf", "gradient_descent"))
    assert done.gait == {}
    assert done.cycle is None
    assert np.abs(done.drift.before_mps[-1]).max() > np.abs(done.drift.after_mps[-1]).max()


def test_a_recording_without_samples_says_so():
    with pytest.raises(NoSamples):
        study(Walk("none", [part(WALK.imu, 0, 0)], None), Params(), ["quaternion_ekf"])

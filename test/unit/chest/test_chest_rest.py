"""Rest: its detection, and what it tells of a person who sways."""

from dataclasses import replace

import numpy as np
import pytest

from pdr_core.chest import ChestNavigator
from pdr_core.params import ChestParams, PlaceParams, SimulationParams
from pdr_core.records import inertial_block, joined, part
from pdr_core.simulation import chest_steps, simulated_walk
from support.chest import RATE_HZ, params, tilt_error_deg, walk

PLACE = PlaceParams()


def samples(force, rate, seconds=3.0):
    n = round(seconds * RATE_HZ)
    stamp_ns = np.arange(n) * (1_000_000_000 // RATE_HZ)
    return inertial_block(stamp_ns, np.tile(rate, (n, 1)), np.tile(force, (n, 1)), np.zeros(n), np.zeros(n))


@pytest.mark.parametrize(
    ("force", "rate", "rests"),
    [
        ((0.0, 0.0, 9.81), (0.0, 0.0, 0.0), True),
        ((0.0, -9.5, 0.0), (0.0, 0.01, 0.0), True),  # an accelerometer that is off, a gyro with a bias
        ((0.0, 0.0, 0.1), (0.0, 0.0, 0.0), False),  # a free fall: the print calls it a rest
        ((0.0, 0.0, 9.81), (0.0, 0.0, -0.1), False),
    ],
)
def test_what_is_a_rest(force, rate, rests):
    navigator = ChestNavigator(ChestParams(), PLACE)
    assert navigator.run(samples(force, rate)).resting.any() == rests


def test_after_a_gap_a_rest_takes_a_whole_window_again():
    still = samples((0.0, 0.0, 9.81), (0.0, 0.0, 0.0))
    half = len(still.stamp_ns) // 2
    late = still._replace(stamp_ns=still.stamp_ns + 1_000_000_000 * (np.arange(2 * half) >= half))
    resting = ChestNavigator(ChestParams(), PLACE).run(late).resting
    assert resting[half - 1]
    assert not resting[half : half + round(0.4 * RATE_HZ)].any()
    assert resting[half + round(0.6 * RATE_HZ) :].all()


@pytest.mark.parametrize("bias", [(0.05, 0.0, 0.0), (0.0, -0.03, 0.06)])
def test_a_gyro_whose_bias_is_above_the_threshold_rests_too(bias):
    """It would never get a track, and be told to stand still."""
    true = walk(2)
    plain, off = (ChestNavigator(ChestParams(), PLACE) for _ in range(2))
    there = plain.run(true.imu).nav.position_m
    here = off.run(true.imu._replace(gyro_radps=true.imu.gyro_radps + np.array(bias))).nav.position_m
    assert np.linalg.norm(here[-1] - there[-1]) < 0.3
    assert np.allclose(off.state.gyro_bias_radps - plain.state.gyro_bias_radps, bias, atol=5e-4)


def test_a_bias_that_was_learnt_of_a_slow_turn_is_unlearnt():
    """No later rest is one by it; until its rate has been constant for two seconds."""
    turning, still = (samples((0.0, 0.0, 9.81), (0.0, 0.0, rate), 6.0) for rate in (0.03, -0.02))
    both = joined([turning, still._replace(stamp_ns=still.stamp_ns + 6_000_000_000)])
    navigator = ChestNavigator(ChestParams(), PLACE)
    resting = navigator.run(both).resting
    assert resting[5 * RATE_HZ]
    assert not resting[7 * RATE_HZ]
    assert resting[9 * RATE_HZ :].all()
    assert navigator.state.gyro_bias_radps[2] == pytest.approx(-0.02, abs=1e-4)


def test_a_rate_that_is_not_constant_is_no_bias():
    still = samples((0.0, 0.0, 9.81), (0.0, 0.0, 0.0), 6.0)
    turning = 0.07 + 0.07 * np.sin(6.0 * np.pi * still.stamp_ns * 1e-9)
    turned = still._replace(gyro_radps=turning[:, None] * [0.0, 0.0, 1.0])
    assert not ChestNavigator(ChestParams(), PLACE).run(turned).resting.any()


def test_a_bounce_is_no_rest():
    """Its mean force is gravity: eq. 1 must take the magnitude of each sample."""
    still = samples((0.0, 0.0, 9.81), (0.0, 0.0, 0.0))
    bounce = 2.5 * np.sin(2.0 * np.pi * 2.0 * still.stamp_ns * 1e-9)
    shaken = still._replace(accel_mps2=still.accel_mps2 + bounce[:, None] * [0.0, 0.0, 1.0])
    assert not ChestNavigator(ChestParams(), PLACE).run(shaken).resting.any()


def test_all_rests_are_found_and_no_step_is_one():
    true = walk(2)
    resting = ChestNavigator(ChestParams(), PLACE).run(true.imu).resting
    fast = np.linalg.norm(true.motion.velocity_mps[:, :2], axis=1) > 0.5
    assert not (resting & fast).any()
    assert np.sum(np.diff(resting.astype(int)) == 1) == 9  # at both ends, and before and after each turn


def bias_errors(correction):
    """What a rest of 5 s leaves of the bias across gravity [rad/s], for people who sway: (30, 2)."""
    errors = []
    for seed in range(30):
        still = simulated_walk(
            SimulationParams(motion="chest", walk="still", sensor_model="ideal", sample_rate_hz=100.0, seed=seed)
        )
        navigator = ChestNavigator(replace(ChestParams(), static_correction=correction), PLACE)
        navigator.run(part(still.imu, 0, 5 * RATE_HZ))
        errors.append(navigator.state.gyro_bias_radps[:2].copy())
    return np.array(errors)


def test_the_fit_sees_the_sway():
    mean, fit = (float(np.sqrt(np.mean(bias_errors(c) ** 2))) for c in ("mean", "fit"))
    assert fit < 0.4 * mean


def test_the_walk_begins_from_the_tilt_of_its_last_moment():
    worst = {}
    for correction in ("mean", "fit"):
        left = []
        for seed in range(1, 9):
            true = walk(seed, sensor="ideal")
            nav, _, resting = ChestNavigator(params(static_correction=correction).chest, PLACE).run(true.imu)
            ends = np.flatnonzero(resting[:-1] & ~resting[1:])
            left += list(tilt_error_deg(nav, true)[ends])
        worst[correction] = np.sqrt(np.mean(np.square(left)))
    assert worst["fit"] < 0.5 * worst["mean"]


def test_a_rest_of_minutes_ends_with_the_tilt_of_one_of_seconds(monkeypatch):
    """The bias wanders: as a line through all of it the rest would end tilted by degrees."""
    monkeypatch.setattr(chest_steps, "REST_S", 150.0)
    left, biases, last = [], [], slice(-RATE_HZ, None)
    for seed in range(1, 9):
        still = simulated_walk(
            SimulationParams(motion="chest", walk="still", sensor_model="icm_20602", sample_rate_hz=100.0, seed=seed)
        )
        navigator = ChestNavigator(ChestParams(), PLACE)
        error_deg = tilt_error_deg(navigator.run(still.imu).nav, still)
        left.append(error_deg[-1] - error_deg[20 * RATE_HZ])  # what the accelerometer's bias looks like is in both
        true_radps = (still.imu.gyro_radps - still.motion.rate_radps)[last].mean(axis=0)
        biases.append(navigator.state.gyro_bias_radps - true_radps)
    assert np.sqrt(np.mean(np.square(left))) < 0.2
    assert np.sqrt(np.mean(np.square(biases))) < 5e-4


def test_a_rest_holds_position_and_yaw():
    true = walk(4)
    nav, _, resting = ChestNavigator(ChestParams(), PLACE).run(true.imu)
    both = resting[:-1] & resting[1:]
    assert np.all(nav.position_m[1:][both] == nav.position_m[:-1][both])
    assert np.all(nav.velocity_mps[resting] == 0.0)

"""Rest: its detection, and what it tells of a person who sways."""

from dataclasses import replace

import numpy as np
import pytest

from pdr_core.chest import ChestNavigator
from pdr_core.params import ChestParams, PlaceParams, SimulationParams
from pdr_core.records import inertial_block, part
from pdr_core.simulation import simulated_walk
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


def test_a_rest_holds_position_and_yaw():
    true = walk(4)
    nav, _, resting = ChestNavigator(ChestParams(), PLACE).run(true.imu)
    both = resting[:-1] & resting[1:]
    assert np.all(nav.position_m[1:][both] == nav.position_m[:-1][both])
    assert np.all(nav.velocity_mps[resting] == 0.0)

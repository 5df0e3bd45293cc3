"""The rates that are filled in, where the truth is known: strides without noise that are all alike turn as they did."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from swing_cases import BIAS_RADPS, RULE, Early, ideal_walk, rolled_walk, switched, without_rates

from pdr_core.gait.stance_turns import TIPPED_RAD, StanceTurns, turned
from pdr_core.maths.swing_twist import twist_rad
from pdr_core.pipeline import swing_bridge
from pdr_core.pipeline.swing_bridge import HELD_NS, STAND_WALK, SwingBridge
from pdr_core.records import joined, length, part

UP = np.array([0.0, 0.0, 1.0])


@pytest.fixture(scope="module")
def filled():
    """The walk, the samples with every rate filled in, and the rows of each sleep, first and behind the last."""
    walk, bridge = ideal_walk(), SwingBridge(RULE)
    bridge.bias_radps = BIAS_RADPS
    given, asleep = switched(walk.imu)
    out = joined([bridge.run(given), bridge.finish()])
    edges = np.flatnonzero(np.diff(asleep)) + 1
    sleeps = [(a, b) for a, b in zip(edges[::2], edges[1::2], strict=False) if ns(out, a, b) < HELD_NS]
    assert len(sleeps) > 10
    return walk, out, sleeps


def ns(imu, first, behind):
    return imu.stamp_ns[behind] - imu.stamp_ns[first]


def test_from_stand_to_stand_the_foot_turns_about_the_vertical_as_it_did(filled):
    walk, out, sleeps = filled
    attitude = Rotation.from_quat(walk.motion.quat_xyzw)
    stands = [a + int(np.flatnonzero(walk.motion.stance[a:b]).mean()) for a, b in sleeps]
    errors, tilts = zip(*(off(attitude, out, *pair) for pair in pairwise(stands)), strict=True)
    assert np.abs(errors).max() < np.radians(0.03)
    assert np.median(tilts) < np.radians(0.1)


def off(attitude, out, first, last):
    """Return how far the heading is off at the end, levelled as a filter does it by the shortest way, and the tilt."""
    turn = Rotation.from_quat(turned(out.stamp_ns, out.gyro_radps - BIAS_RADPS, first, last))
    up = (attitude[first] * turn * attitude[last].inv()).apply(UP)
    axis, tilt = np.cross(up, UP), np.arctan2(np.hypot(up[0], up[1]), up[2])
    level = Rotation.from_rotvec(tilt * axis / max(np.linalg.norm(axis), 1e-12))
    error = level * attitude[first] * turn * attitude[last].inv()
    return twist_rad(tuple(error.as_quat()), UP), tilt


def test_the_noise_of_a_sleep_is_that_of_both_its_turns(filled):
    """Independent rates add up: each turn is `TIPPED_RAD` uncertain, and in between the foot pivots a little."""
    _, out, sleeps = filled
    steps_s = np.diff(out.stamp_ns, prepend=out.stamp_ns[0]) * 1e-9
    for first, behind in sleeps:
        variance = np.sum((out.gyro_sd_radps[first:behind] * steps_s[first:behind]) ** 2)
        pivots = STAND_WALK**2 * ns(out, first, behind) * 1e-9
        assert 2.0 * TIPPED_RAD**2 * 0.9999 < variance < 2.0 * TIPPED_RAD**2 + pivots


def test_what_is_measured_stays_as_it_was_and_nothing_is_left_out(filled):
    walk, out, sleeps = filled
    assert np.array_equal(out.stamp_ns, walk.imu.stamp_ns)
    between = np.concatenate([np.arange(b, a) for (_, b), (a, _) in pairwise(sleeps)])
    assert np.array_equal(out.gyro_radps[between], walk.imu.gyro_radps[between])
    assert np.array_equal(out.accel_mps2, walk.imu.accel_mps2)


class Heard(StanceTurns):
    """Writes down what it is told."""

    def __init__(self):
        super().__init__()
        self.learnt, self.landings = [], []

    def learn(self, slept, swing):
        self.learnt.append((slept.stamp_ns[[0, -1]], swing))
        super().learn(slept, swing)

    def landing(self, rate_radps, up, flat):
        self.landings.append((rate_radps, up))
        return super().landing(rate_radps, up, flat)


@pytest.fixture(scope="module")
def heard():
    """A walk whose turns are of no plane, its attitude, the first rows of its sleeps, and what was told of them."""
    imu, attitude, stance = rolled_walk()
    early = Early(imu.stamp_ns, stance)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(swing_bridge, "StanceTurns", Heard)
        patch.setattr(swing_bridge, "MotionSwitch", lambda *_, **__: early)
        bridge = SwingBridge(RULE)
    bridge.bias_radps = BIAS_RADPS
    given, asleep = without_rates(imu, early.asleep)
    for first in range(0, length(given), 30):
        bridge.run(part(given, first, first + 30))
    return imu, attitude, np.flatnonzero(np.diff(asleep.astype(int)) == 1) + 1, bridge._turns


def test_the_swing_between_two_sleeps_is_learnt_as_it_was(heard):
    imu, attitude, _, turns = heard
    rows = [np.searchsorted(imu.stamp_ns, stamps) for stamps, _ in turns.learnt]
    assert len(rows) > 10
    for (_, before), (after, _), (_, swing) in zip(rows, rows[1:], turns.learnt[1:], strict=False):
        true = attitude[before].inv() * attitude[after]
        assert swing is not None
        assert (Rotation.from_quat(swing) * true.inv()).magnitude() < 0.005


def test_the_landing_is_told_the_last_rate_and_where_up_is_then(heard):
    imu, attitude, sleeps, turns = heard
    assert len(turns.landings) > 10
    for first, (rate, up) in zip(sleeps, turns.landings, strict=False):
        last = first - 1
        assert np.linalg.norm(rate) > 0.5
        assert rate == pytest.approx(imu.gyro_radps[last] - BIAS_RADPS)
        assert up == pytest.approx(attitude[last].inv().apply(UP), abs=0.01)

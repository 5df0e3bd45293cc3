"""The rates that are filled in, where the truth is known: strides without noise that are all alike turn as they did."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from swing_cases import BIAS_RADPS, RULE, ideal_walk, switched

from pdr_core.gait.stance_turns import TIPPED_RAD, turned
from pdr_core.maths.swing_twist import twist_rad
from pdr_core.pipeline.swing_bridge import HELD_NS, STAND_WALK, SwingBridge
from pdr_core.records import joined

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
    assert np.abs(errors).max() < np.radians(0.05)
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

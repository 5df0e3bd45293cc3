"""After any bad stretch the chain is back within two strides of good stance, and says so."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.evaluation.metrics import ate2_m
from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline import FootInertial
from pdr_core.records import ImuBlock, joined
from pdr_core.simulation import simulated_walk

RATE_HZ = 200
WALK = simulated_walk(SimulationParams(walk="straight", walk_length_m=24.0, sample_rate_hz=float(RATE_HZ)))
STANCE_ENDS = np.flatnonzero(WALK.motion.stance[:-1] & ~WALK.motion.stance[1:])
IN_SWING, IN_STANCE = 10 * RATE_HZ - 100, 10 * RATE_HZ + 50  # .5 s into a swing of 1 s, .25 s into the stance after it


def shocked(imu, at, rng):
    pulse = np.sin(np.linspace(0.0, np.pi, 10))[:, None] * rng.standard_normal((10, 3))
    imu.accel_mps2[at : at + 10] += 80.0 * pulse
    imu.gyro_radps[at : at + 10] += 5.0 * pulse
    return imu, at + 10


def clipped(imu, at, _):
    stop = at + 3 * RATE_HZ
    imu.gyro_radps[at:stop] = np.clip(imu.gyro_radps[at:stop], -0.8, 0.8)
    imu.accel_mps2[at:stop] = np.clip(imu.accel_mps2[at:stop], -10.5, 10.5)
    return imu, stop


def interrupted(imu, at, _):
    kept = np.r_[0:at, at + 5 * RATE_HZ : len(imu.stamp_ns)]
    return ImuBlock(*(column[kept] for column in imu)), at + 5 * RATE_HZ


def kicked(imu, at, rng, turn_rad=1.2):
    axis = rng.standard_normal(3)
    turn = Rotation.from_rotvec(turn_rad * axis / np.linalg.norm(axis))
    imu.gyro_radps[at:], imu.accel_mps2[at:] = turn.apply(imu.gyro_radps[at:]), turn.apply(imu.accel_mps2[at:])
    return imu, at


def refitted(imu, at, rng):
    """Take the sensor off for 5 s and fix it upside down."""
    turned, _ = kicked(imu, at, rng, turn_rad=3.0)
    return interrupted(turned, at, rng)


def fallen(imu, at, rng):
    stop = at + 2 * RATE_HZ
    imu.gyro_radps[at:stop] = 6.0 * rng.standard_normal((2 * RATE_HZ, 3))
    imu.accel_mps2[at:stop] = 30.0 * rng.standard_normal((2 * RATE_HZ, 3))
    return imu, stop


@pytest.mark.parametrize("at", [IN_SWING, IN_STANCE])
@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("stress", [shocked, clipped, interrupted, kicked, refitted, fallen])
def test_two_strides_after_a_bad_stretch_the_track_is_right_again(stress, seed, at):
    imu, over = stress(ImuBlock(*(c.copy() for c in WALK.imu)), at, np.random.default_rng(seed))
    chain = FootInertial(Params())
    out, rest = chain.run(imu), chain.finish()
    nav = joined([out.nav, rest.nav])
    back = STANCE_ENDS[over < STANCE_ENDS][2]
    later = nav.stamp_ns >= WALK.imu.stamp_ns[back]
    truth = WALK.motion.position_m[np.searchsorted(WALK.imu.stamp_ns, nav.stamp_ns[later])]
    walked = np.linalg.norm(truth[-1] - truth[0])
    assert walked > 5.0
    assert ate2_m(nav.position_m[later], truth) < 0.02 * walked
    up = Rotation.from_quat(nav.quat_xyzw[-1]).apply(imu.accel_mps2[-1])
    assert np.arccos(up[2] / np.linalg.norm(up)) < 0.03
    assert chain._filter.health.quality > 0.5


@pytest.mark.parametrize("stress", [clipped, interrupted, kicked, fallen])
def test_it_says_that_the_track_was_off(stress):
    imu, _ = stress(ImuBlock(*(c.copy() for c in WALK.imu)), IN_SWING, np.random.default_rng(0))
    chain = FootInertial(Params())
    chain.run(imu)
    assert {n.kind for n in chain.notices} & {"estimate_doubted", "coasted"}


def test_after_a_gap_the_position_is_held_until_the_foot_stands():
    at = 9 * RATE_HZ + 20  # 5 s later the foot is .4 s before the end of another swing
    imu, over = interrupted(WALK.imu, at, None)
    assert not WALK.motion.stance[over : over + 60].any()
    nav = FootInertial(Params()).run(imu).nav
    held_m = nav.position_m[at - 1 : at + 60]
    np.testing.assert_array_equal(held_m, np.tile(held_m[0], (61, 1)))


def test_the_track_turns_with_the_mounting_and_nothing_else_changes():
    mounting = Rotation.random(random_state=3)
    turned = WALK.imu._replace(
        gyro_radps=mounting.apply(WALK.imu.gyro_radps), accel_mps2=mounting.apply(WALK.imu.accel_mps2)
    )
    a, b = FootInertial(Params()).run(WALK.imu), FootInertial(Params()).run(turned)
    np.testing.assert_array_equal(a.judged.stance, b.judged.stance)
    assert len(a.steps) == len(b.steps)
    np.testing.assert_allclose([s.length_m for s in a.steps], [s.length_m for s in b.steps], atol=2e-3)

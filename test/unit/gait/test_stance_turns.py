"""What a foot turns while its gyro sleeps, on sleeps whose every turn is known: no noise, and closed forms.

A sleep: the foot lands, lies flat but for a slow roll, rises a little, stands, and leaves; it never speeds up, so the
specific force is that of gravity in its axes. From stand to stand it turns about the vertical alone.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.gait.stance_turns import TIPPED_RAD, StanceTurns, carried, lift_signs, moment_rads, stand, turned
from pdr_core.maths.quaternion import from_rotation_vector
from pdr_core.maths.swing_twist import twist_rad
from pdr_core.records import inertial_block, length, part

UP = np.array([0.2, -0.1, np.sqrt(0.95)])  # in the axes of the standing foot: the sensor sits askew
LAND, LIFT = np.array([0.1, 0.35, -0.06]), np.array([0.15, 0.7, 0.05])
RISE, ROLL = np.array([0.0, 0.1, 0.02]), np.array([1.0, 0.0, 0.0])
STEP_S, END_S = 0.0025, 0.6
LANDED_S, FLAT_S, RISES_S, STANDS_S, STILL_S, LEAVES_S = 0.12, 0.16, 0.2, 0.34, 0.38, 0.42
G = 9.81


def rates(land, lift):
    """Return stamps and rates (n, 3): what lands dies away evenly, what leaves grows evenly, each by its own axis."""
    s = np.arange(round(END_S / STEP_S) + 1) * STEP_S
    lands = np.clip(1.0 - s / LANDED_S, 0.0, None) * 2.0 / LANDED_S
    leaves = np.clip((s - LEAVES_S) / (END_S - LEAVES_S), 0.0, None) * 2.0 / (END_S - LEAVES_S)
    rises = np.clip(1.0 - np.abs(s - 0.5 * (RISES_S + STANDS_S)) / (0.5 * (STANDS_S - RISES_S)), 0.0, None) * 20.0
    rolls = np.where(s < STANDS_S, 0.05 + np.abs(s - FLAT_S), 0.1 * np.abs(s - STILL_S)) * (s < LEAVES_S)
    return s, sum(
        np.outer(share, turn) for share, turn in ((lands, land), (leaves, lift), (rises, RISE), (rolls, ROLL))
    )


def sleep(land=LAND, lift=LIFT):
    """Return the samples of a sleep whose stand is level, and the attitude (n,) of the foot from the stand's axes."""
    s, gyro = rates(land, lift)
    step = Rotation.from_rotvec(0.5 * (gyro[1:] + gyro[:-1]) * STEP_S)
    attitude = [Rotation.identity()]
    for turn in step:
        attitude.append(attitude[-1] * turn)
    attitude = Rotation.concatenate(attitude)
    attitude = attitude[round(STILL_S / STEP_S)].inv() * attitude
    stamps, quiet = np.round(s * 1e9).astype(np.int64), np.zeros(len(s))
    return inertial_block(stamps, gyro, G * attitude.inv().apply(UP), quiet, quiet), attitude


def four(rotation):
    return tuple(rotation.as_quat())


def swing_between(before, after, heading_rad):
    """Return the turn from a lift to the landing after it, with which the foot turns by that from stand to stand."""
    return before[-1].inv() * Rotation.from_rotvec(heading_rad * UP) * after[0]


def walked(turns, count, lands=None):
    """Let so many strides be learnt, which turn about; return the last sleep and its attitude."""
    before = None
    for i in range(count):
        slept, attitude = sleep() if lands is None else sleep(lands[i])
        turns.learn(slept, four(swing_between(before, attitude, 0.3 * np.sin(i))) if before is not None else None)
        before = attitude
    return slept, attitude


def levelled(turn, up_after=UP, up=UP):
    """Return a turn as the filter will have levelled it, by the shortest way to where up is known to be."""
    tilted = turn.apply(up_after)
    axis = np.cross(tilted, up)
    angle = np.arctan2(np.linalg.norm(axis), tilted @ up)
    return Rotation.from_rotvec(angle * axis / max(np.linalg.norm(axis), 1e-12)) * turn


@pytest.fixture(scope="module")
def learnt():
    turns = StanceTurns()
    return turns, *walked(turns, 20)


@pytest.mark.parametrize("heading_rad", [0.0, 0.4, -1.2])
def test_a_stride_as_usual_turns_as_far_about_the_vertical_as_it_is_told(learnt, heading_rad):
    turns, slept, attitude = learnt
    lift = Rotation.from_rotvec(turns.lifting(slept, stand(slept)).turn_rad)
    swing = swing_between(attitude, attitude, heading_rad)
    up = (lift * swing).inv().apply(UP)
    flat = stand(slept, stand(slept).row)
    land = Rotation.from_rotvec(turns.landing(slept.gyro_radps[0], up, flat).turn_rad)
    told = levelled(lift * swing * land)
    assert told.apply(UP) == pytest.approx(UP, abs=1e-9)
    assert twist_rad(four(told), UP) == pytest.approx(heading_rad, abs=2e-4)


def test_the_force_shows_the_tilt_of_a_foot_that_only_turns():
    """From the derivation: up moves from u to u - t x u, so f x s / |s|^2 = t - (t u) u, to first order in t."""
    slept, _ = sleep()
    stands, t = stand(slept), 1e-5 * np.array([1.0, -2.0, 3.0])
    shown = slept.stamp_ns >= slept.stamp_ns[-1] - 30_000_000
    force = np.where(shown[:, None], Rotation.from_rotvec(-t).apply(stands.force_mps2), 5.0)
    signs = lift_signs(slept._replace(accel_mps2=force), stands)
    assert signs[0].tolist() == slept.gyro_radps[-1].tolist()
    assert signs[1] == pytest.approx(t - (t @ stands.up) * stands.up, abs=1e-9)


def test_a_lift_is_told_by_its_signs_alone_and_has_no_twist(learnt):
    turns, slept, attitude = learnt
    stands = stand(slept)
    lift = turns.lifting(slept, stands)
    assert twist_rad(from_rotation_vector(lift.turn_rad), stands.up) == pytest.approx(0.0, abs=1e-9)
    assert Rotation.from_rotvec(lift.turn_rad).inv().apply(UP) == pytest.approx(attitude[-1].inv().apply(UP), abs=1e-4)
    assert lift.sd_rad == TIPPED_RAD


@pytest.mark.parametrize("rate", [[0.0, 0.0, 0.0], [2.0, 9.0, -1.0]])
@pytest.mark.parametrize("askew", [[0.0, 0.0, 0.0], [0.2, -0.1, 0.0]])
def test_once_the_filter_has_levelled_it_a_landing_twists_as_usual_whatever_its_signs_are(learnt, rate, askew):
    turns, slept, attitude = learnt
    flat = stand(slept, stand(slept).row)
    usual_up = attitude[0].inv().apply(UP)
    usual = landed(turns, slept.gyro_radps[0], usual_up, flat)
    up = Rotation.from_rotvec(askew).apply(usual_up)
    level = landed(turns, np.array(rate), up, flat)
    assert level.apply(flat.up) == pytest.approx(up, abs=1e-9)
    assert twist_rad(four(level), up) == pytest.approx(twist_rad(four(usual), usual_up), abs=1e-9)


def landed(turns, rate, up, flat):
    """Return the landing that is told, levelled by the shortest way."""
    land = Rotation.from_rotvec(turns.landing(rate, up, flat).turn_rad)
    return levelled(land, flat.up, up)


def test_the_mean_times_are_those_of_the_turns(learnt):
    """A rate that falls, or grows, evenly has a third of its time as its mean; the slow roll adds less than that."""
    turns, slept, _ = learnt
    flat = stand(slept, stand(slept).row)
    landing = turns.landing(slept.gyro_radps[0], UP, flat)
    assert landing.mean_time_s == pytest.approx(LANDED_S / 3.0, rel=0.04)
    assert turns.lifting(slept, stand(slept)).mean_time_s == pytest.approx((END_S - LEAVES_S) / 3.0, rel=0.04)


def test_a_moment_is_the_sum_of_turn_times_time_from_its_edge():
    slept, _ = sleep(np.zeros(3), np.zeros(3))
    even = slept._replace(gyro_radps=np.tile([1.0, -2.0, 0.5], (length(slept), 1)))
    last = length(slept) - 1
    whole = 0.5 * END_S**2 * np.array([1.0, -2.0, 0.5])
    assert moment_rads(even, 0, last, 0) == pytest.approx(whole, rel=0.01)
    assert moment_rads(even, 0, last, last) == pytest.approx(whole, rel=0.01)


def test_turns_follow_one_another_in_the_axes_of_the_foot():
    slept, attitude = sleep()
    half = int(np.searchsorted(slept.stamp_ns, round(STILL_S * 1e9)))
    for first, last in ((0, half), (half, length(slept) - 1), (0, length(slept) - 1)):
        true = attitude[first].inv() * attitude[last]
        found = Rotation.from_quat(turned(slept.stamp_ns, slept.gyro_radps, first, last))
        assert (found * true.inv()).magnitude() < 1e-9
        up = attitude[first].inv().apply(UP)
        assert carried(up, part(slept, first, last + 1)) == pytest.approx(attitude[last].inv().apply(UP), abs=1e-9)


def test_the_foot_is_flat_before_it_stands():
    slept, attitude = sleep()
    stands = stand(slept)
    flat = stand(slept, stands.row)
    assert stands.row * STEP_S == pytest.approx(STILL_S, abs=2.0 * STEP_S)
    assert flat.row * STEP_S == pytest.approx(FLAT_S, abs=2.0 * STEP_S)
    assert stands.up == pytest.approx(UP, abs=1e-5)
    assert flat.up == pytest.approx(attitude[flat.row].inv().apply(UP), abs=2e-3)


def test_a_landing_that_the_last_rate_tells_ends_level_by_itself():
    turns = StanceTurns()
    walked(turns, 20, [(1.0 + 0.3 * np.sin(2.0 * i)) * LAND for i in range(20)])
    slept, attitude = sleep(1.25 * LAND)
    flat, up = stand(slept, stand(slept).row), attitude[0].inv().apply(UP)
    land = Rotation.from_rotvec(turns.landing(slept.gyro_radps[0], up, flat).turn_rad)
    assert land.apply(flat.up) == pytest.approx(up, abs=2e-3)


def test_the_noise_that_the_filter_takes_adds_up_to_what_strides_are_off():
    """The mean of n strides is off by itself: k more are off by s^2 (k + k^2 / n). Each has a landing and a lift."""
    strides, s_rad = 16, 0.05
    twisted = [(Rotation.from_rotvec((-1) ** i * s_rad * UP) * Rotation.from_rotvec(LAND)) for i in range(strides + 1)]
    turns = StanceTurns()
    slept, attitude = walked(turns, strides + 1, [twist.as_rotvec() for twist in twisted])
    flat, up, variance = stand(slept, stand(slept).row), attitude[0].inv().apply(UP), 0.0
    for _ in range(strides):
        turns.landing(slept.gyro_radps[0], up, flat)
        variance += 2.0 * (turns.share_about_up * TIPPED_RAD) ** 2
    assert variance == pytest.approx(s_rad**2 * (strides + strides**2 / strides), rel=0.06)

"""Gaps and knocks, whenever they come: at rest, at a start, on the way, at a stop."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.params import Params, changed
from pdr_core.records import picked
from support.chest import RATE_HZ, end_error_m, estimated, params, walk

SEEDS = range(1, 9)
LENGTH_M = 44.0
REST, ON_THE_WAY = 2.25, 10.0  # seconds of every seed's walk, which begins at 5 s
MOMENTS_S = (0.3, REST, 4.3, 6.25, 8.25, ON_THE_WAY, 12.0, 14.0)


def without(imu, start_s, end_s):
    seconds = imu.stamp_ns / 1e9
    return picked(imu, np.flatnonzero((seconds < start_s) | (seconds > end_s)))


def knocked(imu, at_s, axis="x", angle_deg=20.0):
    """It is over before a sample sees it: the gyro knows nothing of it."""
    turn = Rotation.from_euler(axis, angle_deg, degrees=True)
    later = imu.stamp_ns > at_s * 1e9
    accel, gyro = imu.accel_mps2.copy(), imu.gyro_radps.copy()
    accel[later], gyro[later] = turn.apply(accel[later]), turn.apply(gyro[later])
    return imu._replace(accel_mps2=accel, gyro_radps=gyro)


def card_turned(true, at_s, axis, angle_deg=20.0):
    """A knock of the card itself: its biases stay in its axes."""
    turn = Rotation.from_rotvec(np.radians(angle_deg) * np.array(axis) / np.linalg.norm(axis))
    later, rest = true.imu.stamp_ns > at_s * 1e9, slice(0, 4 * RATE_HZ)
    accel, gyro = true.imu.accel_mps2.copy(), true.imu.gyro_radps.copy()
    force = true.motion.acceleration_mps2 + STANDARD_GRAVITY_MPS2 * np.eye(3)[2]
    felt = Rotation.from_quat(true.motion.quat_xyzw).inv().apply(force)
    for measured, exact in ((accel, felt), (gyro, true.motion.rate_radps)):
        bias = (measured - exact)[rest].mean(axis=0)
        measured[later] = turn.apply(measured[later] - bias) + bias
    return true.imu._replace(accel_mps2=accel, gyro_radps=gyro)


def mean_end_error_m(troubled, **chest):
    walks = [walk(seed, LENGTH_M) for seed in SEEDS]
    return np.mean([end_error_m(estimated(troubled(true.imu), params(**chest))[0], true) for true in walks])


def first_turn_s(true):
    """The middle of the first turn on the spot, of 90 degrees in 1.5 s."""
    yaw = np.unwrap(Rotation.from_quat(true.motion.quat_xyzw).as_euler("ZYX")[:, 0])
    return true.imu.stamp_ns[np.flatnonzero(yaw > 0.25 * np.pi)[0]] / 1e9


def yaw_errors_rad(nav, true):
    rows = np.searchsorted(true.imu.stamp_ns, nav.stamp_ns)
    return (Rotation.from_quat(nav.quat_xyzw) * Rotation.from_quat(true.motion.quat_xyzw[rows]).inv()).as_rotvec()[:, 2]


@pytest.mark.parametrize("start_s", MOMENTS_S)
def test_a_gap_of_a_second_is_survived(start_s):
    """Also where the walk begins in it, and nobody knows yet how fast this person walks."""
    assert mean_end_error_m(lambda imu: without(imu, start_s, start_s + 1.0)) < 0.04 * LENGTH_M


@pytest.mark.parametrize("gap_s", [0.15, 0.3, 0.5])
@pytest.mark.parametrize("before_s", [0.0, 0.25, 0.5])
def test_a_short_gap_in_a_turn_hides_little_of_it(gap_s, before_s):
    """The rates at both ends tell what is between."""
    errors = []
    for true in (walk(seed, LENGTH_M) for seed in SEEDS):
        start_s = first_turn_s(true) - before_s
        errors.append(end_error_m(estimated(without(true.imu, start_s, start_s + gap_s))[0], true))
    assert np.mean(errors) < 0.09 * LENGTH_M


@pytest.mark.parametrize("gap_s", [0.3, 1.0])
@pytest.mark.parametrize("before_s", [0.1, 0.5, 11.0])
def test_the_deviations_know_that_somebody_may_have_turned_in_a_gap(gap_s, before_s):
    for true in (walk(seed, LENGTH_M) for seed in SEEDS):
        start_s = first_turn_s(true) - before_s
        nav, _, _ = estimated(without(true.imu, start_s, start_s + gap_s))
        later = nav.stamp_ns > start_s * 1e9
        yaw_sd_rad = np.sqrt(nav.pose_covariance[later, 5, 5])
        assert np.all(np.abs(yaw_errors_rad(nav, true)[later]) < 3.0 * yaw_sd_rad)
        assert yaw_sd_rad.max() < 0.7


def test_a_turn_in_a_gap_is_told_by_a_clean_field():
    """For that the yaw must be known to be unknown."""
    true = walk(2, LENGTH_M, magnetometer=True)
    broken = without(true.imu, first_turn_s(true) - 0.5, first_turn_s(true) + 0.5)
    off, auto = (estimated(broken, changed(Params(), "filter", magnetometer=use))[0] for use in ("off", "auto"))
    assert end_error_m(off, true) > 15.0
    assert end_error_m(auto, true) < 5.0
    assert abs(yaw_errors_rad(auto, true)[-1]) < np.radians(15.0)


def test_gaps_that_come_again_and_again_do_not_stop_a_walk():
    """A radio that loses a little each second: less than a fifth of one is no gap, and no stride is lost for it."""

    def lossy(imu):
        for k in range(40):
            imu = without(imu, 9.0 + k, 9.15 + k)
        return imu

    assert mean_end_error_m(lossy) < 0.1 * LENGTH_M


def test_a_second_gap_before_the_next_step_is_whole_stops_nobody():
    """Where the chest points is still known, though of no whole step."""
    for true in (walk(seed, LENGTH_M) for seed in SEEDS):
        for second_s in (10.5, 10.6, 10.7, 10.8):
            nav, _, _ = estimated(without(without(true.imu, 10.0, 10.3), second_s, second_s + 0.3))
            after = np.flatnonzero(nav.stamp_ns > (second_s + 0.3) * 1e9)[0]
            assert np.linalg.norm(nav.velocity_mps[after]) > 0.8


def test_a_gap_is_named():
    card = estimated(without(walk(1, LENGTH_M).imu, 10.0, 11.0))[2]
    assert {"coasted", "gap"} <= {n.kind for n in card.notices}


@pytest.mark.parametrize("axis", ["x", "y"])
@pytest.mark.parametrize("at_s", [1.0, REST, 4.0, 9.0, ON_THE_WAY, 12.0, 14.0])
def test_a_knock_by_20_degrees_is_found_and_taken_back(at_s, axis):
    assert mean_end_error_m(lambda imu: knocked(imu, at_s, axis)) < 0.06 * LENGTH_M


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], ids=["x", "y"])
@pytest.mark.parametrize("at_s", [5.2, 6.0, 7.0])
def test_a_knock_in_the_first_steps_of_all_is_survived(at_s, axis):
    """Nobody knows yet how fast this person walks, and since when the tilt is off: she walks as others do."""
    walks = [walk(seed, LENGTH_M) for seed in SEEDS]
    errors = [end_error_m(estimated(card_turned(true, at_s, axis))[0], true) for true in walks]
    assert np.mean(errors) < 0.04 * LENGTH_M


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], ids=["x", "y"])
@pytest.mark.parametrize("before_s", [0.6, 0.3, 0.0])
def test_a_knock_in_a_turn_on_the_spot_is_survived(before_s, axis):
    """It is over before a stride shows it, but nobody stops from three metres a second."""
    walks = [walk(seed, LENGTH_M) for seed in SEEDS]
    errors = []
    for true in walks:
        nav, _, card = estimated(card_turned(true, first_turn_s(true) - before_s, axis))
        errors.append(end_error_m(nav, true))
        assert "levelled_anew" in [n.kind for n in card.notices]
    assert np.mean(errors) < 0.06 * LENGTH_M


def test_a_knock_about_the_vertical_too_is_in_the_deviation_of_the_yaw():
    off = []
    for true in (walk(seed, LENGTH_M) for seed in SEEDS):
        nav, _, _ = estimated(card_turned(true, ON_THE_WAY, (1.0, 1.0, 1.0)))
        leg = np.flatnonzero(np.linalg.norm(true.motion.velocity_mps[: len(nav.stamp_ns)], axis=1) > 0.5)[[-300, -1]]
        ways = [complex(*np.diff(p[leg, :2], axis=0)[0]) for p in (nav.position_m, true.motion.position_m)]
        off.append(np.angle(ways[0] / ways[1]))
        assert abs(off[-1]) < 3.0 * np.sqrt(nav.pose_covariance[-1, 5, 5])
    assert np.mean(np.abs(off)) > np.radians(3.0)


def test_without_the_correction_a_knock_loses_the_walk():
    assert mean_end_error_m(lambda imu: knocked(imu, 9.0), method="inertial") > 0.3 * LENGTH_M


def test_a_knock_on_the_way_is_named_and_levelled_twice():
    """The stride that shows it holds it somewhere: what that leaves, the next whole one takes back."""
    card = estimated(knocked(walk(2, LENGTH_M).imu, 12.0))[2]
    assert [n.count for n in card.notices if n.kind == "levelled_anew"] == [2]


def test_a_knock_in_a_gap_of_a_rest_is_taken_back():
    assert mean_end_error_m(lambda imu: without(knocked(imu, REST), REST - 0.5, REST + 0.5)) < 0.04 * LENGTH_M


def test_a_walk_that_begins_in_a_gap_teaches_nothing_of_the_length_of_steps():
    """Its speed is not known until the next rest, which tells how far it went; the later steps are those of others."""
    true = walk(1, LENGTH_M)
    plain = estimated(true.imu)[1]
    broken = estimated(without(true.imu, 4.3, 5.3))[1]
    assert np.median([s.length_m for s in broken[-8:]]) == pytest.approx(
        np.median([s.length_m for s in plain[-8:]]), rel=0.05
    )


def test_who_twitches_in_the_first_rest_may_wear_the_card_upright():
    """The way ahead is chosen by the first rest that has told anything, not by one that a twitch has ended at once."""
    upright, true = Rotation.from_euler("y", -90.0, degrees=True), walk(1)
    imu = true.imu._replace(
        accel_mps2=upright.apply(true.imu.accel_mps2), gyro_radps=upright.apply(true.imu.gyro_radps)
    )
    gyro = imu.gyro_radps.copy()
    gyro[int(0.54 * RATE_HZ)] = 2.0
    plain, twitched = (estimated(i)[0] for i in (imu, imu._replace(gyro_radps=gyro)))
    assert np.linalg.norm(twitched.position_m[-1] - plain.position_m[-1]) < 0.5

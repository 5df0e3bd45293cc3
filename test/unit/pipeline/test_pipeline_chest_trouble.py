"""Gaps and knocks, whenever they come: at rest, at a start, on the way, at a stop."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

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


def mean_end_error_m(changed, **chest):
    walks = [walk(seed, LENGTH_M) for seed in SEEDS]
    return np.mean([end_error_m(estimated(changed(true.imu), params(**chest))[0], true) for true in walks])


@pytest.mark.parametrize("start_s", MOMENTS_S)
def test_a_gap_of_a_second_is_survived(start_s):
    """Also where the walk begins in it, and nobody knows yet how fast this person walks."""
    assert mean_end_error_m(lambda imu: without(imu, start_s, start_s + 1.0)) < 0.04 * LENGTH_M


def test_a_gap_is_named():
    card = estimated(without(walk(1, LENGTH_M).imu, 10.0, 11.0))[2]
    assert {"coasted", "gap"} <= {n.kind for n in card.notices}


@pytest.mark.parametrize("axis", ["x", "y"])
@pytest.mark.parametrize("at_s", [1.0, REST, 4.0, 9.0, ON_THE_WAY, 12.0, 14.0])
def test_a_knock_by_20_degrees_is_found_and_taken_back(at_s, axis):
    assert mean_end_error_m(lambda imu: knocked(imu, at_s, axis)) < 0.06 * LENGTH_M


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

"""A gyro that its sensor switches: on where the foot leaves its stand, off behind the heel."""

from itertools import pairwise

import numpy as np
import pytest

from pdr_core.maths.motion_switch import MotionSwitch
from support.switched import RATE_HZ, RULE, strides

IMU = strides(8.0)
TIME_S = (IMU.stamp_ns - IMU.stamp_ns[0]) * 1e-9


def switched(imu=IMU, powered=True, pieces=1):
    switch = MotionSwitch(RULE, powered)
    cuts = np.linspace(0, len(imu.stamp_ns), pieces + 1).astype(int)
    found = [switch.run(imu.stamp_ns[a:b], imu.accel_mps2[a:b]) for a, b in pairwise(cuts)]
    return tuple(np.concatenate(column) for column in zip(*found, strict=True))


def test_it_is_on_in_each_swing_and_off_in_each_stand():
    powered, measured = switched()
    edges = np.diff(powered.astype(int))
    on_s, off_s = TIME_S[1:][edges > 0], TIME_S[1:][edges < 0]
    assert len(on_s) == 8
    assert (on_s % 1.0).min() >= 0.4
    assert (on_s % 1.0).max() < 0.46
    assert off_s[1:] % 1.0 == pytest.approx(np.full(len(off_s) - 1, 0.9 + RULE.strike_on_ns * 1e-9), abs=2.5 / RATE_HZ)
    for woke_s in on_s:
        settling = (woke_s <= TIME_S) & (woke_s + RULE.settle_ns * 1e-9 - 1e-6 > TIME_S)
        assert powered[settling].all()
        assert not measured[settling].any()
    assert not (measured & ~powered).any()


@pytest.mark.parametrize("pieces", [3, 100, 1600])
def test_however_the_samples_are_cut_it_switches_alike(pieces):
    whole, cut = switched(), switched(pieces=pieces)
    assert np.array_equal(whole[0], cut[0])
    assert np.array_equal(whole[1], cut[1])


def test_a_gyro_that_is_on_in_mid_swing_does_not_go_off_before_the_foot_stands():
    first = int(0.55 * RATE_HZ)
    powered, _ = switched(type(IMU)(*(column[first:] for column in IMU)))
    stands = TIME_S[first:] > 1.0
    assert powered[~stands].all()
    assert not powered[stands][: int(0.3 * RATE_HZ)].all()


def test_a_foot_that_stands_keeps_it_off_and_one_that_shakes_keeps_it_on():
    still = IMU._replace(accel_mps2=np.tile([0.0, 0.0, 9.81], (len(TIME_S), 1)))
    assert not switched(still)[0][int(0.2 * RATE_HZ) :].any()
    shaken = still._replace(accel_mps2=still.accel_mps2 + 8.0 * np.sin(2.0 * np.pi * 6.0 * TIME_S)[:, None])
    assert switched(shaken)[0].all()


def test_a_clock_that_jumps_back_begins_anew():
    stamps = IMU.stamp_ns.copy()
    stamps[800:] -= 3_600_000_000_000
    powered, _ = switched(IMU._replace(stamp_ns=stamps))
    again, _ = switched(type(IMU)(*(column[800:] for column in IMU)))
    assert np.array_equal(powered[800:], again)

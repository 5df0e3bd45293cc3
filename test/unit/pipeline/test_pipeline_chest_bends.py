"""Bends that are walked without a stop: what turns the walk is no tilt."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from support.chest import estimated, walk

SEEDS = range(1, 9)
BEGIN_M = 15.0  # behind the stretch of 10 m that shows how long steps are
LENGTH_M = 44.0
GRAVITY_MPS2 = np.array([0.0, 0.0, STANDARD_GRAVITY_MPS2])


def circle_rad(way_m):
    return np.maximum(way_m - BEGIN_M, 0.0) / 3.0


def corners_rad(way_m):
    """Three of 90 degrees, each within 2 m."""
    return sum(0.5 * np.pi * np.clip((way_m - BEGIN_M - 12.0 * k) / 2.0, 0.0, 1.0) for k in range(3))


def slalom_rad(way_m):
    return np.radians(40.0) * np.sin(2.0 * np.pi * np.maximum(way_m - BEGIN_M, 0.0) / 12.0)


def bent(seed, direction_rad):
    """A straight walk with its way bent, by the same sensor: the samples, and where it ends."""
    true = walk(seed, LENGTH_M, name="straight")
    time_s, motion = true.imu.stamp_ns / 1e9, true.motion
    position_m, turn_rad = bent_way(motion.position_m, direction_rad)
    turn = Rotation.from_euler("z", turn_rad)
    force = CubicSpline(time_s, position_m)(time_s, 2) + GRAVITY_MPS2
    straight_force = motion.acceleration_mps2 + GRAVITY_MPS2
    before = Rotation.from_quat(motion.quat_xyzw)
    more_force = (turn * before).inv().apply(force) - before.inv().apply(straight_force)
    more_rate = before.inv().apply(CubicSpline(time_s, turn_rad)(time_s, 1)[:, None] * [0.0, 0.0, 1.0])
    imu = true.imu
    return imu._replace(accel_mps2=imu.accel_mps2 + more_force, gyro_radps=imu.gyro_radps + more_rate), position_m[-1]


def bent_way(position_m, direction_rad):
    """Return the positions of a walk along x, (n, 3), beside a way of such directions, and these, (n,)."""
    grid_m = np.arange(-1.0, position_m[:, 0].max() + 1.0, 0.01)
    way = direction_rad(grid_m)
    east, north = (CubicSpline(grid_m, of(way)).antiderivative() for of in (np.cos, np.sin))
    ahead, left, up = position_m.T
    turn_rad = np.interp(ahead, grid_m, way)
    x, y = east(ahead) - east(0.0) - left * np.sin(turn_rad), north(ahead) - north(0.0) + left * np.cos(turn_rad)
    return np.column_stack([x, y, up]), turn_rad


@pytest.mark.parametrize("direction_rad", [circle_rad, corners_rad, slalom_rad])
def test_who_walks_a_bend_is_not_taken_for_tilted(direction_rad):
    ends, levelled = [], 0
    for seed in SEEDS:
        imu, end_m = bent(seed, direction_rad)
        nav, _, card = estimated(imu)
        ends.append(np.linalg.norm((nav.position_m[-1] - end_m)[:2]))
        levelled += "levelled_anew" in [n.kind for n in card.notices]
    assert levelled <= 1
    assert np.mean(ends) < 0.04 * LENGTH_M

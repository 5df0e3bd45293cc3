"""Installation alignment (Qiu section 2.1): the rotation that turns the axes of any mounting into those of the body.

Qiu calls it R_trans: x in walking direction, z up, y to the left. It is made of two directions in the axes of the foot,
which are seen at every stride: up while the foot stands flat, and the horizontal displacement, turned there by the
attitudes of both stances. No angle of a mounting is used, so no mounting is singular, and the yaw of the track, which
is arbitrary without a magnetometer, cancels. Both are averaged robustly over straight strides.

A person who walks backwards all the time is not told from one who walks forwards: the body's x then points to the heel.
"""

from collections import deque
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.gait.foot_events import Marks
from pdr_core.gait.samples import Cycle
from pdr_core.maths.quaternion import matrix, turn_about_up_rad
from pdr_core.records import Floats
from pdr_core.records_gait import Mounting

STRAIGHT_RAD = 0.26  # 15 deg: a foot that turns by more walks a turn
SHORTEST_M = 0.3  # a shorter displacement hardly has a direction
ENOUGH = 6  # straight strides, of one foot
FEWEST = 2  # where the recording has no more
REMEMBERED = 40  # strides, the last ones
SPREAD_RAD = 0.26  # 15 deg: strides that differ by more do not agree
AGREEING = 0.75  # share of the strides that must
SURE_RAD = 0.05  # standard deviation of the walking direction
BIAS_TILT_RAD = 0.005  # a bias of the accelerometer tilts every stride alike: 0.05 m/s^2, as of consumer sensors
OUTLIER = 4.4  # times the median distance: 3 sigma of a direction with equal errors either way


class Direction(NamedTuple):
    """What many directions amount to."""

    mean: Floats  # (3,) unit vector
    spread_rad: float  # of one of them
    agreeing: float  # share of those near the middle


class WalkedStride(NamedTuple):
    """What a straight stride tells of the mounting, in foot axes at the stances before and after it."""

    up: Floats  # (2, 3)
    ahead: Floats  # (2, 3) unit vectors


class Installation:
    """Gathers strides until they tell how the sensor sits on the foot."""

    def __init__(self) -> None:
        self._strides: deque[WalkedStride] = deque(maxlen=REMEMBERED)

    def add(self, cycle: Cycle, marks: Marks) -> None:
        """Take the next stride; only straight ones count, of which every sample is there."""
        stride = walked_stride(cycle, marks)
        if stride:
            self._strides.append(stride)

    def found(self, enough: int = ENOUGH) -> Mounting | None:
        """Return the mounting once so many strides agree on it, else None."""
        return None if self.doubt(enough) else mounting(self._strides)

    def doubt(self, enough: int = ENOUGH) -> str:
        """Return why the mounting is not known yet, or nothing."""
        if len(self._strides) < enough:
            return f"{len(self._strides)} straight strides were found, and it takes {enough}"
        ahead = direction(np.concatenate([stride.ahead for stride in self._strides]))
        if ahead.spread_rad > SPREAD_RAD or ahead.agreeing < AGREEING:
            return f"the strides do not agree on a walking direction: they differ by {ahead.spread_rad:.2f} rad"
        if enough == ENOUGH and mounting(self._strides).yaw_sd_rad > SURE_RAD:
            return "the walking direction is not certain yet"
        return ""


def walked_stride(cycle: Cycle, marks: Marks) -> WalkedStride | None:
    """Return what a stride tells of the mounting; None where it turns, goes nowhere or has samples missing."""
    flat = cycle.samples[[marks.flat_before, marks.flat_after]]
    moved_m = cycle.samples["position_m"][cycle.last] - cycle.samples["position_m"][cycle.first]
    length_m = float(np.hypot(moved_m[0], moved_m[1]))
    turn_rad = abs(turn_about_up_rad(*flat["quat_xyzw"]))
    if not marks.seen or length_m < SHORTEST_M or turn_rad > STRAIGHT_RAD:
        return None
    level = np.array([moved_m[0], moved_m[1], 0.0]) / length_m
    ahead = [matrix(quat_xyzw).T @ level for quat_xyzw in flat["quat_xyzw"]]
    return WalkedStride(flat["up"], np.array(ahead))


def mounting(strides: Sequence[WalkedStride]) -> Mounting:
    """Return the mounting that strides tell, two or more, and how sure they are: as their mean, by their spread."""
    up = direction(np.concatenate([stride.up for stride in strides]))
    ahead = direction(np.concatenate([stride.ahead for stride in strides]))
    z = up.mean
    y = np.cross(z, ahead.mean)
    y /= np.linalg.norm(y)
    R_body_from_foot = np.array([np.cross(y, z), y, z])
    root = np.sqrt(len(strides))
    quat_xyzw = Rotation.from_matrix(R_body_from_foot).as_quat()
    tilt_sd_rad = float(np.hypot(up.spread_rad / root, BIAS_TILT_RAD))
    return Mounting(quat_xyzw, tilt_sd_rad, float(ahead.spread_rad / root), len(strides))


def direction(vectors: Floats) -> Direction:
    """Return the mean of unit vectors, (n, 3), without those far from their middle; opposite ones have no middle."""
    middle = np.median(vectors, axis=0)
    if np.linalg.norm(middle) < 1e-3:
        return Direction(np.array([1.0, 0.0, 0.0]), np.pi, 0.0)
    distance_rad = _angles_rad(vectors, middle / np.linalg.norm(middle))
    near = distance_rad <= OUTLIER * np.median(distance_rad) + 1e-9
    mean = vectors[near].mean(axis=0)
    mean /= np.linalg.norm(mean)
    return Direction(mean, float(np.sqrt(np.mean(_angles_rad(vectors[near], mean) ** 2))), float(near.mean()))


def _angles_rad(vectors: Floats, unit: Floats) -> Floats:
    """Return the angles between vectors, (n, 3), and one."""
    return np.arctan2(np.linalg.norm(np.cross(vectors, unit), axis=1), vectors @ unit)

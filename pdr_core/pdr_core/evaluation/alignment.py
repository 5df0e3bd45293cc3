"""Laying one track onto another by a turn about the vertical and a shift, the freedoms an unaided track really has.

Gravity makes roll and pitch observable, so they are not fitted, except to match other tools. Rows are
positions [m], (n, 2) or (n, 3), z up.
"""

import math
from typing import NamedTuple

import numpy as np

from pdr_core.records import Floats


class Alignment(NamedTuple):
    """A turn about z, then a shift."""

    yaw_rad: float  # counter-clockwise
    shift_m: Floats  # (2,) or (3,)

    def apply(self, position_m: Floats) -> Floats:
        """Return the positions, (n, 2) or (n, 3) as the alignment was made, in the frame of the other track."""
        return _turned(position_m, self.yaw_rad) + self.shift_m


def over_whole(moving_m: Floats, fixed_m: Floats) -> Alignment:
    """Return the least-squares alignment over all rows, closed form (Umeyama 1991 in 2-D; z: the mean offset)."""
    moving_mean, fixed_mean = moving_m.mean(axis=0), fixed_m.mean(axis=0)
    return _about(moving_m, moving_mean, fixed_m, fixed_mean)


def at_start(moving_m: Floats, fixed_m: Floats, start_path_m: float) -> Alignment:
    """Return the alignment that pins the first rows, its yaw fitted over the first metres of the fixed path.

    At least two rows are used, however long the first step.
    """
    steps_m = np.linalg.norm(np.diff(fixed_m[:, :2], axis=0), axis=1)
    rows = 1 + max(1, int(np.searchsorted(np.cumsum(steps_m), start_path_m, side="right")))
    return _about(moving_m[:rows], moving_m[0], fixed_m[:rows], fixed_m[0])


class RigidAlignment(NamedTuple):
    """Any turn, then a shift."""

    R_fixed_from_moving: Floats  # (3, 3)
    shift_m: Floats  # (3,)

    def apply(self, position_m: Floats) -> Floats:
        """Return the positions, (n, 3), in the frame of the other track."""
        return position_m @ self.R_fixed_from_moving.T + self.shift_m


def rigid(moving_m: Floats, fixed_m: Floats) -> RigidAlignment:
    """Return the least-squares turn and shift in space over all rows, (n, 3) (Umeyama 1991 eq. 38-43 without scale).

    It turns roll and pitch too, which no track of ours is free in: for comparison with others only.
    """
    moving_mean, fixed_mean = moving_m.mean(axis=0), fixed_m.mean(axis=0)
    U, _, Vt = np.linalg.svd((fixed_m - fixed_mean).T @ (moving_m - moving_mean))
    R = U @ np.diag([1.0, 1.0, np.sign(np.linalg.det(U) * np.linalg.det(Vt))]) @ Vt
    return RigidAlignment(R, fixed_mean - R @ moving_mean)


def _about(moving_m: Floats, moving_pivot_m: Floats, fixed_m: Floats, fixed_pivot_m: Floats) -> Alignment:
    """Return the alignment that lays pivot on pivot with the least-squares yaw about them."""
    (mx, my), (fx, fy) = (moving_m - moving_pivot_m).T[:2], (fixed_m - fixed_pivot_m).T[:2]
    yaw_rad = math.atan2(float(np.sum(mx * fy - my * fx)), float(np.sum(mx * fx + my * fy)))
    return Alignment(yaw_rad, fixed_pivot_m - _turned(moving_pivot_m[None], yaw_rad)[0])


def _turned(position_m: Floats, yaw_rad: float) -> Floats:
    """Return the positions, (n, 2) or (n, 3), turned about z."""
    cosine, sine = math.cos(yaw_rad), math.sin(yaw_rad)
    turned_m = np.array(position_m, dtype=np.float64)
    turned_m[:, :2] = position_m[:, :2] @ np.array([[cosine, sine], [-sine, cosine]])
    return turned_m

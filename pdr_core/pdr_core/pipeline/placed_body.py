"""The way of the body laid where somebody says that she is: turned and shifted as a whole, from then on.

The worlds of the feet stay as they are. At a row the covariance of x, y and yaw is that which was told, moved along the
way since, and what the way itself has lost.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.external.known_points import PLANE, grown_since
from pdr_core.maths.quaternion import from_euler, multiply, yaw_rad
from pdr_core.records import Floats, NavBlock, PoseEstimate, length
from pdr_core.records_external import about_up, lever

Z = 2


class Placed(NamedTuple):
    """Where she was by her own way, and where she was said to be."""

    own_m: Floats  # (3,)
    own_covariance: Floats  # (6, 6)
    told_m: Floats  # (3,)
    told_covariance: Floats  # (6, 6)
    turn_rad: float


class PlacedBody:
    """Takes rows of the body, and poses at which she is."""

    def __init__(self) -> None:
        self._told: PoseEstimate | None = None  # that waits for the next row
        self._placed: Placed | None = None

    def place(self, pose: PoseEstimate, _keep_biases: bool = True) -> None:
        """Lay the next row there; a pose without a quaternion keeps the yaw. Biases are the feet's."""
        self._told = pose

    def run(self, body: NavBlock) -> NavBlock:
        """Return the rows as they are laid."""
        if length(body) and self._told:
            self._placed, self._told = self._begun(body, self._told), None
        return laid(body, self._placed) if self._placed else body

    def _begun(self, body: NavBlock, told: PoseEstimate) -> Placed:
        turn_rad = self._placed.turn_rad if self._placed else 0.0
        if told.quat_xyzw is not None:
            turn_rad = float(yaw_rad(told.quat_xyzw) - yaw_rad(body.quat_xyzw[0]))
        return Placed(body.position_m[0], body.pose_covariance[0], told.position_m, told.covariance, turn_rad)


def laid(body: NavBlock, placed: Placed) -> NavBlock:
    """Return rows turned and shifted."""
    R = about_up(placed.turn_rad)
    turn = from_euler(0.0, 0.0, placed.turn_rad)
    return body._replace(
        position_m=placed.told_m + (body.position_m - placed.own_m) @ R.T,
        quat_xyzw=np.array([multiply(turn, quat) for quat in body.quat_xyzw]).reshape(-1, 4),
        pose_covariance=np.array([covariance(body, i, placed, R) for i in range(length(body))]).reshape(-1, 6, 6),
    )


def covariance(body: NavBlock, i: int, placed: Placed, R: Floats) -> Floats:
    """Return that of a row, (6, 6); roll and pitch keep theirs."""
    own, out = body.pose_covariance[i], np.diag(np.diag(body.pose_covariance[i]))
    way_m = body.position_m[i] - placed.own_m
    T = lever((R @ way_m)[:2])
    grown = grown_since(placed.own_covariance[PLANE], own[PLANE], way_m[:2])
    out[PLANE] = T @ placed.told_covariance[PLANE] @ T.T + R @ grown @ R.T
    out[Z, Z] = placed.told_covariance[Z, Z] + max(own[Z, Z] - placed.own_covariance[Z, Z], 0.0)
    return out

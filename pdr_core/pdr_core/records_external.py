"""What somebody else says of where the person is, and how their frame lies to ours."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pdr_core.records import Floats, Stamps


class FixBlock(NamedTuple):
    """n positions that somebody else has measured, in a frame and by a clock of their own."""

    stamp_ns: Stamps  # (n,) their clock
    position_m: Floats  # (n, 3) their frame, z up
    variance_m2: Floats  # (n, 3) of x, y, z; 0: unknown
    yaw_rad: Floats  # (n,) of what was seen there, counter-clockwise in their frame; NaN: unknown


@dataclass(frozen=True)
class ExternalFrame:
    """Their frame from ours: a place p of ours at our stamp t is R(yaw) p + shift at their stamp t + clock."""

    yaw_rad: float  # counter-clockwise
    shift_m: Floats  # (3,)
    clock_ns: int  # their stamp minus ours
    covariance: Floats  # (4, 4) of x, y [m], yaw [rad] and clock [s]; x and y at `about_m`
    about_m: Floats  # (2,) the place of ours at which the shift is known as the covariance says

    def theirs_m(self, ours_m: Floats) -> Floats:
        """Return places (..., 3) of ours in their frame."""
        return ours_m @ about_up(self.yaw_rad).T + self.shift_m

    def ours_m(self, theirs_m: Floats) -> Floats:
        """Return places (..., 3) of theirs in our frame."""
        return (theirs_m - self.shift_m) @ about_up(self.yaw_rad)

    @property
    def quat_xyzw(self) -> Floats:
        """The turn from our frame to theirs, (4,)."""
        return np.array([0.0, 0.0, np.sin(0.5 * self.yaw_rad), np.cos(0.5 * self.yaw_rad)])

    @property
    def clock_sd_s(self) -> float:
        """How well the clock is known."""
        return float(np.sqrt(self.covariance[3, 3]))

    @property
    def origin_covariance(self) -> Floats:
        """The covariance (3, 3) of x, y and yaw of our origin in their frame."""
        return self.pose_covariance(np.zeros(2))

    def pose_covariance(self, ours_m: Floats) -> Floats:
        """Return how well a place (2,) or (3,) of ours and the yaw are known in their frame by it alone, (3, 3)."""
        T = self.lever_to(ours_m)
        return T @ self.covariance[:3, :3] @ T.T

    def lever_to(self, ours_m: Floats) -> Floats:
        """Return what errors of x, y and yaw at `about_m` become at a place (2,) or (3,) of ours, (3, 3)."""
        return lever(about_up(self.yaw_rad)[:2, :2] @ (np.asarray(ours_m)[:2] - self.about_m))

    def place_covariance_m2(self, ours_m: Floats) -> Floats:
        """Return that of the place alone, (2, 2)."""
        return self.pose_covariance(ours_m)[:2, :2]


@dataclass(frozen=True)
class ExternalComparison:
    """Our track beside theirs, so far."""

    frame: ExternalFrame | None  # None: not known yet
    pairs: int
    ate_m: float  # horizontal RMSE after the best yaw and shift; NaN: not known yet


def about_up(angle_rad: float) -> Floats:
    """Return the rotation (3, 3) by an angle about z."""
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def yaw_or_none(quat_xyzw: Sequence[float]) -> float:
    """Return the yaw [rad] of a quaternion; NaN of one that is none."""
    x, y, z, w = quat_xyzw
    norm = x * x + y * y + z * z + w * w
    return math.atan2(2.0 * (w * z + x * y), norm - 2.0 * (y * y + z * z)) if norm > 0.5 else math.nan


def known_variances(variances: Sequence[float]) -> list[float]:
    """Return variances of x, y, z; zeros, which say that they are unknown, where one is no variance."""
    usable = [v if math.isfinite(v) and v > 0.0 else 0.0 for v in variances]
    return usable if all(usable[:2]) else [0.0, 0.0, 0.0]


def unknown_yaws(count: int) -> Floats:
    """Return yaws (n,) of fixes that tell none."""
    return np.full(count, np.nan)


def lever(way_m: Floats) -> Floats:
    """Return what errors of x, y and yaw become at the end of a way (2,), (3, 3)."""
    x, y = way_m
    return np.array([[1.0, 0.0, -y], [0.0, 1.0, x], [0.0, 0.0, 1.0]])

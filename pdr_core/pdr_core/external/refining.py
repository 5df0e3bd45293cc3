"""A frame that was found early becomes better by each fix that is believed: above all its clock, at the first turn.

Four unknowns f = (x, y at `about_m`, yaw, clock) have the covariance C of the fit. On a straight line the clock and the
shift along it are one error, large and without any effect there. Where our track is at p with the velocity v, and R
turns from our frame to theirs, a fix is expected to move with the unknowns by

    H = [ J(p), -R v ],

J being `ExternalFrame.pose_covariance`'s. With the covariance P of our place, the noise s of the fix, and r by which
the fix is off,

    S = H C H' + R P R' + s^2 I,      K = C H' S^-1,      f += K r,      C -= K S K'.

So of what a fix says the frame takes the share that its own errors may have, and our place the rest. On the line on
which both were aligned H C H' is small; after a turn it is the difference of both speeds times the clock's error.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.records import Floats
from pdr_core.records_external import ExternalFrame, about_up, lever

CLOCK = 3


class Apart(NamedTuple):
    """A fix beside our place, in our frame."""

    off_m: Floats  # (3,) the fix minus our place
    moves: Floats  # (2, 4) where the fix is expected moves so with the frame: R' H
    covariance_m2: Floats  # (2, 2) of our place
    sd_m: float  # of the fix


def given_clock(frame: ExternalFrame) -> ExternalFrame:
    """Return the frame as well as it is known by one who knows the clock."""
    C = frame.covariance
    by_clock = C[:, CLOCK] / max(C[CLOCK, CLOCK], 1e-12)
    return replace(frame, covariance=C - np.outer(by_clock, by_clock) * C[CLOCK, CLOCK])


def with_point(frame: ExternalFrame, point_sd_m: float) -> ExternalFrame:
    """Return the frame as well as it is known where their point lies beside ours, which is so in every fix alike.

    No mean over fixes takes that away; on a line the shift hides it, and after a turn it shows. An offset w in a
    direction that nobody knows, u, has the covariance w^2 E[u u'] = w^2 / 2 I.
    """
    of_axis_m2 = 0.5 * point_sd_m**2
    return replace(frame, covariance=frame.covariance + np.diag([of_axis_m2, of_axis_m2, 0.0, 0.0]))


def moves(frame: ExternalFrame, ours_m: Floats, velocity_mps: Floats) -> Floats:
    """Return R' H, (2, 4), at a place (2,) and a velocity (2,) of ours."""
    R = about_up(frame.yaw_rad)[:2, :2]
    return np.column_stack([R.T @ lever(R @ (ours_m - frame.about_m))[:2], -velocity_mps])


def by_frame_m2(frame: ExternalFrame, fix: Apart) -> Floats:
    """Return the covariance (2, 2) that the frame gives a fix in our frame."""
    return np.asarray(fix.moves @ frame.covariance @ fix.moves.T)


def refined(frame: ExternalFrame, fix: Apart) -> ExternalFrame:
    """Return the frame as it is known with one more fix."""
    S = by_frame_m2(frame, fix) + fix.covariance_m2 + fix.sd_m**2 * np.eye(2)
    K = np.linalg.solve(S, fix.moves @ frame.covariance).T
    x, y, turn_rad, clock_s = (K @ fix.off_m[:2]).tolist()
    yaw_rad, about_m = frame.yaw_rad + turn_rad, np.append(frame.about_m, 0.0)
    shift_m = frame.theirs_m(about_m) + np.array([x, y, 0.0]) - about_up(yaw_rad) @ about_m
    clock_ns = frame.clock_ns + round(clock_s * NANOSECONDS)
    return ExternalFrame(yaw_rad, shift_m, clock_ns, frame.covariance - K @ S @ K.T, frame.about_m)

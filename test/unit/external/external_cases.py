"""Tracks and fixes whose answer is known: a foot that goes a way with turns, and somebody who sees where it is."""

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.external.aligning import Fixes
from pdr_core.external.free_track import FreeTrack
from pdr_core.maths.quaternion import from_euler
from pdr_core.records import NavBlock, StepEvent
from pdr_core.records_external import about_up

BEGIN_NS = 1_700_000_000_000_000_000
RATE_HZ = 100.0
SPEED_MPS = 1.3


def nav_rows(time_s, position_m, yaw_rad=None, rate_radps=None):
    """Estimates of a foot that points along a yaw."""
    n = len(time_s)
    yaw_rad = np.zeros(n) if yaw_rad is None else yaw_rad
    rates = np.zeros((n, 3))
    rates[:, 2] = 0.0 if rate_radps is None else rate_radps
    stamps = BEGIN_NS + np.rint(np.asarray(time_s) * NANOSECONDS).astype(np.int64)
    quats = np.array([from_euler(0.0, 0.0, yaw) for yaw in yaw_rad])
    return NavBlock(stamps, position_m, quats, np.zeros((n, 3)), rates, np.zeros((n, 6, 6)), np.zeros((n, 6, 6)))


def way(duration_s, turn_at_s=(), turn_rad=np.pi / 2.0):
    """Times and places (n, 3) of one who turns within a second at some times, at an even speed."""
    t = np.arange(0.0, duration_s, 1.0 / RATE_HZ)
    heading = sum((turn_rad * np.clip(t - at_s, 0.0, 1.0) for at_s in turn_at_s), np.zeros(len(t)))
    steps = SPEED_MPS / RATE_HZ * np.column_stack([np.cos(heading), np.sin(heading), np.zeros(len(t))])
    return t, np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)[:-1]])


def track_of(t, position_m, window_s=0.0):
    """A track that has heard all of it."""
    track = FreeTrack(window_s)
    track.add(nav_rows(t, position_m))
    return track


def seen_fixes(t, position_m, yaw_rad, shift_m, clock_s, sd_m=0.3, seed=None, every_s=1.0):
    """What somebody says of the places, each second, by a clock that is ahead; without a seed without noise."""
    at_s = np.arange(2.0, t[-1] - 2.0, every_s)
    true_m = np.column_stack([np.interp(at_s, t, column) for column in position_m.T])
    theirs_m = true_m @ about_up(yaw_rad).T + np.asarray(shift_m)
    if seed is not None:
        theirs_m = theirs_m + sd_m * np.random.default_rng(seed).standard_normal(theirs_m.shape)
    stamps = BEGIN_NS + np.rint((at_s + clock_s) * NANOSECONDS).astype(np.int64)
    return Fixes(stamps, theirs_m, np.full(len(at_s), sd_m))


def some(fixes, first, last=None):
    """Fixes from the first to before the last."""
    return Fixes(*(column[first:last] for column in fixes))


def step_at(index, start_s, end_s, start_m, end_m, due_s=0.4):
    """A step between two times and places."""
    stamp = [BEGIN_NS + round(s * NANOSECONDS) for s in (start_s, end_s, end_s + due_s)]
    return StepEvent(
        index, stamp[0], stamp[1], np.array(end_m), np.subtract(end_m, start_m), 1e-4 * np.eye(3), 0.0, 0.01, stamp[2],
        position_covariance_m2=0.01 * np.eye(3),
    )  # fmt: skip

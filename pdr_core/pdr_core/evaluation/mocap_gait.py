"""Strides and foot pitch against markers on heel and toe.

A foot rests while both markers are slower than `RESTING_MPS`; what is between two rests and takes the foot as far as a
step must is a true stride. It is found where one step of the estimate holds its middle, and no other. Its true length
is how far the middle between heel and toe moved, horizontally, from the end of one stance to that of the next, as the
estimate has them: then the foot is flat. Where the foot turns on the way, the sensor goes another way than the middle,
by its lever arm, which nobody measured: such strides count, but their lengths are not compared.

The pitch is the elevation of the toe above the heel; the difference to that of the estimate's x axis in mid-stance,
the median over all of them, is how sensor and markers were attached, and is taken off.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS, nanoseconds
from pdr_core.evaluation.orientation_study import GaitErrors, PitchCycle
from pdr_core.maths.runs import equal_runs
from pdr_core.records import Flags, Floats, Stamps, StepEvent, Truth

RESTING_MPS = 0.3
SHORTEST_REST_NS = nanoseconds(0.1)
SHORTEST_STRIDE_M = 0.05
TURNED_RAD = np.radians(20.0)


class Markers(NamedTuple):
    """Heel and toe over time."""

    stamp_ns: Stamps  # (n,)
    heel_m: Floats  # (n, 3)
    toe_m: Floats  # (n, 3)


def markers(truth: Truth | None) -> Markers | None:
    """Return heel and toe, in this order the points of the truth, or None if it does not have two."""
    if truth is None or truth.points_m is None or truth.points_m.shape[1] != 2 or len(truth.stamp_ns) < 3:
        return None
    return Markers(truth.stamp_ns, truth.points_m[:, 0], truth.points_m[:, 1])


def at(found: Markers, stamp_ns: Stamps) -> Markers:
    """Return the markers at other stamps, by straight lines."""
    columns = ((np.interp(stamp_ns, found.stamp_ns, m[:, i]) for i in range(3)) for m in found[1:])
    return Markers(stamp_ns, *(np.column_stack(list(column)) for column in columns))


def pitch_rad(found: Markers) -> Floats:
    """Return the elevation of the toe above the heel, (n,)."""
    along = found.toe_m - found.heel_m
    return np.arctan2(along[:, 2], np.hypot(along[:, 0], along[:, 1]))


def yaw_rad(found: Markers) -> Floats:
    """Return the direction from heel to toe, (n,), without jumps."""
    along = found.toe_m - found.heel_m
    return np.unwrap(np.arctan2(along[:, 1], along[:, 0]))


def estimated_pitch_rad(quat_xyzw: Floats) -> Floats:
    """Return the elevation of the foot's x axis, (n,); x up is positive, unlike REP-103's pitch."""
    x, y, z, w = quat_xyzw.T
    return np.arcsin(np.clip(2.0 * (x * z - y * w), -1.0, 1.0))


def true_strides_ns(found: Markers) -> Stamps:
    """Return when each true stride begins and ends, (strides, 2)."""
    edges = np.flatnonzero(np.diff(resting(found).astype(np.int8)))
    middle_m = 0.5 * (found.heel_m + found.toe_m)
    strides = [
        (found.stamp_ns[a], found.stamp_ns[b])
        for a, b in pairwise(edges)
        if not resting(found)[a + 1] and np.ptp(middle_m[a : b + 1], axis=0).max() >= SHORTEST_STRIDE_M
    ]
    return np.array(strides, np.int64).reshape(-1, 2)


def resting(found: Markers) -> Flags:
    """Return where both markers rest, for a while, (n,)."""
    time_s = (found.stamp_ns - found.stamp_ns[0]) / NANOSECONDS
    speeds = [np.linalg.norm(np.gradient(m, time_s, axis=0), axis=1) for m in found[1:]]
    rests = np.max(speeds, axis=0) < RESTING_MPS
    for a, b in equal_runs(rests):
        if rests[a] and found.stamp_ns[min(b, len(rests) - 1)] - found.stamp_ns[a] < SHORTEST_REST_NS:
            rests[a:b] = False
    return rests


def middles_ns(strides_ns: Stamps) -> Stamps:
    """Return the middles between strides, (strides - 1,): mid-stance."""
    return (strides_ns[:-1, 1] + strides_ns[1:, 0]) // 2


def gait_errors(found: Markers, stamp_ns: Stamps, quat_xyzw: Floats, steps: Sequence[StepEvent]) -> GaitErrors:
    """Return how far off steps and orientations, (n,) and (n, 4), are."""
    strides_ns = true_strides_ns(found)
    ends_ns = np.array([(s.start_ns, s.stamp_ns) for s in steps], np.int64).reshape(-1, 2)
    lengths_m = np.array([s.length_m for s in steps])
    middle_ns = strides_ns.mean(axis=1)
    inside = (ends_ns[:, :1] < middle_ns) & (middle_ns <= ends_ns[:, 1:])  # (steps, strides)
    alone = inside.sum(axis=1) == 1
    true_m, turned_rad = displaced(found, ends_ns)
    compared = alone & (turned_rad <= TURNED_RAD)
    walking = (stamp_ns >= strides_ns[:1, 0].sum()) & (stamp_ns <= strides_ns[-1:, 1].sum())
    off_rad = pitch_off_rad(found, stamp_ns, quat_xyzw, middles_ns(strides_ns))
    return GaitErrors(
        int(alone.sum()),
        len(strides_ns),
        int((inside.sum(axis=1) == 0).sum()),
        (lengths_m - true_m)[compared],
        true_m[compared],
        off_rad,
        float(np.sqrt(np.mean((difference_rad(found, stamp_ns, quat_xyzw)[walking] - off_rad) ** 2))),
    )


def displaced(found: Markers, ends_ns: Stamps) -> tuple[Floats, Floats]:
    """Return how far the foot went between stamps, (k, 2), and by how much it turned, (k,) each."""
    start, end = at(found, ends_ns[:, 0]), at(found, ends_ns[:, 1])
    moved_m = 0.5 * (end.heel_m + end.toe_m - start.heel_m - start.toe_m)
    turned_rad = [np.interp(ends_ns[:, i], found.stamp_ns, yaw_rad(found)) for i in range(2)]
    return np.hypot(moved_m[:, 0], moved_m[:, 1]), np.abs(turned_rad[1] - turned_rad[0])


def difference_rad(found: Markers, stamp_ns: Stamps, quat_xyzw: Floats) -> Floats:
    """Return the estimated minus the true pitch, (n,)."""
    return estimated_pitch_rad(quat_xyzw) - pitch_rad(at(found, stamp_ns))


def pitch_off_rad(found: Markers, stamp_ns: Stamps, quat_xyzw: Floats, middle_ns: Stamps) -> float:
    """Return the median of that in mid-stance."""
    difference = np.interp(middle_ns, stamp_ns, difference_rad(found, stamp_ns, quat_xyzw))
    return float(np.median(difference)) if len(difference) else float("nan")


def pitch_cycle(found: Markers, stamp_ns: Stamps, orientations: dict[str, Floats]) -> PitchCycle | None:
    """Return the pitch over the cycle of the longest stride; None if there is none."""
    middle_ns = middles_ns(true_strides_ns(found))
    if len(middle_ns) < 2:
        return None
    first = int(np.argmax(displaced(found, np.column_stack([middle_ns[:-1], middle_ns[1:]]))[0]))
    within = (stamp_ns >= middle_ns[first]) & (stamp_ns <= middle_ns[first + 1])
    time_s = (stamp_ns[within] - middle_ns[first]) / NANOSECONDS
    estimated = {
        name: estimated_pitch_rad(q[within]) - pitch_off_rad(found, stamp_ns, q, middle_ns)
        for name, q in orientations.items()
    }
    return PitchCycle(time_s, pitch_rad(at(found, stamp_ns[within])), estimated)

"""Where a gyro clips, the swing goes on: the flanks on both sides tell how high the rate has been.

A foot in a fast swing or a heel strike exceeds the range of many gyros. What is left is a plateau, entered and left
steeply. A cubic (Hermite) through the samples before and after it, with the slopes found there, bridges it. Where this
curve stands above the plateau by more than the plateau's own unevenness, the gyro was clipped: a smooth peak is met by
the curve and stays as it is. So neither the range nor the slopes need to be known; but an axis that has shown more
before does not clip at less. Each axis of the sensor clips by itself, so this comes before any rotation.

A sample that may lie on a plateau waits until the plateau is over, at most `longest_ns`. Nothing here depends on how
the stream is cut.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.maths.compiled import compiled
from pdr_core.records import Flags, Floats, Stamps

UNEVEN = 0.013  # of the level: a plateau may vary by as much, the filters in a sensor make it waver
LEVEL_SHARE = 0.97  # of the largest rate seen on this side of the axis
FEWEST = 3  # samples of a plateau
CONTEXT = 2  # samples before a plateau that its slope needs, and after it
WAIT, PLAIN, PLATEAU = 0, 1, 2


class ClipLimits(NamedTuple):
    """The numbers of the repair."""

    smallest_radps: float  # no gyro clips below
    longest_ns: int


class Waiting(NamedTuple):
    """Samples that are undecided on some axis, after the last ones that are not. Three axes, two sides each."""

    stamp_ns: Stamps  # (n,)
    measured: Floats  # (n, 3) [rad/s]
    repaired: Floats  # (n, 3)
    clipped: Flags  # (n,)
    undecided: Stamps  # (3,) the first undecided sample of each axis
    seen: Floats  # (3, 2) the largest magnitude so far of positive and negative rates


@compiled
def repair(w: Waiting, limits: ClipLimits, final: bool) -> int:
    """Decide as many samples as possible, in place; return up to which all axes are decided."""
    for axis in range(3):
        x, i = w.measured[:, axis], w.undecided[axis]
        while i < x.shape[0]:
            side = 0 if x[i] >= 0.0 else 1
            level = max(limits.smallest_radps, LEVEL_SHARE * w.seen[axis, side])
            verdict, stop = plateau(w.stamp_ns, x, i, level, limits.longest_ns)
            if verdict == WAIT and not final:
                break
            if verdict == PLATEAU:
                bridge(w, axis, i, stop)
            for k in range(i, stop):
                w.seen[axis, side] = max(w.seen[axis, side], abs(x[k]))
            i = stop
        w.undecided[axis] = i
    return min(w.undecided[0], w.undecided[1], w.undecided[2])


@compiled
def plateau(stamp_ns: Stamps, x: Floats, start: int, level: float, longest_ns: int) -> tuple[int, int]:
    """Return what begins at a sample, and where it ends: a plateau, no plateau, or something still to be seen."""
    n, sign = x.shape[0], np.sign(x[start])
    top = sign * x[start]
    if top < level:
        return PLAIN, start + 1
    stop = start + 1
    while stop < n and sign * x[stop] >= (1.0 - UNEVEN) * top and gapless(stamp_ns, stop):
        if stamp_ns[stop] - stamp_ns[start] > longest_ns:
            return PLAIN, stop
        top = max(top, sign * x[stop])
        if sign * x[start] < (1.0 - UNEVEN) * top:
            return PLAIN, start + 1
        stop += 1
    if stop + CONTEXT > n and (stop == n or gapless(stamp_ns, stop)):
        return WAIT, stop
    over_in_time = stop + 1 < n and stamp_ns[stop + 1] - stamp_ns[start] <= longest_ns
    return (PLATEAU if over_in_time and stop - start >= FEWEST else PLAIN), stop


@compiled
def gapless(stamp_ns: Stamps, i: int) -> bool:
    """Return whether sample i follows its predecessor without a gap or a jump of the clock."""
    return 0 < stamp_ns[i] - stamp_ns[i - 1] <= GAP_NS


@compiled
def bridge(w: Waiting, axis: int, start: int, stop: int) -> None:
    """Replace the plateau start:stop of an axis by the curve from its flanks, if that stands clearly above it."""
    x, first, last = w.measured[:, axis], start - 1, stop
    if first < 1 or last + 1 >= x.shape[0]:
        return
    for k in range(first, last + 2):
        if not gapless(w.stamp_ns, k):
            return
    sign = np.sign(x[start])
    rise, fall = slope(w.stamp_ns, x, first), slope(w.stamp_ns, x, last + 1)
    duration_s = (w.stamp_ns[last] - w.stamp_ns[first]) * 1e-9
    level, height = np.max(np.abs(x[start:stop])), 0.0
    curve = np.empty(stop - start)
    for k in range(start, stop):
        share = (w.stamp_ns[k] - w.stamp_ns[first]) * 1e-9 / duration_s
        curve[k - start] = hermite(share, x[first], x[last], rise * duration_s, fall * duration_s)
        height = max(height, sign * curve[k - start])
    if sign * rise <= 0.0 or sign * fall >= 0.0 or height < (1.0 + UNEVEN) * level:
        return
    for k in range(start, stop):
        w.repaired[k, axis] = sign * max(sign * x[k], min(sign * curve[k - start], 2.0 * level))
        w.clipped[k] = True


@compiled
def slope(stamp_ns: Stamps, x: Floats, i: int) -> float:
    """Return by how much x rises per second up to sample i."""
    return (x[i] - x[i - 1]) / ((stamp_ns[i] - stamp_ns[i - 1]) * 1e-9)


@compiled
def hermite(share: float, begin: float, end: float, rise: float, fall: float) -> float:
    """Return the cubic over 0..1 with these values and derivatives at both ends."""
    u, v = share, 1.0 - share
    return begin * (1.0 + 2.0 * u) * v * v + end * (1.0 + 2.0 * v) * u * u + rise * u * v * v - fall * u * u * v

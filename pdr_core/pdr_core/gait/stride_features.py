"""The figures of a stride between two ground hits, from the motion of the foot."""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.gait.foot_motion import MotionBlock
from pdr_core.gait.lowpass import GRID_NS
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, first_at, let_go, record

SWING_SHARE = 0.62  # of a walked stride in which the foot moves: measured on real walks, 0.49 to 0.68
KEPT = 10 * NANOSECONDS // GRID_NS + 1  # values, where no hit lets go of them
CAPACITY = 2 * KEPT


class StrideFeatures(NamedTuple):
    """One stride, of the paper's variance, direct component and energy the last two, and what length models need."""

    start_ns: int
    hit_ns: int
    frequency_hz: float  # 0: it is none
    rest_s: float  # in which the foot may stand, before it moves
    by_dip: bool  # it ends in a stance in which the foot is never still
    direct_mps2: float  # mean of |a| - g
    energy_mps2: float  # its root mean square
    mean_abs_mps2: float
    max_mps2: float
    min_mps2: float


class RulerLimits(NamedTuple):
    """What a pause is, and a foot that may stand."""

    standing_s: float
    calm_mps2: float


MEMORY = record(  # the motion since the last hit
    [
        ("held", np.int64),
        ("stamp_ns", np.int64, CAPACITY),
        ("beside_mps2", np.float64, CAPACITY),
        ("distance_mps2", np.float64, CAPACITY),
        ("still", np.uint8, CAPACITY),
        ("hit_ns", np.int64),  # the last one, if the foot has moved on since without a pause; NO_STAMP: none
    ],
)


@compiled
def begin_anew(s: Memory) -> None:
    """Know nothing of a stride; what was before a gap belongs to none any more."""
    s.held, s.hit_ns = 0, NO_STAMP


@compiled
def add(motion: MotionBlock, i: int, s: Memory) -> None:
    """Take value i of a motion."""
    if motion.fresh[i]:
        begin_anew(s)
    if s.held == CAPACITY:
        forget(CAPACITY - KEPT, s)
    s.stamp_ns[s.held], s.still[s.held] = motion.stamp_ns[i], motion.still[i]
    s.beside_mps2[s.held], s.distance_mps2[s.held] = motion.beside_mps2[i], motion.distance_mps2[i]
    s.held += 1


@compiled
def forget(first: int, s: Memory) -> None:
    """Let go of the rows before one."""
    for column in (s.beside_mps2, s.distance_mps2):
        let_go(column, first, s.held)
    let_go(s.stamp_ns, first, s.held)
    let_go(s.still, first, s.held)
    s.held -= first


@compiled
def stride(hit_ns: int, by_dip: bool, limits: RulerLimits, s: Memory) -> StrideFeatures:
    """Return the stride that ends with a hit; a frequency of 0: its beginning was not seen, or it is too short.

    A stride from standing begins where a stride would that stands as usual before it moves: nobody knows for how long a
    person meant to stand.
    """
    first, last = max(0, s.held - KEPT), first_at(s.stamp_ns, 0, s.held, hit_ns + 1)
    still, may_stand, begun = rest_of(first, last, limits.calm_mps2, s)
    rest_s, start_ns = seconds(may_stand), NO_STAMP
    if s.hit_ns == NO_STAMP or seconds(still) >= limits.standing_s:
        moving_ns = hit_ns - s.stamp_ns[begun]
        start_ns = hit_ns - round(moving_ns / SWING_SHARE)
        rest_s = (hit_ns - start_ns - moving_ns) / NANOSECONDS
        first = first_at(s.stamp_ns, first, last, start_ns) if still > 0 else last
    found = measured(first, last, hit_ns, rest_s, by_dip, s)
    s.hit_ns = hit_ns
    forget(last, s)
    return found


@compiled
def rest_of(first: int, last: int, calm_mps2: float, s: Memory) -> tuple[int, int, int]:
    """Return how many of the rows first:last are still, in how many the foot may stand, and the last still row."""
    still, may_stand, begun = 0, 0, first
    for i in range(first, last):
        may_stand += s.distance_mps2[i] < calm_mps2
        if s.still[i]:
            still, begun = still + 1, i
    return still, may_stand, begun


@compiled
def seconds(values: int) -> float:
    """Return how long so many values last."""
    return values * GRID_NS / NANOSECONDS


@compiled
def measured(first: int, last: int, hit_ns: int, rest_s: float, by_dip: bool, s: Memory) -> StrideFeatures:
    """Return the figures of the stride over the rows first:last."""
    n, start_ns = last - first, s.stamp_ns[first] - GRID_NS
    if n < 2:
        return StrideFeatures(start_ns, hit_ns, 0.0, rest_s, by_dip, 0.0, 0.0, 0.0, 0.0, 0.0)
    total, squares, absolute, largest, least = 0.0, 0.0, 0.0, -np.inf, np.inf
    for i in range(first, last):
        beside = s.beside_mps2[i]
        total, squares, absolute = total + beside, squares + beside**2, absolute + abs(beside)
        largest, least = max(largest, beside), min(least, beside)
    frequency_hz = NANOSECONDS / (hit_ns - start_ns)
    return StrideFeatures(
        start_ns, hit_ns, frequency_hz, rest_s, by_dip, total / n, np.sqrt(squares / n), absolute / n, largest, least
    )

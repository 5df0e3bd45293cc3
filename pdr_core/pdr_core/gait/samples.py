"""What stride analysis needs of every sample, kept until its stride is complete, in bounded memory."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import GAP_NS
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import difference, norm, row
from pdr_core.records import NO_SAMPLES, NOT_NUMBERED, ImuBlock, NavBlock, StanceBlock, StepEvent, length, part

LIMIT = 20_000  # samples of a stride that are kept, half from each end: what is longer is a foot that stands
FLAT_NS = 1_000_000_000  # of a stance, before its end, in which the foot is looked for at its stillest
BRIDGED_NS = 200_000_000  # interruptions of a stance up to this belong to it: shorter than any swing
SAMPLE = np.dtype(
    [
        ("number", np.int64),  # as the filter counts them
        ("stamp_ns", np.int64),
        ("position_m", np.float64, (3,)),
        ("quat_xyzw", np.float64, (4,)),  # world from foot
        ("up", np.float64, (3,)),  # which way is up, in foot axes
        ("speed_mps", np.float64),
        ("force_mps2", np.float64),  # magnitude of the specific force
        ("jolt_mps2", np.float64),  # magnitude of its change since the sample before
        ("statistic", np.float64),  # of the detector
        ("standing", np.bool_),
        ("seen", np.bool_),  # neither a gap before this sample nor a gyro that is off
    ],
    align=True,
)
Samples = NDArray[Any]  # (n,) of SAMPLE


class Cycle(NamedTuple):
    """A stride among samples, which begin at least FLAT_NS before it where there are any."""

    samples: Samples
    first: int  # row of the end of the stance before
    last: int  # row of the end of the next


class Buffer:
    """Takes the samples as they come and gives out those of each stride in turn."""

    def __init__(self) -> None:
        self._room: Samples = np.empty(0, SAMPLE)  # what was written is never written again, so it can be given out
        self._start, self._stop = 0, 0  # of what is kept
        self._row = 0  # of the end of the last stride that was taken
        self._count = 0
        self._before = NO_SAMPLES  # the last sample so far

    def add(self, judged: StanceBlock, nav: NavBlock) -> None:
        """Take the next samples; both blocks have the same stamps."""
        if not length(nav):
            return
        before = self._before if self._count else part(judged.imu, 0, 1)
        self._make_room(length(nav))
        fill(self._room[self._stop :], self._count, before, judged, nav)
        self._stop += length(nav)
        self._count += length(nav)
        self._before = ImuBlock._make(column[-1:].copy() for column in judged.imu)

    def holds(self, step: StepEvent) -> bool:
        """Return whether the samples of a step are all there."""
        if step.sample_numbers == NOT_NUMBERED:
            return self._count > 0 and step.stamp_ns <= self._before.stamp_ns[0]
        return step.sample_numbers[1] < self._count

    def take(self, step: StepEvent) -> Cycle:
        """Return the samples of a step; it begins where the one before ended, or later."""
        if step.sample_numbers == NOT_NUMBERED:
            first, last = (row_at(self._kept, stamp_ns) for stamp_ns in (step.start_ns, step.stamp_ns))
        else:
            first, last = (row_of(self._kept, number) for number in step.sample_numbers)
        self._row = last
        return Cycle(self._kept, min(first, last), last)

    def forget(self) -> None:
        """Let go of all before the stance in which the last stride ended, and of the middle of what lasts for ever."""
        if self._row:
            self._start += stood_from(self._kept, self._row)
            self._row = 0
        if self._stop - self._start > 2 * LIMIT:
            self._room = without_middle(self._kept)
            self._start, self._stop = 0, len(self._room)

    @property
    def _kept(self) -> Samples:
        return self._room[self._start : self._stop]

    def _make_room(self, count: int) -> None:
        if self._stop + count > len(self._room):
            kept = self._kept
            self._start, self._stop = 0, len(kept)
            self._room = np.empty(2 * len(kept) + count, SAMPLE)
            self._room[: len(kept)] = kept


@compiled
def fill(out: Samples, number: int, before: ImuBlock, judged: StanceBlock, nav: NavBlock) -> None:
    """Write what is needed of a block; its first sample has a number and follows the one in `before`."""
    stamp_ns, force_mps2 = before.stamp_ns[0], row(before.accel_mps2, 0)
    for i in range(len(nav.stamp_ns)):
        s, x, y, z, w = out[i], nav.quat_xyzw[i, 0], nav.quat_xyzw[i, 1], nav.quat_xyzw[i, 2], nav.quat_xyzw[i, 3]
        since_ns, now_mps2 = nav.stamp_ns[i] - stamp_ns, row(judged.imu.accel_mps2, i)
        s.number, s.stamp_ns = number + i, nav.stamp_ns[i]
        for j in range(3):
            s.position_m[j] = nav.position_m[i, j]
        s.quat_xyzw[0], s.quat_xyzw[1], s.quat_xyzw[2], s.quat_xyzw[3] = x, y, z, w
        s.up[0], s.up[1], s.up[2] = 2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)
        s.speed_mps, s.force_mps2 = norm(row(nav.velocity_mps, i)), norm(now_mps2)
        s.jolt_mps2 = norm(difference(now_mps2, force_mps2))
        s.statistic, s.standing = judged.statistic[i], judged.stance[i]
        s.seen = 0 <= since_ns <= GAP_NS and judged.imu.gyro_sd_radps[i] >= 0.0
        stamp_ns, force_mps2 = nav.stamp_ns[i], now_mps2


def without_middle(whole: Samples) -> Samples:
    """Return the first and the last samples; a gap in between is remembered."""
    kept = np.concatenate([whole[: LIMIT // 2], whole[-LIMIT // 2 :]])
    kept["seen"][LIMIT // 2] = whole["seen"][LIMIT // 2 : -LIMIT // 2 + 1].all()
    return kept


@compiled
def row_of(s: Samples, number: int) -> int:
    """Return the row of a sample; where the middle is missing, of one that comes after it."""
    at = number - s[0].number
    return max(0, at if at < len(s) and s[at].number == number else len(s) - 1 - (s[-1].number - number))


@compiled
def row_at(s: Samples, stamp_ns: int) -> int:
    """Return the first row at or after a stamp, or the last row."""
    for i in range(len(s)):
        if s[i].stamp_ns >= stamp_ns:
            return i
    return len(s) - 1


@compiled
def stood_from(s: Samples, end: int) -> int:
    """Return the first row of the stance that lasts until row `end`, within the last second of it."""
    begin = end
    for i in range(end - 1, -1, -1):
        if s[i].stamp_ns < s[end].stamp_ns - FLAT_NS or s[i].stamp_ns < s[begin].stamp_ns - BRIDGED_NS:
            break
        begin = i if s[i].standing else begin
    return begin

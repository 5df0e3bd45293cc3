"""What stride analysis needs of every sample, kept until its stride is complete, in bounded memory."""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.maths.compiled import compiled
from pdr_core.records import NO_SAMPLES, Flags, Floats, ImuBlock, NavBlock, Stamps, StanceBlock, joined, length, part

LIMIT = 20_000  # samples of a stride that are kept, half from each end: what is longer is a foot that stands
FLAT_NS = 1_000_000_000  # of a stance, before its end, in which the foot is looked for at its stillest
BRIDGED_NS = 200_000_000  # interruptions of a stance up to this belong to it: shorter than any swing


class Samples(NamedTuple):
    """n samples of one foot with their estimates."""

    number: Stamps  # (n,) as the filter counts them
    stamp_ns: Stamps  # (n,)
    position_m: Floats  # (n, 3)
    quat_xyzw: Floats  # (n, 4) world from foot
    up: Floats  # (n, 3) which way is up, in foot axes
    speed_mps: Floats  # (n,)
    force_mps2: Floats  # (n,) magnitude of the specific force
    jolt_mps2: Floats  # (n,) magnitude of its change since the sample before
    statistic: Floats  # (n,) of the detector
    standing: Flags  # (n,)
    seen: Flags  # (n,) neither a gap before this sample nor a gyro that is off


class Cycle(NamedTuple):
    """A stride's samples, with the last second of the stance before it."""

    samples: Samples
    first: int  # the end of that stance
    last: int  # the end of the next


class Buffer:
    """Takes the samples as they come and gives out those of each stride in turn."""

    def __init__(self) -> None:
        self._pieces: list[Samples] = []
        self._count = 0
        self._before = NO_SAMPLES  # the last sample so far

    def add(self, judged: StanceBlock, nav: NavBlock) -> None:
        """Take the next samples; both blocks have the same stamps."""
        if length(nav):
            before = self._before if self._count else part(judged.imu, 0, 1)
            self._pieces.append(_samples(judged, nav, self._count, before))
            self._count += length(nav)
            self._before = ImuBlock._make(column[-1:].copy() for column in judged.imu)

    def take(self, numbers: tuple[int, int]) -> Cycle:
        """Return the samples of a stride by the numbers of its ends, and let go of all before its last stance."""
        self._pieces = [joined(self._pieces)] if len(self._pieces) > 1 else self._pieces
        (whole,) = self._pieces
        first, last = (int(i) for i in np.searchsorted(whole.number, numbers))
        begin = stood_from(whole.stamp_ns, whole.standing, first)
        self._pieces = [part(whole, stood_from(whole.stamp_ns, whole.standing, last))]
        return Cycle(part(whole, begin, last + 1), first - begin, last - begin)

    def shorten(self) -> None:
        """Leave out the middle of a stride that lasts for ever; the gaps in there are remembered."""
        if sum(length(piece) for piece in self._pieces) <= 2 * LIMIT:
            return
        whole = joined(self._pieces)
        head, tail = part(whole, 0, LIMIT // 2), part(whole, -LIMIT // 2)
        tail.seen[0] = whole.seen[LIMIT // 2 : -LIMIT // 2 + 1].all()
        self._pieces = [joined([head, tail])]


def _samples(judged: StanceBlock, nav: NavBlock, first_number: int, before: ImuBlock) -> Samples:
    """Return what is needed of a block that follows one sample; its first sample has a number."""
    x, y, z, w = nav.quat_xyzw.T
    imu = judged.imu
    step_ns = np.diff(imu.stamp_ns, prepend=before.stamp_ns)
    return Samples(
        np.arange(first_number, first_number + length(nav)),
        imu.stamp_ns,
        nav.position_m,
        nav.quat_xyzw,
        np.column_stack([2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)]),
        _magnitude(nav.velocity_mps),
        _magnitude(imu.accel_mps2),
        _magnitude(np.diff(imu.accel_mps2, axis=0, prepend=before.accel_mps2)),
        judged.statistic,
        judged.stance,
        (step_ns >= 0) & (step_ns <= GAP_NS) & (imu.gyro_sd_radps >= 0.0),
    )


def _magnitude(vectors: Floats) -> Floats:
    return np.sqrt(np.einsum("ij,ij->i", vectors, vectors))


@compiled
def stood_from(stamp_ns: Stamps, standing: Flags, end: int) -> int:
    """Return the first row of the stance that lasts until row `end`, within the last second of it."""
    begin = end
    for i in range(end - 1, -1, -1):
        if stamp_ns[i] < stamp_ns[end] - FLAT_NS or stamp_ns[i] < stamp_ns[begin] - BRIDGED_NS:
            break
        begin = i if standing[i] else begin
    return begin

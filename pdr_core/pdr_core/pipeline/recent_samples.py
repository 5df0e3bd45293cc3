"""The samples of the last seconds, and where in them the filter can take over from dead reckoning.

The filter levels the foot by the accelerometer, which needs no gyro: so the stance in which the gyro comes on is good
enough, if the foot stood for the time of a levelling before. A stride is known only some time after its ground hit; the
filter then takes the samples since that levelling at once. A runner's foot never stands so long: there it goes on from
the instant in which the foot is flat, and takes its tilt for that in which it stood last.
"""

import numpy as np

from pdr_core.conventions import nanoseconds
from pdr_core.gait.stands import Stand
from pdr_core.records import NO_VERDICTS, Flags, NavBlock, Stamps, StanceBlock, joined, length, part, picked

KEPT_NS = nanoseconds(6.0)
HIT_NS = nanoseconds(0.4)  # a stand begins so near to the ground hit before it
ROOM_NS = nanoseconds(0.08)  # the foot stands on so long after it was levelled: the filter needs zero velocities first
SEEN_NS = nanoseconds(1.3)  # so long after it began, a stride that ended in it would be known


class RecentSamples:
    """Samples as the filter wants them, and whether the foot is still, as the accelerometer alone tells it."""

    def __init__(self, level_s: float) -> None:
        self._level_ns = nanoseconds(level_s)
        self._samples: StanceBlock = NO_VERDICTS
        self._still: Flags = np.zeros(0, np.bool_)
        self._first, self._first_still = 0, 0  # their numbers, counted from the start of the walk

    def add(self, judged: StanceBlock, still: Flags) -> None:
        """Take the next samples, and the next verdicts: of the same samples, but maybe not at the same time."""
        samples, flags = joined([self._samples, judged]), np.concatenate([self._still, still])
        old = outdated(samples.imu.stamp_ns)
        self._samples, self._first = part(samples, old), self._first + old
        passed = min(max(0, self._first - self._first_still), len(flags))
        self._still, self._first_still = flags[passed:], self._first_still + passed

    def at(self, nav: NavBlock) -> tuple[StanceBlock, NavBlock]:
        """Return the samples that hold at the stamps of estimates, under these, and the estimates that have one."""
        rows = np.searchsorted(self._samples.imu.stamp_ns, nav.stamp_ns, side="right") - 1
        nav, rows = part(nav, int((rows < 0).sum())), rows[rows >= 0]
        held = picked(self._samples, rows)
        return held._replace(imu=held.imu._replace(stamp_ns=nav.stamp_ns)), nav

    def levelling(self, hit_ns: int) -> StanceBlock | None:
        """Return the samples with which the filter can go on where the foot has stood since a hit; None: not yet."""
        both = min(len(self._still), length(self._samples)) if self._first == self._first_still else 0
        stamp_ns = self._samples.imu.stamp_ns[:both]
        on = gyro_on_since(self._samples)
        for first, last in stands(self._still[:both]):
            ready = max(on, int(np.searchsorted(stamp_ns, stamp_ns[first] + self._level_ns)))
            enough = ready < last and stamp_ns[last - 1] - stamp_ns[ready] >= ROOM_NS
            if enough and self._follows(int(stamp_ns[first]), hit_ns):
                start = int(np.searchsorted(stamp_ns, stamp_ns[ready] - self._level_ns, side="right"))
                return part(self._samples, start)
        return None

    def from_instant(self, stand: Stand) -> StanceBlock | None:
        """Return the samples from the instant in which a runner's foot stood; None: the gyro was not on then.

        The first one shows the force of the standing foot, which tells its tilt; its own is that of a foot that lands.
        """
        first = int(np.searchsorted(self._samples.imu.stamp_ns, stand.stamp_ns))
        if not gyro_on_since(self._samples) <= first < length(self._samples):
            return None
        samples = part(self._samples, first)
        accel_mps2 = samples.imu.accel_mps2.copy()
        accel_mps2[0] = stand.force_mps2
        return samples._replace(imu=samples.imu._replace(accel_mps2=accel_mps2))

    def _follows(self, stood_ns: int, hit_ns: int) -> bool:
        """Return whether the pose at a ground hit is that of a stand: no other can lie between."""
        newest_ns = int(self._samples.imu.stamp_ns[-1])
        return abs(stood_ns - hit_ns) <= HIT_NS or hit_ns <= stood_ns <= newest_ns - SEEN_NS


def outdated(stamp_ns: Stamps) -> int:
    """Return how many of the first samples are old, or of a clock that has jumped back since."""
    jumps = np.flatnonzero(np.diff(stamp_ns) < 0)
    now = int(jumps[-1]) + 1 if len(jumps) else 0
    return now + int(np.searchsorted(stamp_ns[now:], stamp_ns[-1] - KEPT_NS)) if len(stamp_ns) else 0


def gyro_on_since(samples: StanceBlock) -> int:
    """Return the row from which on all samples have a rate; their number: none."""
    off = np.flatnonzero(samples.imu.gyro_sd_radps < 0.0)
    return int(off[-1]) + 1 if len(off) else 0


def stands(still: Flags) -> list[tuple[int, int]]:
    """Return the rows, first and one after the last, of each run of still samples, the newest first."""
    edges = np.flatnonzero(np.diff(still.astype(np.int8), prepend=0, append=0)).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))[::-1]

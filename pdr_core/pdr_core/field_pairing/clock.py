"""The clock of one stream: which of its stamps are new, where it jumps back, and how long it usually takes to tick."""

from collections.abc import Iterator

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.records import Flags, Stamps

LATEST_NS = 2**62 - 1  # in the year 2116; so no difference of two stamps overflows
ZERO = np.zeros(1, np.int64)
USUAL = 64  # intervals; what is usual is the mean of so many


def steps_ns(stamp_ns: Stamps, before_ns: int | None) -> Stamps:
    """Return how far each stamp, (n,), is after the one before it; 0 for the first if there is none before."""
    steps = np.empty(len(stamp_ns), np.int64)
    steps[0] = 0 if before_ns is None else stamp_ns[0] - before_ns
    steps[1:] = stamp_ns[1:] - stamp_ns[:-1]
    return steps


def within_reckoning(stamp_ns: Stamps) -> Stamps:
    """Return stamps, (n,), of which no difference overflows."""
    return np.minimum(np.maximum(stamp_ns, -LATEST_NS), LATEST_NS)


class Clock:
    """Follows the stamps of one stream, in the order in which it brings them."""

    def __init__(self, jump_ns: int) -> None:
        self._jump_ns = jump_ns
        self.last_ns: int | None = None
        self.newest_ns: int | None = None  # since the last jump

    def runs(self, stamp_ns: Stamps) -> Iterator[tuple[int, int, bool]]:
        """Yield start and stop of the stretches of stamps, (n,), and whether the clock jumps back at their start.

        Each must be marked before the next one is asked for.
        """
        if not len(stamp_ns):
            return
        back = steps_ns(stamp_ns, self.last_ns) < -self._jump_ns
        starts = [0, *(back[1:].nonzero()[0] + 1).tolist()]
        for start, stop in zip(starts, [*starts[1:], len(stamp_ns)], strict=True):
            jumped = bool(back[start])
            self.newest_ns = None if jumped else self.newest_ns
            yield start, stop, jumped

    def mark(self, stamp_ns: Stamps) -> tuple[Flags, Stamps]:
        """Take a stretch of n stamps without a jump; return which are later than all before, and the latest so far."""
        floor_ns = -LATEST_NS - 1 if self.newest_ns is None else self.newest_ns
        newest_ns = np.maximum.accumulate(np.concatenate([[floor_ns], stamp_ns]))
        self.last_ns, self.newest_ns = int(stamp_ns[-1]), int(newest_ns[-1])
        return stamp_ns > newest_ns[:-1], newest_ns[1:]


class UsualInterval:
    """Learns the usual interval of a stream: the mean of its last ones that are no gap."""

    def __init__(self) -> None:
        self._before_ns: int | None = None
        self._recent_ns: Stamps = np.zeros(0, np.int64)

    def begin_anew(self) -> None:
        """Note that the clock has jumped: the step across it is no interval."""
        self._before_ns = None

    def learn(self, stamp_ns: Stamps) -> Stamps:
        """Take n ascending stamps; return what was usual at each of them, (n,) [ns], 0 as long as that is unknown."""
        if not len(stamp_ns):
            return stamp_ns
        apart_ns = steps_ns(stamp_ns, self._before_ns)
        self._before_ns = int(stamp_ns[-1])
        counts = (apart_ns > 0) & (apart_ns <= GAP_NS)
        known_ns: Stamps = np.concatenate([self._recent_ns, apart_ns[counts]])
        last = len(self._recent_ns) + np.cumsum(counts)
        first = np.maximum(last - USUAL, 0)
        sums_ns = np.concatenate([ZERO, known_ns.cumsum()])
        self._recent_ns = known_ns[-USUAL:]
        return (sums_ns[last] - sums_ns[first]) // np.maximum(last - first, 1)

"""Which samples lie in a window around each sample of a stream: the one window walk of all stance detectors."""

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.maths.compiled import compiled
from pdr_core.records import Stamps


@compiled
def centred_windows(stamp_ns: Stamps, start: int, stop: int, half_window_ns: int) -> tuple[Stamps, Stamps]:
    """Return for the samples start:stop where their windows begin and end, each (stop - start,).

    The window of a sample is first:last, all samples whose stamps differ from its own by at most `half_window_ns`, and
    always those beside it, unless a gap is between: one sample alone shows no change, and no direction of gravity.
    """
    n = max(0, stop - start)
    firsts, lasts = np.empty(n, np.int64), np.empty(n, np.int64)
    first, last = 0, start
    for i in range(start, stop):
        while stamp_ns[i] - stamp_ns[first] > half_window_ns:
            first += 1
        while last < stamp_ns.shape[0] and stamp_ns[last] - stamp_ns[i] <= half_window_ns:
            last += 1
        firsts[i - start], lasts[i - start] = with_neighbours(stamp_ns, stamp_ns.shape[0], i, first, last)
    return firsts, lasts


@compiled
def with_neighbours(stamp_ns: Stamps, size: int, i: int, first: int, last: int) -> tuple[int, int]:
    """Return the window first:last of sample i, one of so many, and those beside it."""
    first = min(first, i - 1) if i > 0 and beside(stamp_ns, i - 1) else first
    last = max(last, i + 2) if i + 1 < size and beside(stamp_ns, i) else last
    return first, last


@compiled
def beside(stamp_ns: Stamps, i: int) -> bool:
    """Return whether no gap is between sample i and the next."""
    return stamp_ns[i + 1] - stamp_ns[i] <= GAP_NS

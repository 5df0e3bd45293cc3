"""Which samples lie in a window around each sample of a stream: the one window walk of all stance detectors."""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.records import Stamps


@compiled
def centred_windows(stamp_ns: Stamps, start: int, stop: int, half_window_ns: int) -> tuple[Stamps, Stamps]:
    """Return for the samples start:stop where their windows begin and end, each (stop - start,).

    The window of a sample is first:last, all samples whose stamps differ from its own by at most `half_window_ns`.
    """
    n = max(0, stop - start)
    firsts, lasts = np.empty(n, np.int64), np.empty(n, np.int64)
    first, last = 0, start
    for i in range(start, stop):
        while stamp_ns[i] - stamp_ns[first] > half_window_ns:
            first += 1
        while last < stamp_ns.shape[0] and stamp_ns[last] - stamp_ns[i] <= half_window_ns:
            last += 1
        firsts[i - start], lasts[i - start] = first, last
    return firsts, lasts

"""The stillest moment of a stance."""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import difference, dot, row
from pdr_core.records import Floats, Stamps


@compiled
def stillest_rows(stamp_ns: Stamps, force_mps2: Floats, first: int, last: int, window_ns: int) -> tuple[int, int]:
    """Return where the window within the rows first:last begins and ends in which the specific force changes least."""
    n = last - first
    sums, squares = np.zeros((n + 1, 3)), np.zeros(n + 1)
    for k in range(n):
        off = difference(row(force_mps2, first + k), row(force_mps2, first))
        for axis in range(3):
            sums[k + 1, axis] = sums[k, axis] + off[axis]
        squares[k + 1] = squares[k] + dot(off, off)
    best, best_stop, least, stop = 0, n, np.inf, 0
    for k in range(n):
        if stamp_ns[first + k] + window_ns > stamp_ns[last - 1]:
            break
        while stop < n and (stop <= k or stamp_ns[first + stop] < stamp_ns[first + k] + window_ns):
            stop += 1
        n_window, total = stop - k, difference(row(sums, stop), row(sums, k))
        mean = total[0] / n_window, total[1] / n_window, total[2] / n_window
        variance = (squares[stop] - squares[k]) / n_window - dot(mean, mean)
        if variance < least:
            best, best_stop, least = k, stop, variance
    return first + best, first + best_stop

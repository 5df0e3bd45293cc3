"""The acceleration moving variance detector: what a standing foot feels does not change."""

import numpy as np

from pdr_core.maths.centred_window import centred_windows
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import added, difference, dot, row, scaled
from pdr_core.records import Floats, ImuBlock


@compiled
def statistics(imu: ImuBlock, start: int, stop: int, half_window_ns: int) -> Floats:
    """Return the variance of the specific force [m^2/s^4], all axes together, around the samples start:stop.

    Skog et al. 2010 (Zero-velocity detection - an algorithm evaluation), MV, without the accelerometer's variance,
    which only scales the threshold. Infinity where the window has one sample: it tells nothing of a change.
    """
    firsts, lasts = centred_windows(imu.stamp_ns, start, stop, half_window_ns)
    out = np.empty(firsts.shape[0])
    for i in range(firsts.shape[0]):
        out[i] = variance(imu.accel_mps2, firsts[i], lasts[i])
    return out


@compiled
def variance(force_mps2: Floats, first: int, last: int) -> float:
    """Return the mean square distance [m^2/s^4] of the rows first:last from their mean; infinity for one row."""
    if last - first < 2:
        return np.inf
    share = 1.0 / (last - first)
    mean = (0.0, 0.0, 0.0)
    for k in range(first, last):
        mean = added(mean, scaled(share, row(force_mps2, k)))
    total = 0.0
    for k in range(first, last):
        off = difference(row(force_mps2, k), mean)
        total += dot(off, off)
    return total * share

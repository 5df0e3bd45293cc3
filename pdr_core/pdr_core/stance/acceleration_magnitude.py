"""The acceleration magnitude detector: a standing foot feels gravity and nothing else."""

import numpy as np

from pdr_core.maths.centred_window import centred_windows
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import norm, row
from pdr_core.records import Floats, ImuBlock


@compiled
def statistics(imu: ImuBlock, start: int, stop: int, half_window_ns: int, gravity_mps2: float) -> Floats:
    """Return the mean square of |a| - g [m^2/s^4] around the samples start:stop.

    Skog et al. 2010 (Zero-velocity detection - an algorithm evaluation), MAG, without the accelerometer's variance,
    which only scales the threshold.
    """
    firsts, lasts = centred_windows(imu.stamp_ns, start, stop, half_window_ns)
    out = np.empty(firsts.shape[0])
    for i in range(firsts.shape[0]):
        out[i] = magnitude_energy(imu.accel_mps2, firsts[i], lasts[i], gravity_mps2)
    return out


@compiled
def magnitude_energy(force_mps2: Floats, first: int, last: int, gravity_mps2: float) -> float:
    """Return the mean of (|a| - g)^2 [m^2/s^4] over the rows first:last."""
    total = 0.0
    for k in range(first, last):
        total += (norm(row(force_mps2, k)) - gravity_mps2) ** 2
    return total / (last - first)

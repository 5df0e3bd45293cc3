"""The angular rate energy detector: a standing foot does not turn."""

import numpy as np

from pdr_core.maths.centred_window import centred_windows
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import dot, row
from pdr_core.records import Floats, ImuBlock


@compiled
def statistics(imu: ImuBlock, start: int, stop: int, half_window_ns: int) -> Floats:
    """Return the mean square rate [rad^2/s^2] around the samples start:stop; infinity where the gyro is off.

    Skog et al. 2010 (Zero-velocity detection - an algorithm evaluation), ARE; Qiu eq. 21. Both divide by the gyro's
    variance, which only scales the threshold.
    """
    firsts, lasts = centred_windows(imu.stamp_ns, start, stop, half_window_ns)
    out = np.empty(firsts.shape[0])
    for i in range(firsts.shape[0]):
        out[i] = rate_energy(imu, firsts[i], lasts[i])
    return out


@compiled
def rate_energy(imu: ImuBlock, first: int, last: int) -> float:
    """Return the mean square rate [rad^2/s^2] of the samples first:last; infinity where the gyro is off."""
    total = 0.0
    for k in range(first, last):
        if imu.gyro_sd_radps[k] < 0.0:
            return np.inf
        rate = row(imu.gyro_radps, k)
        total += dot(rate, rate)
    return total / (last - first)

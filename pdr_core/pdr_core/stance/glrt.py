"""The generalised likelihood ratio test for a standing foot (GLRT, known as SHOE)."""

import numpy as np

from pdr_core.maths.centred_window import centred_windows
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import added, difference, norm, row, scaled
from pdr_core.records import Floats, ImuBlock


@compiled
def statistics(
    imu: ImuBlock,
    start: int,
    stop: int,
    half_window_ns: int,
    gravity_mps2: float,
    accel_sd_mps2: float,
    gyro_sd_radps: float,
) -> Floats:
    """Return T_n of Gui eq. 8 for the samples start:stop, without unit; infinity where the gyro is off.

    The window is centred on the sample: all samples whose stamps differ by at most `half_window_ns`. Gui prints a
    window that begins at the sample; centring it puts the verdict where it belongs. Standing still makes T small.
    """
    firsts, lasts = centred_windows(imu.stamp_ns, start, stop, half_window_ns)
    out = np.empty(firsts.shape[0])
    for i in range(firsts.shape[0]):
        out[i] = window_statistic(imu, firsts[i], lasts[i], gravity_mps2, accel_sd_mps2, gyro_sd_radps)
    return out


@compiled
def window_statistic(
    imu: ImuBlock, first: int, last: int, gravity_mps2: float, accel_sd_mps2: float, gyro_sd_radps: float
) -> float:
    """Return T over the samples first:last: how far they are from gravity along the mean direction, and from rest."""
    mean = (0.0, 0.0, 0.0)
    for k in range(first, last):
        mean = added(mean, row(imu.accel_mps2, k))
        if imu.gyro_sd_radps[k] < 0.0:
            return np.inf
    length = norm(mean)
    expected = scaled(gravity_mps2 / length, mean) if length > 0.0 else mean
    total = 0.0
    for k in range(first, last):
        total += (norm(difference(row(imu.accel_mps2, k), expected)) / accel_sd_mps2) ** 2
        total += (norm(row(imu.gyro_radps, k)) / gyro_sd_radps) ** 2
    return total / (last - first)

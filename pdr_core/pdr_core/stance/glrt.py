"""The generalised likelihood ratio test for a standing foot (GLRT, known as SHOE)."""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import norm
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
    out = np.empty(max(0, stop - start))
    first, last = 0, start
    for i in range(start, stop):
        while imu.stamp_ns[i] - imu.stamp_ns[first] > half_window_ns:
            first += 1
        while last < imu.stamp_ns.shape[0] and imu.stamp_ns[last] - imu.stamp_ns[i] <= half_window_ns:
            last += 1
        out[i - start] = window_statistic(imu, first, last, gravity_mps2, accel_sd_mps2, gyro_sd_radps)
    return out


@compiled
def window_statistic(
    imu: ImuBlock, first: int, last: int, gravity_mps2: float, accel_sd_mps2: float, gyro_sd_radps: float
) -> float:
    """Return T over the samples first:last: how far they are from gravity along the mean direction, and from rest."""
    mean = np.zeros(3)
    for k in range(first, last):
        mean += imu.accel_mps2[k]
        if imu.gyro_sd_radps[k] < 0.0:
            return np.inf
    length = norm(mean)
    expected = mean * (gravity_mps2 / length) if length > 0.0 else mean
    total = 0.0
    for k in range(first, last):
        total += (norm(imu.accel_mps2[k] - expected) / accel_sd_mps2) ** 2
        total += (norm(imu.gyro_radps[k]) / gyro_sd_radps) ** 2
    return total / (last - first)

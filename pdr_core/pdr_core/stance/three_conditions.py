"""Qiu's three conditions: a standing foot feels g, feels it steadily, and does not turn.

Qiu eq. 22 asks A < lambda_1, M < lambda_2 and E < lambda_3. Its A (eq. 19) is |a| / g, so as printed the first
condition also holds in free fall, where A is 0. A standing foot has A = 1, hence the two-sided |A - 1| here. The
variance M (eq. 20) is that of |a|, S in the paper's notation; its window, like that of the rate energy E (eq. 21),
is centred on the sample, and sigma_omega only scales the third threshold.

All three hold where the largest of the ratios |A - 1| / lambda_1, M / lambda_2, E / lambda_3 is at most one.
"""

import numpy as np

from pdr_core.maths.centred_window import centred_windows
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import norm, row
from pdr_core.records import Floats, ImuBlock
from pdr_core.stance.angular_rate_energy import rate_energy


@compiled
def statistics(
    imu: ImuBlock,
    start: int,
    stop: int,
    half_window_ns: int,
    gravity_mps2: float,
    force_limit: float,
    variance_limit: float,
    rate_limit: float,
) -> Floats:
    """Return the largest of the three ratios, without unit, for the samples start:stop.

    Infinity where the gyro is off, and for a lonely sample.
    `force_limit` is a share of g, `variance_limit` in m^2/s^4, `rate_limit` in rad^2/s^2.
    """
    firsts, lasts = centred_windows(imu.stamp_ns, start, stop, half_window_ns)
    out = np.empty(firsts.shape[0])
    for i in range(firsts.shape[0]):
        force = abs(norm(row(imu.accel_mps2, start + i)) / gravity_mps2 - 1.0) / force_limit
        steadiness = magnitude_variance(imu.accel_mps2, firsts[i], lasts[i]) / variance_limit
        out[i] = max(force, steadiness, rate_energy(imu, firsts[i], lasts[i]) / rate_limit)
    return out


@compiled
def magnitude_variance(force_mps2: Floats, first: int, last: int) -> float:
    """Return the variance of |a| [m^2/s^4] over the rows first:last; infinity of one row, which shows no change."""
    if last - first < 2:
        return np.inf
    mean = 0.0
    for k in range(first, last):
        mean += norm(row(force_mps2, k)) / (last - first)
    total = 0.0
    for k in range(first, last):
        total += (norm(row(force_mps2, k)) - mean) ** 2
    return total / (last - first)

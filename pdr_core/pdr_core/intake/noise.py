"""How noisy each sample is: by density and interval, and more where the sensor is at the end of its range."""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import within
from pdr_core.params import IntakeParams
from pdr_core.records import Flags, Floats, ImuBlock


class Channel(NamedTuple):
    """Gyro or accelerometer, in SI units."""

    density: float
    full_scale: float
    saturated_sd: float  # what a saturated sample may be off by


def channels(p: IntakeParams) -> tuple[Channel, Channel]:
    """Return gyro and accelerometer as the parameters describe them."""
    return (
        Channel(p.gyro_noise_density, p.gyro_range_radps, p.saturated_gyro_sd_radps),
        Channel(p.accel_noise_density, p.accel_range_mps2, p.saturated_accel_sd_mps2),
    )


@compiled
def sample_noise(block: ImuBlock, before_ns: int, gyro: Channel, accel: Channel) -> tuple[Floats, Floats, Flags, Flags]:
    """Return the deviations of rate and force, -1 where there is none, and whether each is saturated, (n,) each."""
    n = block.stamp_ns.shape[0]
    gyro_sd, accel_sd = np.empty(n), np.empty(n)
    gyro_full, accel_full = np.empty(n, np.bool_), np.empty(n, np.bool_)
    for i in range(n):
        interval_s = interval(block.stamp_ns[i], before_ns)
        gyro_sd[i], gyro_full[i] = deviation(block.gyro_radps[i], interval_s, gyro)
        accel_sd[i], accel_full[i] = deviation(block.accel_mps2[i], interval_s, accel)
        if block.gyro_sd_radps[i] < 0.0:
            gyro_sd[i] = -1.0
        before_ns = block.stamp_ns[i]
    return gyro_sd, accel_sd, gyro_full, accel_full


@compiled
def interval(stamp_ns: int, before_ns: int) -> float:
    """Return the time [s] since the sample before, bounded by a gap's length, which the first one gets too."""
    if before_ns == NO_STAMP or stamp_ns <= before_ns:
        return GAP_NS / NANOSECONDS
    return min(stamp_ns - before_ns, GAP_NS) / NANOSECONDS


@compiled
def deviation(values: Floats, interval_s: float, channel: Channel) -> tuple[float, bool]:
    """Return the noise of one sample (3,), and whether an axis of it is within 0.5 % of the sensor's range."""
    saturated = not within(values, 0.995 * channel.full_scale)
    more = channel.saturated_sd if saturated else 0.0
    return np.hypot(channel.density / np.sqrt(interval_s), more), saturated

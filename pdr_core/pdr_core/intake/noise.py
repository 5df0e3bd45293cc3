"""How noisy each sample is: by density and interval, by how fast the foot moves, and at the end of the sensor's range.

Between two samples nobody knows the motion. The filter takes it to change evenly; if it jumps instead, at a random
moment, the mean over the interval is off by change / sqrt(12) = 0.29 of the change from sample to sample. A foot does
neither: on real walks the error is about 0.1 of the change. This, not the white noise, is what a swing and a heel
strike suffer from, and the more so the lower the rate. So the noise of a sample has the deviation

    hypot(density / sqrt(interval), share * | change since the sample before |)

and where the sensor saturates a density of its own is added. No change hides more than the sensor's range.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Triple, Vector, difference, norm, row, within
from pdr_core.params import IntakeParams
from pdr_core.records import Flags, Floats, ImuBlock


class Channel(NamedTuple):
    """Gyro or accelerometer, in SI units."""

    density: float
    change_share: float
    saturated_density: float
    full_scale: float


def channels(p: IntakeParams) -> tuple[Channel, Channel]:
    """Return gyro and accelerometer as the parameters describe them."""
    return (
        Channel(p.gyro_noise_density, p.change_noise, p.saturated_gyro_noise_density, p.gyro_range_radps),
        Channel(p.accel_noise_density, p.change_noise, p.saturated_accel_noise_density, p.accel_range_mps2),
    )


@compiled
def sample_noise(
    block: ImuBlock, clipped: Flags, before: ImuBlock, gyro: Channel, accel: Channel
) -> tuple[Floats, Floats, Flags, Flags]:
    """Return the deviations of rate and force, -1 where there is none, and whether each is saturated, (n,) each.

    `clipped`, (n,), are rates known to be saturated, though a repair may have taken them beyond the range. `before` is
    the sample before the block, if there was one. The first sample, and one after a gap, have no change.
    """
    n = block.stamp_ns.shape[0]
    gyro_sd, accel_sd = np.empty(n), np.empty(n)
    gyro_full, accel_full = np.empty(n, np.bool_), np.empty(n, np.bool_)
    for i in range(n):
        last, k = (block, i - 1) if i > 0 else (before, before.stamp_ns.shape[0] - 1)
        step_ns = block.stamp_ns[i] - last.stamp_ns[k] if k >= 0 else GAP_NS
        rate, force = row(block.gyro_radps, i), row(block.accel_mps2, i)
        turned, pushed = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        if 0 < step_ns < GAP_NS:
            turned = difference(rate, row(last.gyro_radps, k))
            pushed = difference(force, row(last.accel_mps2, k))
        interval_s = (step_ns if 0 < step_ns < GAP_NS else GAP_NS) / NANOSECONDS
        gyro_full[i] = clipped[i] or saturated(rate, gyro)
        accel_full[i] = saturated(force, accel)
        gyro_sd[i] = deviation(turned, gyro_full[i], interval_s, gyro) if block.gyro_sd_radps[i] >= 0.0 else -1.0
        accel_sd[i] = deviation(pushed, accel_full[i], interval_s, accel)
    return gyro_sd, accel_sd, gyro_full, accel_full


@compiled
def saturated(values: Vector, channel: Channel) -> bool:
    """Return whether an axis of a sample (3,) is within 0.5 % of the sensor's range."""
    return not within(values, 0.995 * channel.full_scale)


@compiled
def deviation(change: Triple, full: bool, interval_s: float, channel: Channel) -> float:
    """Return the noise of a sample that has changed so much, (3,), in an interval."""
    density = np.hypot(channel.density, channel.saturated_density if full else 0.0)
    hidden = min(channel.change_share * norm(change), channel.full_scale)
    return np.hypot(density / np.sqrt(interval_s), hidden)

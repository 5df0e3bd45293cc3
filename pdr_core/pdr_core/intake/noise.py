"""How noisy each sample is: by density and interval, and more the harder the foot moves.

In a swing and at a heel strike it is not the white noise that counts but what grows with the motion: scale, alignment
of the axes, bandwidth, samples that meet a peak or miss it. So the densities are

    accelerometer: hypot(noise, share * | |a| - g |)        gyro: hypot(noise, share * |w|)

and where the sensor saturates a figure of its own is added. The noise of one sample is the density / sqrt(interval).
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, NO_STAMP, STANDARD_GRAVITY_MPS2
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import norm, within
from pdr_core.params import IntakeParams
from pdr_core.records import Flags, Floats, ImuBlock


class Channel(NamedTuple):
    """Gyro or accelerometer, in SI units."""

    density: float
    motion_share: float  # of what it shows beyond `rest`, in the density
    saturated_density: float
    full_scale: float
    rest: float  # the magnitude it shows at rest


def channels(p: IntakeParams) -> tuple[Channel, Channel]:
    """Return gyro and accelerometer as the parameters describe them."""
    return (
        Channel(
            p.gyro_noise_density, p.gyro_motion_noise, p.saturated_gyro_noise_density, p.gyro_range_radps, rest=0.0
        ),
        Channel(
            p.accel_noise_density,
            p.accel_motion_noise,
            p.saturated_accel_noise_density,
            p.accel_range_mps2,
            rest=STANDARD_GRAVITY_MPS2,
        ),
    )


@compiled
def sample_noise(
    block: ImuBlock, clipped: Flags, before_ns: int, gyro: Channel, accel: Channel
) -> tuple[Floats, Floats, Flags, Flags]:
    """Return the deviations of rate and force, -1 where there is none, and whether each is saturated, (n,) each.

    `clipped`, (n,), are rates known to be saturated, though a repair may have taken them beyond the range.
    """
    n = block.stamp_ns.shape[0]
    gyro_sd, accel_sd = np.empty(n), np.empty(n)
    gyro_full, accel_full = np.empty(n, np.bool_), np.empty(n, np.bool_)
    for i in range(n):
        interval_s = interval(block.stamp_ns[i], before_ns)
        gyro_full[i] = clipped[i] or saturated(block.gyro_radps[i], gyro)
        accel_full[i] = saturated(block.accel_mps2[i], accel)
        gyro_sd[i] = density(block.gyro_radps[i], gyro_full[i], gyro) / np.sqrt(interval_s)
        accel_sd[i] = density(block.accel_mps2[i], accel_full[i], accel) / np.sqrt(interval_s)
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
def saturated(values: Floats, channel: Channel) -> bool:
    """Return whether an axis of a sample (3,) is within 0.5 % of the sensor's range."""
    return not within(values, 0.995 * channel.full_scale)


@compiled
def density(values: Floats, full: bool, channel: Channel) -> float:
    """Return the noise density at a sample (3,)."""
    moving = channel.motion_share * abs(norm(values) - channel.rest)
    return np.hypot(np.hypot(channel.density, moving), channel.saturated_density if full else 0.0)

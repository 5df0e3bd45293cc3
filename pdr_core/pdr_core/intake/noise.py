"""What the filter should expect a sample to be off by: white noise, and more the harder the foot moves.

In a swing and at a heel strike it is not the white noise that counts but what grows with the motion: scale, alignment
of the axes, bandwidth, samples that meet a peak or miss it. So the densities are

    accelerometer: hypot(noise, share * | |a| - g |)        gyro: hypot(noise, share * |w|)

and where the sensor saturates a figure of its own is added. The noise of one sample is the density / sqrt(interval).
"""

import numpy as np

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import norm
from pdr_core.params import IntakeParams
from pdr_core.records import Flags, Floats, ImuBlock


def sample_noise(
    block: ImuBlock, interval_s: Floats, gyro_full: Flags, accel_full: Flags, p: IntakeParams
) -> tuple[Floats, Floats]:
    """Return the standard deviations [rad/s], [m/s^2] of the samples, (n,) each; `full`: the sensor saturates."""
    unsteady_mps2 = np.abs(lengths(block.accel_mps2) - STANDARD_GRAVITY_MPS2)
    gyro = np.hypot(p.gyro_noise_density, p.gyro_motion_noise * lengths(block.gyro_radps))
    accel = np.hypot(p.accel_noise_density, p.accel_motion_noise * unsteady_mps2)
    gyro = np.hypot(gyro, gyro_full * p.saturated_gyro_noise_density)
    accel = np.hypot(accel, accel_full * p.saturated_accel_noise_density)
    return gyro / np.sqrt(interval_s), accel / np.sqrt(interval_s)


@compiled
def lengths(vectors: Floats) -> Floats:
    """Return the length of every row of (n, 3); row by row, so that one sample gives the same bits as many."""
    out = np.empty(vectors.shape[0])
    for i in range(vectors.shape[0]):
        out[i] = norm(vectors[i])
    return out

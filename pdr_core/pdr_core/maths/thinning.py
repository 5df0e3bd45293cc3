"""Lowers the rate of samples as a sensor does it: what the lower rate cannot show is filtered out before.

To keep every k-th sample and drop the rest folds each vibration above half the new rate down into the motion
(aliasing): the shock of a heel then looks like a push. So each kept sample becomes the weighted mean of those around
it, a low-pass filter: a sinc in a Hamming window (Oppenheim and Schafer, Discrete-time signal processing, section 7.5).
Its weights are symmetric. So it delays nothing, and the value belongs to the stamp that the kept sample has.

Near an end of the recording, a gap, a value that is no number, or a gyro or accelerometer that goes on or off, the
filter shrinks on both sides alike, until it ends there. So it never mixes what does not belong together, and what was
not measured stays so.

The magnetic field is filtered likewise where all of these samples have one. Where some have none, as with a slower
magnetometer, a kept sample takes the mean of the fields that are nearer to it than to any other that is kept.
"""

from functools import cache

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import row, within
from pdr_core.records import Floats, ImuBlock

SHARE = 0.9  # of half the new rate is the frequency that the filter halves
REACH = 4  # intervals of the new rate to either side
LONGEST = 4096  # samples to either side, whatever the rate


@cache
def weights(keep_every: int) -> Floats:
    """Return the filter for one sample in `keep_every`, (2 n + 1,); the sum is 1."""
    reach = reached(keep_every)
    away = np.arange(-reach, reach + 1) / keep_every
    shape = np.sinc(SHARE * away) * np.hamming(2 * reach + 1)
    return shape / shape.sum()


def reached(keep_every: int) -> int:
    """Return how many samples to either side count for one that is kept."""
    return min(REACH * keep_every, LONGEST) if keep_every > 1 else 0


def thinned(samples: ImuBlock, start: int, stop: int, keep_every: int) -> ImuBlock:
    """Return the samples start:stop:keep_every, filtered by those around them, also before start and from stop on."""
    kept = ImuBlock._make(column[start:stop:keep_every].copy() for column in samples)
    if keep_every > 1:
        smooth(samples, start, keep_every, weights(keep_every), kept)
    return kept


@compiled
def smooth(samples: ImuBlock, start: int, keep_every: int, shape: Floats, kept: ImuBlock) -> None:
    """Replace the values of `kept`, which are those of the samples start, start + keep_every, ..."""
    for n in range(kept.stamp_ns.shape[0]):
        i = start + n * keep_every
        reach = reach_of(samples, i, shape.shape[0] // 2)
        middle = shape.shape[0] // 2
        total = shape[middle - reach : middle + reach + 1].sum()
        kept.gyro_radps[n], kept.accel_mps2[n] = 0.0, 0.0
        gyro_variance, accel_variance = 0.0, 0.0
        for k in range(-reach, reach + 1):
            share = shape[middle + k] / total
            kept.gyro_radps[n] += share * samples.gyro_radps[i + k]
            kept.accel_mps2[n] += share * samples.accel_mps2[i + k]
            gyro_variance += (share * samples.gyro_sd_radps[i + k]) ** 2
            accel_variance += (share * samples.accel_sd_mps2[i + k]) ** 2
        if kept.gyro_sd_radps[n] >= 0.0:
            kept.gyro_sd_radps[n] = np.sqrt(gyro_variance)
        if kept.accel_sd_mps2[n] >= 0.0:
            kept.accel_sd_mps2[n] = np.sqrt(accel_variance)
        kept.field_sd_tesla[n] = field_of(samples, i, reach, keep_every, shape, kept.field_tesla[n])


@compiled
def field_of(samples: ImuBlock, i: int, reach: int, keep_every: int, shape: Floats, field_tesla: Floats) -> float:
    """Put the field of a sample that is kept, (3,), in its place and return its deviation; -1: there is none."""
    first, last, middle = -reach, reach, shape.shape[0] // 2
    everywhere = np.all(samples.field_sd_tesla[i - reach : i + reach + 1] >= 0.0)
    if not everywhere:
        first, last = max(first, -(keep_every // 2)), min(last, (keep_every - 1) // 2)
    field_tesla[:] = 0.0
    total, variance = 0.0, 0.0
    for k in range(first, last + 1):
        if samples.field_sd_tesla[i + k] >= 0.0:
            share = shape[middle + k] if everywhere else 1.0
            total += share
            field_tesla += share * samples.field_tesla[i + k]
            variance += (share * samples.field_sd_tesla[i + k]) ** 2
    if total == 0.0:
        return -1.0
    field_tesla /= total
    return np.sqrt(variance) / total


@compiled
def reach_of(samples: ImuBlock, i: int, longest: int) -> int:
    """Return how many samples on either side of sample i belong together with it."""
    for reach in range(longest):
        first, last = i - reach - 1, i + reach + 1
        if first < 0 or last >= samples.stamp_ns.shape[0]:
            return reach
        if not (together(samples, first) and together(samples, last - 1)):
            return reach
    return longest


@compiled
def together(samples: ImuBlock, i: int) -> bool:
    """Return whether a sample and the next are numbers, and neither a gap nor a switch of a sensor is between them.

    Stamps that repeat or change places are those of a burst on arrival: the samples themselves are even.
    """
    apart_ns = abs(samples.stamp_ns[i + 1] - samples.stamp_ns[i])
    switched = differs(samples.gyro_sd_radps, i) or differs(samples.accel_sd_mps2, i)
    return apart_ns <= GAP_NS and not switched and finite(samples, i) and finite(samples, i + 1)


@compiled
def differs(deviations: Floats, i: int) -> bool:
    """Return whether one of sample i and the next was measured, and the other not."""
    return (deviations[i] < 0.0) != (deviations[i + 1] < 0.0)


@compiled
def finite(samples: ImuBlock, i: int) -> bool:
    """Return whether all values of a sample are numbers."""
    return within(row(samples.gyro_radps, i), np.inf) and within(row(samples.accel_mps2, i), np.inf)


def kept_of(native_hz: float, rate_hz: float) -> int:
    """Return k, 1 or more, so that every k-th sample comes as near to the rate as possible."""
    return max(1, round(native_hz / rate_hz))

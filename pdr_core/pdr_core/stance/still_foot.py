"""Where a foot is still by its accelerometer alone, sample by sample: what navigates without the gyro needs no more.

The verdicts are those of `StanceDetection` with the acceleration moving variance and no time gate, and are known at the
same time. What only the gyro tells, how still the foot stands and how well it rests, is not worked out.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.maths.centred_window import with_neighbours
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, record
from pdr_core.maths.sample_memory import add_sample, let_samples_go, sample_rows
from pdr_core.maths.vector import Triple, row
from pdr_core.records import ImuBlock
from pdr_core.stance.acceleration_moving_variance import variance

CAPACITY = 2048  # samples of two windows; where there are more, they are judged by what there is
MEMORY = record(
    [
        *sample_rows(CAPACITY),
        ("judged", np.int64),  # row of the next sample to judge
        ("first", np.int64),  # where the window of the last one judged begins and ends
        ("last", np.int64),
    ],
)


class StillLimits(NamedTuple):
    """The window, and the variance [(m/s^2)^2] up to which a foot is still."""

    half_window_ns: int
    threshold: float


@compiled
def jumps_back(stamp_ns: int, s: Memory) -> bool:
    """Return whether the clock was set back before a sample."""
    return s.held > 0 and stamp_ns < s.stamp_ns[s.held - 1]


@compiled
def forget(s: Memory) -> None:
    """Start anew: no sample waits for a verdict."""
    s.held, s.judged, s.first, s.last = 0, 0, 0, 0


@compiled
def remember(imu: ImuBlock, i: int, s: Memory) -> None:
    """Take sample i; what no window needs any more is forgotten where there is no room."""
    if s.held == CAPACITY:
        keep_from(max(1, min(s.first, s.judged - 1)), s)
    add_sample(imu.stamp_ns[i], row(imu.accel_mps2, i), row(imu.field_tesla, i), imu.field_sd_tesla[i], s)


@compiled
def keep_from(first: int, s: Memory) -> None:
    """Forget the rows before one."""
    let_samples_go(first, s)
    s.judged, s.first, s.last = s.judged - first, max(0, s.first - first), s.last - first


@compiled
def due(final: bool, half_window_ns: int, s: Memory) -> bool:
    """Return whether the next sample can be judged: no later one changes its window, to which the one after it belongs.

    `final`: no later one comes.
    """
    if final or s.judged >= s.held - 1:
        return final and s.judged < s.held
    overfull = s.held == CAPACITY and s.judged < 2
    return overfull or s.stamp_ns[s.judged] <= s.stamp_ns[s.held - 1] - half_window_ns


@compiled
def judge(limits: StillLimits, s: Memory) -> bool:
    """Return whether the foot is still at the next sample to judge, by what there is."""
    i = s.judged
    while s.stamp_ns[i] - s.stamp_ns[s.first] > limits.half_window_ns:
        s.first += 1
    while s.last < s.held and s.stamp_ns[s.last] - s.stamp_ns[i] <= limits.half_window_ns:
        s.last += 1
    first, last = with_neighbours(s.stamp_ns, s.held, i, s.first, s.last)
    s.judged += 1
    return variance(s.accel_mps2, first, last) <= limits.threshold


@compiled
def next_sample(s: Memory) -> tuple[int, Triple, Triple, float]:
    """Return the next sample to judge: stamp, specific force, field and its deviation."""
    i = s.judged
    return s.stamp_ns[i], row(s.accel_mps2, i), row(s.field_tesla, i), s.field_sd_tesla[i]

"""How far the accelerometer of a foot is from what it shows when the foot stands.

A foot that stands shows one vector in the axes of its sensor, however that is mounted: the gravity of the last still
moment. The distance to it,

    d = |a - a_standing|,

is small once a stride, in walking and in running, and large in the swing: it sees the foot tip as well as accelerate.
The norm does not: where a runner's foot falls freely, |a| - g passes through zero as if it stood. A still moment is one
whose variance in a window is small, and whose norm is near gravity.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import STANDARD_GRAVITY_MPS2, nanoseconds
from pdr_core.gait.lowpass import GRID_NS, EvenBlock
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, fresh, record
from pdr_core.maths.vector import added, difference, norm, row, scaled
from pdr_core.params import GaitParams
from pdr_core.records import Flags, Floats, Stamps

NEAR_GRAVITY_MPS2 = 1.0  # the norm of a still foot differs by less: biases and scale of a consumer sensor
LONGEST_WINDOW = 64  # values


class MotionBlock(NamedTuple):
    """n values of how a foot moves."""

    stamp_ns: Stamps  # (n,)
    beside_mps2: Floats  # (n,) norm of the acceleration less that of a standing foot: |a| - g
    distance_mps2: Floats  # (n,) d; 0: it has not been seen standing yet
    still: Flags  # (n,) on the ground, and not moving
    fresh: Flags  # (n,)


class MotionLimits(NamedTuple):
    """What a still moment is."""

    window: int  # values
    calm_sd_mps2: float
    calm_mps2: float


MEMORY = record(
    [
        ("window", np.float64, (LONGEST_WINDOW, 3)),  # the last values, a ring
        ("seen", np.int64),  # values since the last gap
        ("standing", np.float64, 3),  # the specific force of the standing foot; zero: not known yet
        ("known", np.bool_),
    ],
)


class FootMotion:
    """Even accelerations in, motion out."""

    def __init__(self, params: GaitParams) -> None:
        self._limits = motion_limits(params)
        self._memory = fresh(MEMORY)

    def run(self, even: EvenBlock) -> MotionBlock:
        """Take the next accelerations."""
        return moved(even, self._limits, self._memory[0])


def motion_limits(params: GaitParams) -> MotionLimits:
    """Derive the limits from the parameters."""
    window = max(2, min(LONGEST_WINDOW, nanoseconds(params.calm_s) // GRID_NS))
    return MotionLimits(window, params.calm_sd_mps2, params.calm_mps2)


@compiled
def moved(even: EvenBlock, limits: MotionLimits, s: Memory) -> MotionBlock:
    """Return the motion of the next values."""
    n = even.stamp_ns.shape[0]
    beside, distance, still = np.empty(n), np.zeros(n), np.zeros(n, np.bool_)
    for i in range(n):
        a = row(even.accel_mps2, i)
        if even.fresh[i]:
            s.seen = 0
        s.window[s.seen % limits.window] = a
        s.seen += 1
        calm = s.seen >= limits.window and is_calm(s.window[: limits.window], limits.calm_sd_mps2)
        if calm:
            stand(limits.window, s)
        beside[i] = norm(a) - (norm(s.standing) if s.known else STANDARD_GRAVITY_MPS2)
        if s.known:
            distance[i] = norm(difference(a, s.standing))
        still[i] = calm and s.known and distance[i] < limits.calm_mps2
    return MotionBlock(even.stamp_ns, beside, distance, still, even.fresh)


@compiled
def is_calm(window: Floats, calm_sd_mps2: float) -> bool:
    """Return whether the deviation of vectors, (n, 3), is small."""
    n, total = window.shape[0], 0.0
    for axis in range(3):
        values = window[:, axis]
        total += ((values - values.sum() / n) ** 2).sum()
    return total < n * calm_sd_mps2**2


@compiled
def stand(window: int, s: Memory) -> None:
    """Take the mean of the window for the standing foot, if its norm may be gravity."""
    total = (0.0, 0.0, 0.0)
    for i in range(window):
        total = added(total, row(s.window, i))
    mean = scaled(1.0 / window, total)
    if abs(norm(mean) - STANDARD_GRAVITY_MPS2) < NEAR_GRAVITY_MPS2:
        s.standing[:] = mean
        s.known = True

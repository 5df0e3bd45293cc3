"""What a foot shows without its gyro: behaviour, strides, and the stands between them."""

from collections import deque
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import nanoseconds
from pdr_core.gait.accelerometer_steps import (
    STRIDE,
    AccelerometerSteps,
    most_strides,
    recognised,
    steps_of,
)
from pdr_core.gait.stands import STAND, Stand, StandLimits, Stands, stands_of, take
from pdr_core.gait.unseen_stands import UnseenStands, remember
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, fresh, packed
from pdr_core.params import Params
from pdr_core.records import Flags, ImuBlock, length
from pdr_core.records_gait import Behaviour, GaitStep
from pdr_core.stance import still_foot

STILL_VARIANCE = 1.4  # of the acceleration [(m/s^2)^2]: counts on the tile walks are exact from 1.0 to 1.44
SEEN_NS = nanoseconds(0.8)  # so long after its ground hit a stride is given out, with its stand or without
NEAR_NS = nanoseconds(0.15)  # the stillest moment of a stand may come so long before what shows the ground hit


class SeenStride(NamedTuple):
    """A stride and the stands at its ends; None: the foot was not seen to stand."""

    step: GaitStep
    before: Stand | None
    stand: Stand | None


class Watched(NamedTuple):
    """What became known with some samples."""

    strides: list[SeenStride]
    still: Flags  # of the next samples that were not judged yet: the foot is still


class GaitWatch:
    """Samples in, strides out; what the gyro shows, where it is on, is not looked at."""

    def __init__(self, params: Params) -> None:
        self._stands = Stands(params.dead_reckoning)
        self._steps = AccelerometerSteps(params.gait)
        self._unseen = UnseenStands(params.gait)
        half_window_ns = nanoseconds(0.5 * params.detectors.acceleration_moving_variance_window_s)
        self._limits = packed(still_foot.StillLimits(half_window_ns, STILL_VARIANCE))
        self._still = fresh(still_foot.MEMORY)
        self._unjudged = 0  # samples without a verdict
        self._waiting: deque[GaitStep] = deque()  # for the stand that ends them
        self._stood: list[Stand] = []  # the stand that ended the last stride, and those after it

    @property
    def behaviour(self) -> Behaviour:
        """What the foot does now."""
        return self._steps.behaviour

    def run(self, imu: ImuBlock) -> Watched:
        """Return what is known with these samples."""
        count = length(imu)
        if not count:
            return Watched([], np.zeros(0, np.bool_))
        self._unjudged += count
        steps, stands = self._steps, self._stands
        limits = steps.limits, self._limits, stands.limits
        memories = steps.memory, self._still, stands.memory, self._unseen.memory
        strides, stood = np.empty(most_strides(count), STRIDE), np.empty(self._unjudged, STAND)
        still, found, known = watched(imu, *limits, *memories, strides, stood)
        self._unjudged -= len(still)
        if found:
            self._waiting += steps_of(strides, found)
        if known:
            self._stood += stands_of(stood, known)
        return Watched(self._met(int(imu.stamp_ns[-1])), still)

    def _met(self, now_ns: int) -> list[SeenStride]:
        """Return the strides whose stand is known, or overdue; so are all of a clock that has jumped back."""
        seen = []
        self._stood = [stand for stand in self._stood if stand.stamp_ns <= now_ns]
        while self._waiting:
            step = self._waiting[0]
            ends = [i for i, stand in enumerate(self._stood) if stand.stamp_ns >= step.stamp_ns - NEAR_NS]
            overdue = not 0 <= now_ns - step.stamp_ns < SEEN_NS
            if not ends and not overdue:
                break
            seen.append(self._ended(self._waiting.popleft(), ends[0] if ends and not overdue else None))
        return seen

    def _ended(self, step: GaitStep, stand: int | None) -> SeenStride:
        """Return a stride with the stand that ends it and the one before that."""
        if stand is None:
            return self._ended_unseen(step)
        before = self._stood[stand - 1] if stand > 0 else None
        self._stood = self._stood[stand:]
        return SeenStride(step, before, self._stood[0])

    def _ended_unseen(self, step: GaitStep) -> SeenStride:
        """Return a stride after which the foot was not seen to stand."""
        stand = self._unseen.stand(step, self._steps.standing_mps2)
        before = [earlier for earlier in self._stood if earlier.stamp_ns < stand.stamp_ns]
        self._stood = [stand, *self._stood[len(before) :]]
        return SeenStride(step, before[-1] if before else None, stand)


@compiled
def watched(
    imu: ImuBlock,
    gait: NDArray[Any],
    still: NDArray[Any],
    stand: NDArray[Any],
    steps: NDArray[Any],
    waiting: NDArray[Any],
    swing: NDArray[Any],
    unseen: NDArray[Any],
    strides: NDArray[Any],
    stood: NDArray[Any],
) -> tuple[Flags, int, int]:
    """Write strides and stands; return the next verdicts, (m,), and the numbers of both."""
    s, verdicts, done = waiting[0], np.empty(stood.shape[0], np.bool_), (0, 0)
    for i in range(imu.stamp_ns.shape[0]):
        remember(imu, i, unseen[0])
        if still_foot.jumps_back(imu.stamp_ns[i], s):
            done = judged(True, done, still[0], stand[0], s, swing[0], verdicts, stood)
            still_foot.forget(s)
        still_foot.remember(imu, i, s)
        done = judged(False, done, still[0], stand[0], s, swing[0], verdicts, stood)
    return verdicts[: done[0]], recognised(imu, gait, steps, strides)[2], done[1]


@compiled
def judged(
    final: bool,
    done: tuple[int, int],
    still: still_foot.StillLimits,
    stand: StandLimits,
    waiting: Memory,
    swing: Memory,
    verdicts: Flags,
    stood: NDArray[Any],
) -> tuple[int, int]:
    """Write the verdicts that are known, and the stands with them; return how many of both are written now."""
    n, known = done
    while still_foot.due(final, still.half_window_ns, waiting):
        sample = still_foot.next_sample(waiting)
        verdicts[n] = still_foot.judge(still, waiting)
        known += take(*sample, verdicts[n], stand, swing, stood[known])
        n += 1
    return n, known

"""What the foot does: it stands, swings, walks or runs (Zhou section 2.3), from its accelerometer alone.

Zhou names three features of the acceleration in a window, its variance, its direct component and its energy, and a
state machine in real time; windows and thresholds are left to another paper. Here

    variance           of the last moments: small where the foot is still
    direct component   mean of |a| - g over a stride: a lifted or dangling foot has none, a walking one is flung
    energy             root mean square of |a| - g over a stride: a leg that swings to and fro is slow beside a runner's
    rest               time in which the foot may stand before it moves on: about 0.45 s in walking and 0.04 s in
                       running, however hard a person steps

    UNKNOWN   it has not been seen standing since the start or the last gap
    STANDING  still for `standing_s`
    SWING     it moves, but no ground hit has ended a stride of a walk: the first stride, and a foot that is only moved
    WALKING   a ground hit has ended a stride with direct component and energy, after a rest over `walking_rest_s`
    RUNNING   the same after a rest below `running_rest_s`, or it ends in a stance in which the foot is never still;
              with an energy over `running_energy_mps2`, else it is a swing

Hysteresis: after a rest in between it goes on as before, and from walking to running it takes two short stances. In a
sharp turn a walker makes one of them; a runner never rests for so long as a walker.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.gait.foot_motion import MotionBlock
from pdr_core.gait.stride_features import StrideFeatures
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, fresh, record
from pdr_core.params import GaitParams
from pdr_core.records_gait import Behaviour

UNKNOWN, STANDING, SWING, WALKING, RUNNING = (behaviour.value for behaviour in Behaviour)


class BehaviourLimits(NamedTuple):
    """What tells the behaviours apart."""

    standing_ns: int
    longest_ns: int
    swing_direct_mps2: float
    swing_energy_mps2: float
    running_rest_s: float
    walking_rest_s: float
    running_energy_mps2: float


MEMORY = record(
    [
        ("still_ns", np.int64),  # since when it is still; NO_STAMP: it moves
        ("seen_ns", np.int64),  # stamp of the last hit, or of when it was last still
        ("looked", np.int64),  # what the last stride looked like
        ("by_dip", np.bool_),  # and whether it ended in one
        ("behaviour", np.int64),
    ],
)


class BehaviourRecognition:
    """The state machine: one call for every value of the motion."""

    def __init__(self, params: GaitParams) -> None:
        self._limits = behaviour_limits(params)
        self._memory = fresh(MEMORY)
        begin_anew(self._memory[0])

    def stride(self, stride: StrideFeatures) -> Behaviour:
        """Take a stride that a ground hit has ended; return what the foot did in it, and still does."""
        take_stride(stride, self._limits, self._memory[0])
        return Behaviour(int(self._memory["behaviour"][0]))

    def run(self, motion: MotionBlock, i: int) -> Behaviour:
        """Take value i of a motion; return what the foot does."""
        follow(int(motion.stamp_ns[i]), bool(motion.still[i]), bool(motion.fresh[i]), self._limits, self._memory[0])
        return Behaviour(int(self._memory["behaviour"][0]))


def behaviour_limits(p: GaitParams) -> BehaviourLimits:
    """Derive the limits from the parameters."""
    return BehaviourLimits(
        nanoseconds(p.standing_s),
        nanoseconds(p.stride_longest_s),
        p.swing_direct_mps2,
        p.swing_energy_mps2,
        p.running_rest_s,
        p.walking_rest_s,
        p.running_energy_mps2,
    )


@compiled
def begin_anew(s: Memory) -> None:
    """Know nothing of what the foot does now."""
    s.still_ns, s.seen_ns, s.behaviour = NO_STAMP, NO_STAMP, UNKNOWN


@compiled
def take_stride(stride: StrideFeatures, limits: BehaviourLimits, s: Memory) -> None:
    """Take a stride that a ground hit has ended."""
    look, before = looks(stride, limits, s), s.looked
    s.seen_ns, s.looked, s.by_dip = stride.hit_ns, look, stride.by_dip
    begins_to_run = s.behaviour == WALKING and look == RUNNING
    if not begins_to_run or before == RUNNING:
        s.behaviour = look


@compiled
def looks(stride: StrideFeatures, limits: BehaviourLimits, s: Memory) -> int:
    """Return what a stride looks like, taken by itself; its rest may be a short stance that has told already."""
    if stride.direct_mps2 < limits.swing_direct_mps2 or stride.energy_mps2 < limits.swing_energy_mps2:
        return SWING
    if stride.by_dip or (stride.rest_s < limits.running_rest_s and not s.by_dip):
        return RUNNING if stride.energy_mps2 >= limits.running_energy_mps2 else SWING
    unsure = stride.rest_s <= limits.walking_rest_s and (s.behaviour == WALKING or s.behaviour == RUNNING)
    return s.behaviour if unsure else WALKING


@compiled
def follow(stamp_ns: int, still: bool, fresh: bool, limits: BehaviourLimits, s: Memory) -> None:
    """Take the next value: stand after a long rest, and swing as soon as it ends or where no ground hit comes."""
    if fresh:
        begin_anew(s)
    if still:
        s.still_ns = stamp_ns if s.still_ns == NO_STAMP else s.still_ns
        s.seen_ns = stamp_ns
    else:
        s.still_ns = NO_STAMP
    late = s.seen_ns != NO_STAMP and stamp_ns - s.seen_ns > limits.longest_ns
    if still and stamp_ns - s.still_ns >= limits.standing_ns:
        s.behaviour = STANDING
    elif late or (s.behaviour == STANDING and not still):
        s.behaviour = SWING
    elif s.behaviour == UNKNOWN and still:
        s.behaviour = STANDING

"""Strides and behaviour from the accelerometer alone: for the time in which the gyro sleeps (Zhou section 2.2-2.3)."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import NO_STAMP
from pdr_core.gait import behaviour, foot_motion, ground_hits, lowpass, stride_features
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, fresh, packed, record
from pdr_core.params import GaitParams
from pdr_core.records import Floats, ImuBlock, Stamps, length
from pdr_core.records_gait import Behaviour, GaitStep


class GaitSeen(NamedTuple):
    """What became known with some samples: the behaviour 50 times a second, and the strides."""

    stamp_ns: Stamps  # (n,) half the filter's length behind the samples
    behaviour: Stamps  # (n,) Behaviour values
    steps: list[GaitStep]


class GaitLimits(NamedTuple):
    """The parameters of all stages; compiled code takes them packed."""

    taps: Floats
    motion: foot_motion.MotionLimits
    hits: ground_hits.HitLimits
    ruler: stride_features.RulerLimits
    behaviour: behaviour.BehaviourLimits


MEMORY = record(
    [
        ("lowpass", lowpass.MEMORY),
        ("motion", foot_motion.MEMORY),
        ("hits", ground_hits.MEMORY),
        ("ruler", stride_features.MEMORY),
        ("behaviour", behaviour.MEMORY),
        ("count", np.int64),  # strides so far
    ],
)
STRIDE = record(  # a GaitStep
    [
        ("index", np.int64),
        ("start_ns", np.int64),
        ("stamp_ns", np.int64),
        ("behaviour", np.int64),
        ("frequency_hz", np.float64),
        ("accel_mean_mps2", np.float64),
        ("accel_max_mps2", np.float64),
        ("accel_min_mps2", np.float64),
        ("accel_mean_abs_mps2", np.float64),
    ],
)
BEHAVIOURS = tuple(Behaviour)


class AccelerometerSteps:
    """Samples in, behaviour and strides out; the gyro is not looked at.

    A walked stride is known 0.15 s of filter and `calm_s` after its hit, a run one 0.15 s and at most `dip_wait_s`.
    """

    def __init__(self, params: GaitParams) -> None:
        self.limits = packed(gait_limits(params))
        self.memory = fresh(MEMORY)
        begin_anew(self.memory)

    def run(self, imu: ImuBlock) -> GaitSeen:
        """Take the next samples, any number of them, at any rate from 20 Hz on."""
        found = np.empty(most_strides(length(imu)), STRIDE)
        stamp_ns, does, count = recognised(imu, self.limits, self.memory, found)
        return GaitSeen(stamp_ns, does, steps_of(found, count))

    @property
    def standing_mps2(self) -> Floats:
        """The specific force, (3,), of the foot when it stood last; zero: not known yet."""
        standing: Floats = self.memory[0].motion.standing
        return standing

    @property
    def behaviour(self) -> Behaviour:
        """What the foot does now."""
        return BEHAVIOURS[self.memory[0].behaviour.behaviour]


def gait_limits(p: GaitParams) -> GaitLimits:
    """Derive the limits from the parameters."""
    return GaitLimits(
        lowpass.taps(p.cutoff_hz, p.filter_s),
        foot_motion.motion_limits(p),
        ground_hits.hit_limits(p),
        stride_features.RulerLimits(p.standing_s, p.calm_mps2),
        behaviour.behaviour_limits(p),
    )


def most_strides(samples: int) -> int:
    """Return how many strides so many samples can end."""
    return samples * lowpass.MOST_VALUES


def steps_of(found: NDArray[Any], count: int) -> list[GaitStep]:
    """Return the strides in the first rows of an array of STRIDE."""
    return [
        GaitStep(index, start_ns, stamp_ns, BEHAVIOURS[seen], *figures)
        for index, start_ns, stamp_ns, seen, *figures in found[:count].tolist()
    ]


@compiled
def begin_anew(memory: NDArray[Any]) -> None:
    """Know nothing."""
    s = memory[0]
    ground_hits.begin_anew(s.hits)
    stride_features.begin_anew(s.ruler)
    behaviour.begin_anew(s.behaviour)


@compiled
def recognised(
    imu: ImuBlock, settings: NDArray[Any], memory: NDArray[Any], found: NDArray[Any]
) -> tuple[Stamps, Stamps, int]:
    """Write the strides that the next samples end; return stamps and behaviours, as in GaitSeen, and their number."""
    s, limits, count = memory[0], settings[0], 0
    motion = foot_motion.moved(lowpass.low_passed(imu, limits.taps, s.lowpass), limits.motion, s.motion)
    hit_ns, by_dip = ground_hits.hits(motion, limits.hits, s.hits)
    does = np.empty(hit_ns.shape[0], np.int64)
    for i in range(hit_ns.shape[0]):
        behaviour.follow(motion.stamp_ns[i], motion.still[i], motion.fresh[i], limits.behaviour, s.behaviour)
        stride_features.add(motion, i, s.ruler)
        if hit_ns[i] != NO_STAMP:
            count += ended(hit_ns[i], by_dip[i], limits, s, found[count])
        does[i] = s.behaviour.behaviour
    return motion.stamp_ns, does, count


@compiled
def ended(hit_ns: int, by_dip: bool, limits: GaitLimits, s: Memory, out: Memory) -> bool:
    """Write the stride that ends with a hit; return whether there is one."""
    stride = stride_features.stride(hit_ns, by_dip, limits.ruler, s.ruler)
    if stride.frequency_hz == 0.0:
        return False
    behaviour.take_stride(stride, limits.behaviour, s.behaviour)
    s.count += 1
    out.index, out.start_ns, out.stamp_ns, out.behaviour = s.count, stride.start_ns, hit_ns, s.behaviour.behaviour
    out.frequency_hz, out.accel_mean_mps2 = stride.frequency_hz, stride.direct_mps2
    out.accel_max_mps2, out.accel_min_mps2 = stride.max_mps2, stride.min_mps2
    out.accel_mean_abs_mps2 = stride.mean_abs_mps2
    return True

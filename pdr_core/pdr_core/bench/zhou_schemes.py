"""The second lap by three schemes (Zhou section 5): ZUPT-KF, conventional PDR, and ours, the gyro of both asleep.

The first lap is the same for all: the ZUPT filter at 200 Hz. Ours learns from it as the suite does on the way; so L0 is
a lap, and no T0 falls into the second. Conventional PDR has the same strides and headings of the foot, but

- its step length is the bi-parametric line over the frequency, fitted offline: to the true lengths of the first lap;
- the foot is taken to point where the person walks.

The second lap has the rate of the paper's tables. All schemes begin it at the pose of the filter.
"""

import copy
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from pdr_core.bench.zhou_lesson import PIECE_S, Lesson, row_of
from pdr_core.bench.zhou_walks import pieces
from pdr_core.gait.dead_reckoning import GaitDeadReckoning, Length, Reckoned
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.pipeline import FootInertial
from pdr_core.pipeline.gait_model import Told
from pdr_core.pipeline.gait_watch import SeenStride
from pdr_core.records import Floats, ImuBlock, StepEvent, joined
from pdr_core.records_gait import Angle

AFTER_NS = 100_000_000  # a stride is reckoned to a moment so near to where the foot is flat
NO_DEVIATION = Angle(0.0, 0.0)
SCHEMES = ("ZUPT-KF", "PDR", "ours")


class Track(NamedTuple):
    """The second lap by a scheme, at the true stands."""

    position_m: Floats  # (strides + 1, 2)
    yaw_rad: Floats  # (strides + 1,) of the foot
    deviation_rad: float  # by which the walk is taken to go away from it
    strides: int
    distance_m: float


def by_filter(lesson: Lesson, samples: Sequence[ImuBlock]) -> Track:
    """Return the second lap by the filter, whose gyro stays on."""
    octagon = lesson.octagon
    chain = FootInertial(lesson.params)
    for piece in lesson.samples:
        chain.run(piece)
    outputs = [*map(chain.run, samples), chain.finish()]
    nav, steps = joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps]
    rows = [row_of(nav, int(stamp)) for stamp in octagon.stand_ns[octagon.half :]]
    yaws_rad = np.array([yaw_rad(quat_xyzw) for quat_xyzw in nav.quat_xyzw[rows]])
    lap = [step for step in steps if step.start_ns >= octagon.stand_ns[octagon.half]]
    return Track(nav.position_m[rows, :2], yaws_rad, octagon.deviation_rad, *summed(lap))


def ours(lesson: Lesson, stride: SeenStride) -> Told:
    """Return what the model that was learnt on the way says of a stride."""
    return lesson.model.told(stride)


def conventional(lesson: Lesson, stride: SeenStride) -> Told:
    """Return the same with the length of the offline model, and a foot that points where the person walks."""
    length = Length(*lesson.offline.length(stride.step))
    return lesson.model.told(stride)._replace(length=length, deviation=NO_DEVIATION)


GAIT_SCHEMES = {"PDR": conventional, "ours": ours}


def strides_of(lesson: Lesson, samples: Sequence[ImuBlock]) -> list[SeenStride]:
    """Return the strides of the second lap as a sensor with its gyro off shows them."""
    watch = copy.deepcopy(lesson.watch)
    strides = [stride for piece in samples for stride in watch.run(without_rates(piece)).strides]
    return [stride for stride in strides if stride.step.stamp_ns > lesson.start.stamp_ns]


def by_strides(lesson: Lesson, scheme: str, strides: Sequence[SeenStride]) -> Track:
    """Return the second lap by dead reckoning."""
    reckoning, tell = GaitDeadReckoning(lesson.params.dead_reckoning), GAIT_SCHEMES[scheme]
    reckoning.begin(lesson.start)
    model = copy.deepcopy(lesson.model)  # it counts places of a clean field
    told = [tell(replace(lesson, model=model), stride) for stride in strides]
    reckoned = [reckoning.step(s.step, *t) for s, t in zip(strides, told, strict=True)]
    return track(lesson, reckoned, told)


def track(lesson: Lesson, reckoned: Sequence[Reckoned], told: Sequence[Told]) -> Track:
    """Return dead reckoned steps at the true stands."""
    octagon, start = lesson.octagon, lesson.start.pose
    assert start.quat_xyzw is not None
    steps = [r.step for r in reckoned]
    position_m = np.array([start.position_m[:2], *(step.position_m[:2] for step in steps)])
    yaws_rad = np.array([yaw_rad(start.quat_xyzw), *(step.yaw_rad for step in steps)])
    ends_ns = np.array([step.stamp_ns for step in steps])
    rows = np.searchsorted(ends_ns, octagon.stand_ns[octagon.half :] + AFTER_NS, side="right")
    lap = steps[rows[0] :]
    return Track(position_m[rows], yaws_rad[rows], told[-1].deviation.rad, *summed(lap))


def summed(steps: Sequence[StepEvent]) -> tuple[int, float]:
    """Return how many steps these are and their distance."""
    return len(steps), sum(step.length_m for step in steps)


def without_rates(imu: ImuBlock) -> ImuBlock:
    """Return samples of a sensor whose gyro is off."""
    return imu._replace(gyro_radps=np.zeros_like(imu.gyro_radps), gyro_sd_radps=np.full(len(imu.stamp_ns), -1.0))


def at_rate(lesson: Lesson, rate_hz: int, schemes: Sequence[str] = SCHEMES) -> dict[str, Track]:
    """Return the second lap by schemes."""
    samples = pieces(lesson.octagon.lap(2, rate_hz), PIECE_S, rate_hz)
    strides = strides_of(lesson, samples)
    return {s: by_strides(lesson, s, strides) if s in GAIT_SCHEMES else by_filter(lesson, samples) for s in schemes}

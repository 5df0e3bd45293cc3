"""Zhou's Tables 4 and 6, figures 7, 8 and 12: what is found of a tester's heading deviation, and what it is worth."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pdr_core.bench.zhou_errors import LapResult, result
from pdr_core.bench.zhou_lesson import Lesson, lesson, row_of
from pdr_core.bench.zhou_schemes import at_rate
from pdr_core.bench.zhou_walks import Trial, octagon
from pdr_core.gait.heading_deviation import (
    HeadingDeviation,
    chord_rad,
    direction_of_displacement,
    direction_of_velocity,
)
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.records import Floats, part
from pdr_core.records_gait import Angle, Behaviour

TABLE_4_DEG = {"a": 29.2, "b": 5.8, "c": 15.6, "d": 8.7}
TABLE_6_HZ = 100
BEHAVIOUR = {"walking": Behaviour.WALKING, "running": Behaviour.RUNNING}


@dataclass(frozen=True)
class Found:
    """The deviation of one tester in one first lap, by both observations (Zhou eq. 20 and 21), and by the suite."""

    gait: str
    tester: str
    seed: int
    true_deg: float
    by_place_deg: float
    by_velocity_deg: float
    learnt_deg: float  # what the second lap is walked with


class Observed(NamedTuple):
    """The strides of a first lap as figures 7, 8 and 12 show them, (strides,) [deg]."""

    stride: Floats
    heading_deg: Floats  # of the foot, half-way through the stride
    by_place_deg: Floats  # where the stride goes: eq. 20
    by_velocity_deg: Floats  # eq. 21
    deviation_deg: Floats  # the filter's, from eq. 20
    true_deg: float


def found(known: Lesson) -> tuple[Found, Observed]:
    """Return what the first lap shows of the deviation, stride by stride."""
    octagon = known.octagon
    nav, steps = known.nav, known.steps
    behaviour, rows = BEHAVIOUR[octagon.trial.gait], []
    by_place, by_velocity = (HeadingDeviation(known.params.dead_reckoning) for _ in range(2))
    for step in steps:
        first, last = row_of(nav, step.start_ns), row_of(nav, step.stamp_ns)
        before, after = (yaw_rad(nav.quat_xyzw[i]) for i in (first, last))
        end, fastest = Angle(after, step.yaw_sd_rad), direction_of_velocity(part(nav, first, last + 1))
        by_place.learn(behaviour, step, before, end)
        by_velocity.learn(behaviour, step, before, end, fastest)
        now_rad = by_place.deviation(behaviour).rad
        rows.append([chord_rad(before, after), direction_of_displacement(step).rad, fastest.rad, now_rad])
    heading, place, velocity, deviation = np.degrees(np.unwrap(np.array(rows), axis=0)).T
    true_deg = float(np.degrees(octagon.deviation_rad))
    place_deg, velocity_deg, learnt_deg = (
        float(np.degrees(wrapped_rad(d.deviation(behaviour).rad))) for d in (by_place, by_velocity, known.model)
    )
    return (
        Found(
            octagon.trial.gait, octagon.trial.tester, octagon.trial.seed, true_deg, place_deg, velocity_deg, learnt_deg
        ),
        Observed(np.arange(len(rows), dtype=np.float64), heading, place, velocity, deviation, true_deg),
    )


def tester(trial: Trial) -> tuple[Found, list[LapResult]]:
    """Return what is found of a tester, and the second lap without and with it (Zhou Table 6)."""
    known = lesson(octagon(trial))
    tracks = at_rate(known, TABLE_6_HZ, ("PDR", "ours"))
    return found(known)[0], [result(known.octagon, s, TABLE_6_HZ, track) for s, track in tracks.items()]

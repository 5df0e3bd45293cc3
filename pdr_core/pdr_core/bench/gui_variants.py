"""The parts of Gui's method, switched on one after the other (Gui Table 3), and what an ideal heading would make of it.

In Gui's motion every stance is perfectly still, so every stance may tell the gyro bias (ZARU): the rest test takes
rests of 0.3 s, which is what its guards leave of a stance of 0.5 s. On real feet it must not. Without ZARU the rest
before the walk tells the bias, as in Gui section 2.1. The constraint takes for the direction of a step what Gui takes:
the yaw of the standing foot after it. In this motion it lies exactly along a line, and lines are exactly straight; the
suite is told so. HDE and iHDE know how the building stands.

The ideal heading is the floor: it knows by how much the track is turned at the end of each step, from the true yaw, and
tells the filter by the same answers as the constraints. What is left then comes from the displacements of the steps.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from pdr_core.bench.table_1 import told_of
from pdr_core.heading import HeadingConstraint
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import Params, changed
from pdr_core.pipeline.foot_inertial import Heading, empty_answer
from pdr_core.records import HeadingObservation, HeadingSource, StepEvent
from pdr_core.simulation import SimulatedWalk

SENSOR = "gui_table_1_deg"
STANCE_TELLS_S = 0.3  # shortest rest with ZARU
NEVER_S = 60.0  # and without
FOOT_SD_RAD = 0.005  # 0.3 deg: twice what the yaw wanders from stride to stride by the noise of this gyro
IDEAL_SD_RAD = 1e-4


class Variant(NamedTuple):
    """A part of the method: which rests tell the bias, and what answers the steps of a walk."""

    rest_later_s: float
    heading: Callable[[Params, SimulatedWalk], Heading]
    constraint: str = "none"
    walking_direction: str = "stride"


def nothing(params: Params, walk: SimulatedWalk) -> Heading:  # noqa: ARG001  (the form of all)
    """Answer nothing."""
    return empty_answer


def constrained(params: Params, walk: SimulatedWalk) -> Heading:  # noqa: ARG001
    """Answer by the heading constraint of the parameters."""
    return HeadingConstraint(params.heading).answer


def ideal(params: Params, walk: SimulatedWalk) -> Heading:  # noqa: ARG001
    """Answer by the true yaw of the foot."""

    def answer(step: StepEvent) -> HeadingObservation:
        now = np.searchsorted(walk.imu.stamp_ns, step.stamp_ns)
        error_rad = wrapped_rad(step.yaw_rad - yaw_rad(walk.motion.quat_xyzw[now]))
        return HeadingObservation(
            step.index, step.stamp_ns, step.answer_due_ns, HeadingSource.EXTERNAL, error_rad, IDEAL_SD_RAD
        )

    return answer


TABLE_3 = ("ZUPT", "ZUPT+ZARU", "ZUPT+ZARU+eq. 9")  # the last one: what Gui proposes
FLOOR = "ZUPT+ZARU+ideal heading"
VARIANTS = {
    "ZUPT": Variant(NEVER_S, nothing),
    "ZUPT+ZARU": Variant(STANCE_TELLS_S, nothing),
    "ZUPT+ZARU+eq. 9": Variant(STANCE_TELLS_S, constrained, "dominant", "foot"),
    "ZUPT+ZARU+eq. 9, strides": Variant(STANCE_TELLS_S, constrained, "dominant"),
    "ZUPT+ZARU+HDE": Variant(STANCE_TELLS_S, constrained, "hde", "foot"),
    "ZUPT+ZARU+iHDE": Variant(STANCE_TELLS_S, constrained, "ihde", "foot"),
    "ZUPT+ZARU+learned": Variant(STANCE_TELLS_S, constrained, "learned", "foot"),
    FLOOR: Variant(STANCE_TELLS_S, ideal),
}


def told(variant: Variant) -> Params:
    """Return parameters that know the sensor and the motion."""
    params = changed(told_of(SENSOR), "stance", rest_later_s=variant.rest_later_s)
    params = changed(params, "filter", heading_feedback=variant.heading is not nothing)
    if variant.walking_direction == "foot":
        params = changed(params, "heading", walking_direction="foot", stride_sd_rad=FOOT_SD_RAD)
    return changed(params, "heading", constraint=variant.constraint, building_from="given", wander_spreads=0.0)

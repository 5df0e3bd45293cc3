"""Where the worlds of the feet's filters lie in that of the body.

Each filter begins at the origin of a world of its own, its x axis where the foot points. The body's world begins midway
between the standing feet, the left one half a stance width to the left. By how much a foot's world is turned, the first
straight line tells (`dual_heading.py`); the mean of both turns is none, so x is the mean of where the feet point.

A filter that is started anew on the way begins another world. Its first step there ends beside the other foot, as far
as anybody knows, and there the foot points as it used to.
"""

from collections.abc import Sequence

import numpy as np

from pdr_core.fusion.body import YAW, Frame, Moved, X, Y, Z
from pdr_core.fusion.dual_heading import KnownFrame
from pdr_core.maths.vector import Triple
from pdr_core.params import FusionParams
from pdr_core.records import Floats, StepEvent

TOE_SD_RAD = 0.1  # by how much a standing foot points elsewhere from one stance to the next
UNTURNED = KnownFrame(0.0, 0.0, 0.0)


class FootFrames:
    """Where each foot's world begins in that of the body, and how it was turned when it began."""

    def __init__(self, params: FusionParams, feet: Sequence[str]) -> None:
        self._left_m = dict(zip(feet, (0.5 * params.stance_width_m, -0.5 * params.stance_width_m), strict=False))
        if len(feet) == 1:
            self._left_m = {feet[0]: 0.0}
        self._starts_m: dict[str, Floats] = {foot: np.zeros(3) for foot in feet}
        self._places_m: dict[str, Floats] = {
            foot: np.array([0.0, left_m, 0.0]) for foot, left_m in self._left_m.items()
        }
        self.turn_rad = dict.fromkeys(feet, 0.0)
        self._place_sd_m = dict.fromkeys(feet, 0.0)
        self._turn_sd_rad = dict.fromkeys(feet, 0.0)
        self._apart_sd_m = params.apart_sd_m

    def begin(self, foot: str, start_m: Floats) -> None:
        """Begin a foot's world where its filter has it, beside the body's origin."""
        self._starts_m[foot] = start_m

    def begin_anew(self, foot: str, step: StepEvent, beside: Moved, toe_rad: float) -> None:
        """Begin another world of a foot: a step of it ended beside the other foot."""
        yaw_rad, apart_m = beside.pose[YAW], 2.0 * self._left_m[foot]
        self._starts_m[foot] = step.position_m
        self._places_m[foot] = beside.pose[X : Z + 1] + apart_m * np.array([-np.sin(yaw_rad), np.cos(yaw_rad), 0.0])
        self.turn_rad[foot] = float(yaw_rad + toe_rad - step.yaw_rad)
        variance_m2 = 0.5 * (beside.pose_covariance[X, X] + beside.pose_covariance[Y, Y])
        self._place_sd_m[foot] = float(np.sqrt(variance_m2 + self._apart_sd_m**2))
        self._turn_sd_rad[foot] = float(np.hypot(TOE_SD_RAD, np.sqrt(beside.pose_covariance[YAW, YAW])))

    def of(self, foot: str, known: KnownFrame | None) -> Frame:
        """Return the frame of a foot, with what is known of how it is turned beyond that."""
        turn_rad, sd_rad, toe_rad = known or UNTURNED
        start_m, place_m = triple(self._starts_m[foot]), triple(self._places_m[foot])
        where = start_m, place_m, self._place_sd_m[foot]
        return Frame(*where, self.turn_rad[foot] + turn_rad, self._turn_sd_rad[foot], sd_rad, toe_rad, TOE_SD_RAD)


def triple(vector: Floats) -> Triple:
    """Return a vector (3,) as compiled code takes it."""
    return float(vector[0]), float(vector[1]), float(vector[2])

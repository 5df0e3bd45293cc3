"""Dead reckoning by strides with the gyro off (Zhou eq. 14), with a covariance that grows as the error does.

Zhou's eq. 14 has x east and the angle from north, against the north-east-down axes that the text names. Here, in ENU
and counter-clockwise from x, a stride of length d that turns the foot by t goes

    x += s d cos(g)     y += s d sin(g)     yaw += t     g = yaw + t / 2 + deviation

where half of the turn is the chord of its arc (see `heading_deviation.py`). The error state is the pose, with z and
tilt which nobody measures, the heading deviation, and the scale s = 1 of the step length model. The last two do not
average out: a model that makes strides 2 % too long makes all of them so. That is why they are states and not noise,
though nothing that is measured corrects them. A heading that is held is wrong by what the person has turned since: the
turn of every stride is noise, whose sum the yaw keeps.
"""

from math import pi, sqrt
from typing import NamedTuple

import numpy as np

from pdr_core.gait.stride_track import (
    DEVIATION,
    SCALE,
    SIZE,
    TILT,
    TRACK,
    YAW,
    stand,
    stride,
    take_heading,
    track_limits,
)
from pdr_core.maths.memory import fresh, packed
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.notices import Tally
from pdr_core.params import DeadReckoningParams
from pdr_core.records import Biases, Floats, Handover, Level, NavBlock, Notice, PoseEstimate, StepEvent
from pdr_core.records_gait import Angle, FieldHeading, GaitStep

UNUSABLE = "strides whose length, turn or deviation is no number: taken as long as the one before, with all its length"
NO_START = "the pose to begin from is no number: dead reckoning goes on from where it was"
KEPT = "no magnetic field told the heading of strides without the gyro: turns in them were guessed; see power.duty"
DOUBTED = "headings of the field that contradict the track: counted less"


class Length(NamedTuple):
    """The length of a stride and how well it is known."""

    m: float
    sd_m: float


class Reckoned(NamedTuple):
    """A step, and the estimates from the one before to it."""

    step: StepEvent
    nav: NavBlock


NO_HEADING = FieldHeading(np.nan, np.nan, np.nan)


class GaitDeadReckoning:
    """Goes on where a filter ended, stride by stride, until another goes on from here."""

    def __init__(self, params: DeadReckoningParams) -> None:
        self._limits = packed(track_limits(params))
        self._scale_sd = params.length_scale_sd
        self._tally = Tally()
        self._memory = fresh(TRACK)
        self._track = self._memory[0]
        self._track["quat_xyzw"][3] = 1.0
        self._biases: Biases | None = None
        self._index = 1

    def begin(self, start: Handover, next_index: int = 1) -> None:
        """Go on from a foot that stands.

        A pose without a quaternion keeps the attitude; one of no numbers is not taken.
        """
        known = [start.pose.position_m, start.pose.covariance.ravel()]
        if not np.isfinite(np.concatenate(known)).all():
            self._tally.add("handover_unusable", Level.ERROR, NO_START, start.stamp_ns)
            return
        track, self._biases, self._index = self._track, start.biases, next_index
        track["stamp_ns"], track["position_m"] = start.stamp_ns, start.pose.position_m
        if start.pose.quat_xyzw is not None:
            track["quat_xyzw"] = start.pose.quat_xyzw
        track["P"] = np.zeros((SIZE, SIZE))
        track["P"][:DEVIATION, :DEVIATION] = start.pose.covariance
        track["P"][SCALE, SCALE] = self._scale_sd**2
        track["deviation"], track["north"] = 0.0, 0.0

    @property
    def handover(self) -> Handover:
        """The estimate, for a filter that goes on from it where the foot stands."""
        track = self._track
        covariance = track["P"][:DEVIATION, :DEVIATION].copy()
        pose = PoseEstimate(track["position_m"].copy(), track["quat_xyzw"].copy(), covariance)
        return Handover(int(track["stamp_ns"]), pose, self._biases)

    @property
    def yaw(self) -> Angle:
        """The heading of the foot."""
        return Angle(yaw_rad(self._track["quat_xyzw"]), sqrt(self._track["P"][YAW, YAW]))

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._tally.notices

    def step(
        self, step: GaitStep, length: Length, turn: Angle, deviation: Angle, heading: FieldHeading | None = None
    ) -> Reckoned:
        """Take a stride: its length, the turn of the foot in it, and the deviation of its behaviour.

        `heading` is the yaw of the foot where it stands now, if anything but the turns tells it.
        """
        told = np.array([*length, *turn, *deviation, *(heading or NO_HEADING)])
        nav, start_ns, displacement_m, covariance_m2, usable, doubted = stride(
            step.start_ns, step.stamp_ns, told, self._limits, self._memory
        )
        if not usable:
            self._tally.add("gait_step_unusable", Level.WARN, UNUSABLE, step.stamp_ns)
        if heading is None:
            self._tally.add("heading_kept", Level.WARN, KEPT, step.stamp_ns)
        if doubted:
            self._tally.add("heading_doubted", Level.WARN, DOUBTED, step.stamp_ns)
        return Reckoned(self._event(step, start_ns, displacement_m, covariance_m2), nav)

    def stand(self, until_ns: int) -> NavBlock:
        """Return the estimates of a foot that stands until a stamp."""
        return stand(until_ns, self._limits, self._memory)

    def take_heading(self, yaw_error_rad: float, yaw_error_sd_rad: float) -> None:
        """Take by how much the track is turned too far now, counter-clockwise, as somebody else knows."""
        take_heading(yaw_error_rad, yaw_error_sd_rad, self._memory)

    def _event(self, step: GaitStep, start_ns: int, displacement_m: Floats, covariance_m2: Floats) -> StepEvent:
        self._index += 1
        yaw = self.yaw
        return StepEvent(
            index=self._index - 1,
            start_ns=start_ns,
            stamp_ns=step.stamp_ns,
            position_m=self._track["position_m"].copy(),
            displacement_m=displacement_m,
            displacement_covariance_m2=covariance_m2,
            yaw_rad=yaw.rad,
            yaw_sd_rad=min(pi, yaw.sd_rad),
            position_covariance_m2=self._track["P"][:TILT, :TILT].copy(),
        )

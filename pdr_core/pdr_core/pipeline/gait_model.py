"""What is learnt of a person's gait while the gyro is on, and what it tells of a stride without it."""

from math import hypot
from typing import NamedTuple

from pdr_core.gait.dead_reckoning import Length
from pdr_core.gait.heading_deviation import HeadingDeviation
from pdr_core.gait.stance_heading import FieldHeading, StanceHeading
from pdr_core.gait.step_length_calibration import StepLength
from pdr_core.gait.turn_suspicion import TurnSuspicion, across_mps
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import Params
from pdr_core.pipeline.gait_watch import SeenStride
from pdr_core.records import StepEvent
from pdr_core.records_gait import Angle, Behaviour, GaitStep


class Told(NamedTuple):
    """What the model says of a stride."""

    length: Length
    turn: Angle
    deviation: Angle
    heading: FieldHeading | None  # of the foot at its end; None: hold it


class GaitModel:
    """Step length, heading deviation, turns and north of one person."""

    def __init__(self, params: Params) -> None:
        self._suspicion_rad = params.dead_reckoning.suspicion_rad
        self._length = StepLength(params.gait)
        self._deviation = HeadingDeviation(params.dead_reckoning)
        self._turns = TurnSuspicion(params.dead_reckoning)
        self._params = params
        self.forget_north()

    def learn(self, stride: SeenStride, measured: StepEvent, before: Angle, after: Angle, north: bool) -> None:
        """Take a stride that the filter has measured, with the yaw of the foot at the stands at its ends.

        `north`: the yaw is good enough to learn from it where the field points.
        """
        gait = stride.step
        self._length.learn(gait, measured.length_m, length_sd_m(measured))
        self._deviation.learn(gait.behaviour, measured, before.rad, after)
        if (across := self._across(stride)) is not None:
            self._turns.learn(across, wrapped_rad(after.rad - before.rad))
        if stride.stand and north:
            self._north.learn(stride.stand, after)

    def deviation(self, behaviour: Behaviour) -> Angle:
        """Return the walking direction less the heading of the foot."""
        return self._deviation.deviation(behaviour)

    def ready(self, step: GaitStep) -> bool:
        """Return whether the model is good for strides like this one."""
        return self._length.ready(step)

    def forget_length(self, step: GaitStep) -> None:
        """Learn the length of strides like this one anew: the model has failed."""
        self._length.forget(step)

    def forget_north(self) -> None:
        """Learn anew where the field points: the world has another heading."""
        self._north = StanceHeading(self._params.filter, self._params.dead_reckoning)

    def length(self, step: GaitStep) -> Length:
        """Return how long the model takes a stride to be."""
        return Length(*self._length.length(step))

    def told(self, stride: SeenStride) -> Told:
        """Return what the model says of a stride. One whose turn is not suspected goes straight ahead."""
        across = self._across(stride)
        turn = self._turns.turn(across)
        if not self._turning(stride, across):
            turn = Angle(0.0, turn.sd_rad)
        return Told(self.length(stride.step), turn, self.deviation(stride.step.behaviour), self.heading(stride))

    def heading(self, stride: SeenStride) -> FieldHeading | None:
        """Return the yaw of the foot at the end of a stride, by the field; None: it tells nothing."""
        return self._north.heading(stride.stand) if stride.stand else None

    def turns(self, stride: SeenStride) -> bool:
        """Return whether the accelerometer lets a turn be suspected, and where it tells nothing, the field does not."""
        return self._turning(stride, self._across(stride))

    def _turning(self, stride: SeenStride, across: float | None) -> bool:
        return self._turns.suspected(across) and not (across is None and self._sees_north(stride))

    def _sees_north(self, stride: SeenStride) -> bool:
        """Return whether a clean field tells the heading of the foot at the end of a stride."""
        return stride.stand is not None and stride.stand.field_seen and self._north.clean

    def turned(self, turn_rad: float) -> bool:
        """Return whether a turn that was measured is one to keep the gyro on for."""
        return abs(turn_rad) > self._suspicion_rad

    def _across(self, stride: SeenStride) -> float | None:
        if stride.stand is None or stride.stand.impulse_mps is None:
            return None
        return across_mps(stride.stand.impulse_mps, self.deviation(stride.step.behaviour).rad)


def length_sd_m(step: StepEvent) -> float:
    """Return the deviation [m] of a stride's length along its own direction."""
    along = step.displacement_m[:2] / max(hypot(*step.displacement_m[:2]), 1e-6)
    return float(along @ step.displacement_covariance_m2[:2, :2] @ along) ** 0.5

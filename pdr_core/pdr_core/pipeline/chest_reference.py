"""What a step of a walk should be: as long as the first ones, or as a model learnt from them says (Cheng eq. 13)."""

from math import atan2, cos, sin

from pdr_core.chest import ChestStep, Wanted
from pdr_core.gait.step_length_calibration import StepLength
from pdr_core.params import ChestParams, GaitParams
from pdr_core.records_gait import Behaviour, GaitStep


class StepReference:
    """Learns from the first uniform steps after each rest, when the solution is fresh; says what the others should be.

    The models are of strides of one foot, two steps of the body: so they learn twice the length of a step, at half its
    frequency.
    """

    def __init__(self, params: ChestParams, gait: GaitParams) -> None:
        self._params = params
        self._model = StepLength(gait)
        self._first = 0  # of them, so far
        self._ahead_m = self._left_m = self._length_m = 0.0  # their sums
        self._after = 0  # uniform steps since the last rest
        self._number = 0

    def __call__(self, step: ChestStep) -> Wanted | None:
        """Return what a step should be; None where nothing is known of it: of a start, a stop, or before all others."""
        self._after = 0 if step.since_rest <= self._params.start_steps else self._after
        if not step.uniform or self._params.step_length == "none":
            return None
        self._after += 1
        if step.speed_known and self._after <= self._params.first_steps:
            self._learn(step)
        if self._first < self._params.first_steps:
            return None
        return self._wanted(step)

    def _learn(self, step: ChestStep) -> None:
        self._first += 1
        self._ahead_m += step.moved_m[0]
        self._left_m += step.moved_m[1]
        self._length_m += step.length_m
        self._model.learn(self._gait_step(step), 2.0 * step.length_m, 2.0 * self._params.step_sd_m)

    def _wanted(self, step: ChestStep) -> Wanted:
        length_m = self._length_m / self._first
        if self._params.step_length == "model":
            length_m = 0.5 * self._model.length(self._gait_step(step))[0]
        ahead_m, left_m = step.moved_m
        if self._params.step_direction == "chest":
            ahead_m, left_m = self._ahead_m, self._left_m
        direction_rad = atan2(left_m, ahead_m)
        return Wanted(length_m * cos(direction_rad), length_m * sin(direction_rad), self._params.step_share)

    def _gait_step(self, step: ChestStep) -> GaitStep:
        self._number += 1
        mean, largest, least, magnitude = step.figures
        return GaitStep(
            index=self._number,
            start_ns=step.start_ns,
            stamp_ns=step.stamp_ns,
            behaviour=Behaviour.WALKING,
            frequency_hz=0.5 / step.duration_s,
            accel_mean_mps2=mean,
            accel_max_mps2=largest,
            accel_min_mps2=least,
            accel_mean_abs_mps2=magnitude,
        )

"""The heading of a chest card by its magnetic field, where the field is clean: by the stage that a foot has for it.

A foot's places are its stands. A chest hardly ever stands, but over a stride its trunk swings about a mean: so each
stride is a place, with the mean force for up and the mean field. While the yaw is known as well as the field could tell
it, places show where the field points; afterwards it tells the yaw, never better than all places are off together.
Where a track was placed, nobody has seen its first yaw: what the field tells is off by as much as that was.
"""

from math import hypot

import numpy as np

from pdr_core.gait.stance_heading import StanceHeading
from pdr_core.gait.stands import Stand
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import Params
from pdr_core.records import NO_SAMPLES, Floats, ImuBlock, StepEvent, joined, length, part
from pdr_core.records_gait import Angle, FieldHeading

GATE = 3.0  # standard deviations by which a heading may differ
LEAST_SAMPLES = 3
KEPT_NS = 4_000_000_000  # two steps, as long as they may be


class ChestCompass:
    """Samples and steps in, yaw errors out."""

    def __init__(self, params: Params, start_sd_rad: float = 0.0) -> None:
        self._used = params.filter.magnetometer == "auto"
        self._start_sd_rad = start_sd_rad  # of the yaw with which the track began
        self._clean_sd_rad = hypot(params.filter.field_heading_sd_rad, start_sd_rad)
        self._north = StanceHeading(params.filter, params.dead_reckoning)
        self._samples: ImuBlock = NO_SAMPLES
        self._before_ns: int | None = None  # the start of the step before
        self.told = 0  # steps whose yaw it has told

    def add(self, imu: ImuBlock) -> None:
        """Take the next samples, before the steps that end in them."""
        if self._used and (imu.field_sd_tesla >= 0.0).any():
            self._samples = joined([self._samples, imu])

    def yaw_error(self, step: StepEvent, level_axes: Floats) -> Angle | None:
        """Return by how much the track is turned too far, counter-clockwise, as the field tells; None: it does not.

        `level_axes`, (3, 3): ahead, left and up of the chest in the sensor's axes; in these the field is looked at,
        since the sensor's own x may point up.
        """
        stand = self._place(step, level_axes)
        if stand is None:
            return None
        if step.yaw_sd_rad <= self._clean_sd_rad and not self.told:  # later the yaw is no better than the field
            self._north.learn(stand, Angle(step.yaw_rad, step.yaw_sd_rad))
            return None
        heading = self._north.heading(stand)
        return self._judged(step, heading) if heading else None

    def _judged(self, step: StepEvent, heading: FieldHeading) -> Angle | None:
        """Return the yaw error, if the field knows more than the estimate and does not contradict it."""
        error_rad = wrapped_rad(step.yaw_rad - heading.rad)
        sd_rad = hypot(heading.sd_rad, self._start_sd_rad)
        likely = abs(error_rad) <= GATE * hypot(step.yaw_sd_rad, sd_rad)
        if step.yaw_sd_rad <= hypot(heading.common_sd_rad, self._start_sd_rad) or not likely:
            return None
        self.told += 1
        return Angle(error_rad, sd_rad)

    def _place(self, step: StepEvent, level_axes: Floats) -> Stand | None:
        """Return the stride that ends with a step as a place; forget what is older."""
        begins_ns, self._before_ns = self._before_ns, step.start_ns
        stamps = self._samples.stamp_ns
        if not len(stamps) or begins_ns is None or not begins_ns < step.start_ns:
            return None
        first, last = np.searchsorted(stamps, [begins_ns, step.stamp_ns])
        stride = part(self._samples, int(first), int(last))
        seen = stride.field_sd_tesla >= 0.0
        if int(seen.sum()) < LEAST_SAMPLES:
            return None
        force, field = stride.accel_mps2.mean(axis=0), stride.field_tesla[seen].mean(axis=0)
        return Stand(step.stamp_ns, level_axes @ force, level_axes @ field, True, None)

    def forget(self) -> None:
        """Keep no samples that no later step needs."""
        if length(self._samples):
            kept_ns = self._samples.stamp_ns[-1] - KEPT_NS
            self._samples = part(self._samples, int(np.searchsorted(self._samples.stamp_ns, kept_ns)))

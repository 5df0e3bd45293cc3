"""What answers the step of a foot: its own heading constraint, and what both feet know together.

Both are independent: the constraint tells of the direction that both feet share, the other foot of their difference. So
where both speak, the answer is their weighted mean.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from pdr_core.fusion.dual_heading import DualHeading
from pdr_core.fusion.shared_yaw import Equivalent, SharedYaw
from pdr_core.heading import HeadingConstraint
from pdr_core.notices import Tally
from pdr_core.params import Params
from pdr_core.records import HeadingObservation, HeadingSource, Notice, StepEvent


class StepAnswers:
    """Answers the steps of one foot or two, which it must be given in order."""

    def __init__(self, params: Params, feet: Sequence[str]) -> None:
        self._tally = Tally()
        self._constraints = {foot: HeadingConstraint(params.heading, self._tally) for foot in feet}
        self._weighs: bool = params.filter.heading_states
        self.dual = DualHeading(params.fusion, feet)
        self._shared = {foot: SharedYaw() for foot in feet}

    def begin(self, foot: str) -> None:
        """Note that a foot's filter begins anew, in another world."""
        self.dual.begin(foot)
        self._shared[foot] = SharedYaw()

    def answer(self, foot: str, step: StepEvent) -> HeadingObservation:
        """Return the answer to the step of a foot."""
        answer = self._constraints[foot].answer(step)
        correction = self._of_both(foot, step)
        if correction:
            answer = merged(answer, correction)
        if answer.source is not HeadingSource.NONE:
            self.dual.turned_back(foot, self._taken_rad(answer, step))
        return answer

    def _of_both(self, foot: str, step: StepEvent) -> Equivalent | None:
        """Return what both feet tell this one, as the measurement that makes it take all of it."""
        correction = self.dual.step(foot, step)
        if correction is None:
            return None
        if not self._weighs:
            return Equivalent(correction.turn_rad, correction.variance_rad2)
        return self._shared[foot].equivalent(correction.turn_rad, correction.variance_rad2, step.yaw_sd_rad**2)

    def _taken_rad(self, answer: HeadingObservation, step: StepEvent) -> float:
        """Return by how much the filter turns its track back: its gain times what it is told, or all of it."""
        yaw_rad2 = step.yaw_sd_rad**2
        gain = yaw_rad2 / (yaw_rad2 + answer.yaw_error_sd_rad**2) if self._weighs else 1.0
        return gain * answer.yaw_error_rad

    @property
    def notices(self) -> list[Notice]:
        """What the constraints have to say."""
        return self._tally.notices


def merged(answer: HeadingObservation, other: Equivalent) -> HeadingObservation:
    """Return an answer that tells both, weighted by their information."""
    told = answer.source is not HeadingSource.NONE
    own = 1.0 / answer.yaw_error_sd_rad**2 if told else 0.0
    information = own + 1.0 / other.variance_rad2
    error_rad = (own * answer.yaw_error_rad + other.turn_rad / other.variance_rad2) / information
    return replace(
        answer,
        source=answer.source if told else HeadingSource.OTHER_FOOT,
        yaw_error_rad=error_rad,
        yaw_error_sd_rad=1.0 / math.sqrt(information),
    )

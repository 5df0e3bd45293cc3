"""`HeadingFusion` of one foot or two, whose answers also say what somebody else knows of the place.

Each foot has a world of its own, and so its own alignment: what their fixes say corrects each where it stands, and the
feet go on telling each other of their heading.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.external.aid import ExternalAid
from pdr_core.external.worlds import ORIGIN_AND_X, from_another, midway
from pdr_core.params import Params
from pdr_core.pipeline.heading_fusion import FusionOutput, HeadingFusion
from pdr_core.records import (
    Floats,
    HeadingObservation,
    HeadingSource,
    NavBlock,
    Notice,
    PositionError,
    StepEvent,
    length,
)
from pdr_core.records_external import ExternalComparison, ExternalFrame, FixBlock


class AidedFusion:
    """Steps and estimates of the feet and somebody else's fixes in, answers and the person's way out."""

    def __init__(self, params: Params, feet: Sequence[str]) -> None:
        self._fusion = HeadingFusion(params, feet)
        self._aids = {foot: ExternalAid(params.external) for foot in feet}
        self._steps: dict[tuple[str, int, int], StepEvent] = {}  # that were not answered yet
        self._last_ns = dict.fromkeys(feet, NO_STAMP)

    def fixes(self, fixes: FixBlock, reached_ns: Mapping[str, int] | None = None) -> None:
        """Take fixes; `reached_ns`: the last stamp of each foot as they came; None: those of the last estimates."""
        for foot, aid in self._aids.items():
            aid.take(fixes, (reached_ns or self._last_ns)[foot])

    def step(self, foot: str, event: StepEvent) -> FusionOutput:
        """Take a step of a foot."""
        self._steps[foot, event.index, event.stamp_ns] = event
        return self._aided(self._fusion.step(foot, event))

    def odometry(self, foot: str, nav: NavBlock) -> FusionOutput:
        """Take the next estimates of a foot, any number of them."""
        self._aids[foot].add(nav)
        self._last_ns[foot] = int(nav.stamp_ns[-1]) if length(nav) else self._last_ns[foot]
        return self._aided(self._fusion.odometry(foot, nav))

    def leave(self, foot: str) -> FusionOutput:
        """Wait for a foot no longer, until it brings something again."""
        return self._aided(self._fusion.leave(foot))

    def finish(self) -> FusionOutput:
        """Return all that waits: there will be no more."""
        return self._aided(self._fusion.finish())

    def placed_m(self, foot: str, position_m: Floats) -> Floats:
        """Return positions (n, 3) of a foot's world in that of the body, as it is known now."""
        return self._fusion.placed_m(foot, position_m)

    @property
    def comparison(self) -> ExternalComparison:
        """The frame of the foot, or of the body midway of both; how far the fixes lie from the first foot's track."""
        found = next(iter(self._aids.values())).comparison
        if len(self._aids) == 1:
            return found
        frames = [
            from_another(aid.frame, self._fusion.placed_m(foot, ORIGIN_AND_X))
            for foot, aid in self._aids.items()
            if aid.frame
        ]
        return replace(found, frame=midway(frames) if frames else None)

    def frame_of(self, foot: str) -> ExternalFrame | None:
        """Return their frame from that of a foot, as it was aligned; None: not known yet."""
        return self._aids[foot].frame

    @property
    def awaited_ns(self) -> dict[str, int]:
        """The feet that hold something back, and the earliest stamp that waits for them."""
        return self._fusion.awaited_ns

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far; what each foot finds in the fixes counts once."""
        of_aids = {notice.kind: notice for aid in reversed(self._aids.values()) for notice in aid.notices}
        return self._fusion.notices + list(of_aids.values())

    def _aided(self, output: FusionOutput) -> FusionOutput:
        return replace(output, answers=[(foot, self._with_place(foot, answer)) for foot, answer in output.answers])

    def _with_place(self, foot: str, answer: HeadingObservation) -> HeadingObservation:
        told = self._aids[foot].answer(self._steps.pop((foot, answer.step_index, answer.step_ns)))
        if told.turn:
            turn_rad, sd_rad = told.turn
            answer = replace(answer, source=HeadingSource.EXTERNAL, yaw_error_rad=turn_rad, yaw_error_sd_rad=sd_rad)
        return replace(answer, position=both_known(answer.position, told.place))


def both_known(one: PositionError | None, other: PositionError | None) -> PositionError | None:
    """Return what two independent measurements of one error say together: their mean weighted by information."""
    if one is None or other is None:
        return one or other
    first, second = np.linalg.inv(one.covariance_m2), np.linalg.inv(other.covariance_m2)
    covariance_m2 = np.linalg.inv(first + second)
    return PositionError(covariance_m2 @ (first @ one.error_m + second @ other.error_m), covariance_m2)

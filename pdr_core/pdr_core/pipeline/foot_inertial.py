"""One foot, one IMU: intake, stance detection, error-state filter."""

from collections.abc import Callable
from dataclasses import dataclass

from pdr_core.eskf import ZuptFilter
from pdr_core.eskf.state import FilterState
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import (
    Floats,
    HeadingObservation,
    HeadingSource,
    ImuBlock,
    NavBlock,
    Notice,
    StanceBlock,
    StepEvent,
    joined,
)
from pdr_core.stance import StanceDetection


@dataclass(frozen=True)
class FootOutput:
    """What became known with a piece of the recording; `judged` and `nav` have the same stamps."""

    judged: StanceBlock
    nav: NavBlock
    steps: list[StepEvent]


Heading = Callable[[StepEvent], HeadingObservation]


def nothing_to_say(step: StepEvent) -> HeadingObservation:
    """Return the empty answer to a step."""
    return HeadingObservation(step.index, step.stamp_ns, step.answer_due_ns, HeadingSource.NONE, 0.0, 0.0)


class FootInertial:
    """Samples in, estimates and steps out. Where the filter asks for heading observations, `heading` gives them.

    `phases_s`: what `stance_phases` has found in a first pass, for the time gate that learns from it.
    """

    def __init__(self, params: Params, heading: Heading = nothing_to_say, phases_s: Floats | None = None) -> None:
        self._intake = Ingestion(params.intake)
        self._stance = StanceDetection(params.stance, params.place, params.detectors, phases_s)
        self._filter = ZuptFilter(params.filter, params.place)
        self._heading = heading

    def run(self, raw: ImuBlock) -> FootOutput:
        """Take the next samples, any number of them."""
        judged = self._stance.run(self._intake.run(raw))
        nav, steps = self._estimated(judged)
        return FootOutput(judged, nav, steps)

    def finish(self) -> FootOutput:
        """Give out what still waits for later samples: there will be none."""
        judged = joined([self._stance.run(self._intake.finish()), self._stance.finish()])
        nav, steps = self._estimated(judged)
        return FootOutput(judged, nav, steps + self._filter.finish())

    def _estimated(self, judged: StanceBlock) -> tuple[NavBlock, list[StepEvent]]:
        """Run the filter, and again with each answer, until nothing waits for one."""
        nav, steps = self._filter.run(judged)
        pieces, unanswered = [nav], steps
        while self._filter.asks and unanswered:
            for step in unanswered:
                self._filter.answer(self._heading(step))
            nav, unanswered = self._filter.resume()
            pieces, steps = [*pieces, nav], steps + unanswered
        return joined(pieces) if len(pieces) > 1 else nav, steps

    @property
    def state(self) -> FilterState:
        """The filter's memory, which it goes on changing."""
        return self._filter.state

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._intake.notices + self._filter.notices

"""One foot, one IMU: intake, stance detection, error-state filter."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from pdr_core.eskf import ZuptFilter
from pdr_core.eskf.output import empty_nav
from pdr_core.eskf.state import FilterState
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import (
    NO_VERDICTS,
    Floats,
    HeadingObservation,
    ImuBlock,
    NavBlock,
    Notice,
    StanceBlock,
    StepEvent,
    empty_answer,
    joined,
    length,
    part,
)
from pdr_core.stance import StanceDetection


@dataclass(frozen=True)
class FootOutput:
    """What became known with a piece of the recording; `judged` and `nav` have the same stamps."""

    judged: StanceBlock
    nav: NavBlock
    steps: list[StepEvent]


Heading = Callable[[StepEvent], HeadingObservation]


class FootInertial:
    """Samples in, estimates and steps out. Where the filter asks for heading observations, `heading` gives them.

    `heading` of None: somebody else gives them, by `answer`. `phases_s`: what `stance_phases` has found in a first
    pass, for the time gate that learns from it.
    """

    def __init__(self, params: Params, heading: Heading | None = empty_answer, phases_s: Floats | None = None) -> None:
        self._intake = Ingestion(params.intake)
        self._stance = StanceDetection(params.stance, params.place, params.detectors, phases_s)
        self._filter = ZuptFilter(params.filter, params.place)
        self._heading = heading
        self._held = NO_VERDICTS  # samples that wait in the filter for an answer
        self._ends = False  # there are no more samples

    def run(self, raw: ImuBlock) -> FootOutput:
        """Take the next samples, any number of them."""
        return self._estimated(self._stance.run(self._intake.run(raw)))

    def finish(self) -> FootOutput:
        """Give out what still waits for later samples: there will be none."""
        self._ends = True
        return self._estimated(joined([self._stance.run(self._intake.finish()), self._stance.finish()]))

    def answer(self, observation: HeadingObservation) -> FootOutput:
        """Take the answer to a step, and go on with the samples that waited for it."""
        self._filter.answer(observation)
        return self._output(*self._filter.resume())

    def _estimated(self, judged: StanceBlock) -> FootOutput:
        self._held = joined([self._held, judged]) if length(self._held) else judged
        return self._output(*self._self_answered(*self._filter.run(judged)))

    def _self_answered(self, nav: NavBlock, steps: list[StepEvent]) -> tuple[NavBlock, list[StepEvent]]:
        """Run the filter again with each answer, until nothing waits for one."""
        pieces, unanswered = [nav], steps
        while self._heading and self._filter.asks and unanswered:
            for step in unanswered:
                self._filter.answer(self._heading(step))
            nav, unanswered = self._filter.resume()
            pieces, steps = [*pieces, nav], steps + unanswered
        return joined(pieces) if len(pieces) > 1 else nav, steps

    def _output(self, nav: NavBlock, steps: list[StepEvent]) -> FootOutput:
        """Return the estimates with their verdicts, and at the end the step that ends in the last stance."""
        done, self._held = part(self._held, 0, length(nav)), part(self._held, length(nav))
        if self._ends and not self._filter.waits:
            self._ends = False
            steps = steps + self._filter.finish()
        return FootOutput(done, nav, steps)

    @property
    def waits(self) -> bool:
        """Samples wait for an answer."""
        return self._filter.waits

    @property
    def state(self) -> FilterState:
        """The filter's memory, which it goes on changing."""
        return self._filter.state

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._intake.notices + self._filter.notices


def together(outputs: Iterable[FootOutput]) -> FootOutput:
    """Return outputs, one after the other, as one."""
    known = [FootOutput(NO_VERDICTS, empty_nav(0), []), *outputs]
    steps = [step for output in known for step in output.steps]
    return FootOutput(joined([output.judged for output in known]), joined([output.nav for output in known]), steps)

"""One foot, one IMU: intake, stance detection, error-state filter."""

from dataclasses import dataclass

from pdr_core.eskf import ZuptFilter
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import ImuBlock, NavBlock, Notice, StanceBlock, StepEvent, joined
from pdr_core.stance import StanceDetection


@dataclass(frozen=True)
class FootOutput:
    """What became known with a piece of the recording; `judged` and `nav` have the same stamps."""

    judged: StanceBlock
    nav: NavBlock
    steps: list[StepEvent]


class FootInertial:
    """Samples in, estimates and steps out."""

    def __init__(self, params: Params) -> None:
        self._intake = Ingestion(params.intake)
        self._stance = StanceDetection(params.stance, params.place)
        self._filter = ZuptFilter(params.filter, params.place)

    def run(self, raw: ImuBlock) -> FootOutput:
        """Take the next samples, any number of them."""
        trusted = self._intake.run(raw)
        judged = self._stance.run(trusted)
        nav, steps = self._filter.run(judged)
        return FootOutput(judged, nav, steps)

    def finish(self) -> FootOutput:
        """Give out what still waits for later samples: there will be none."""
        judged = joined([self._stance.run(self._intake.finish()), self._stance.finish()])
        nav, steps = self._filter.run(judged)
        return FootOutput(judged, nav, steps + self._filter.finish())

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._intake.notices + self._filter.notices

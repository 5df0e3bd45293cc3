"""One foot, one IMU, offline: as `foot_inertial`, but every estimate knows the whole recording."""

from collections.abc import Callable, Iterator

from pdr_core.eskf.configure import settings
from pdr_core.eskf.smoother import SEGMENT, Smoother
from pdr_core.eskf.state import FilterState
from pdr_core.params import Params
from pdr_core.pipeline.foot_inertial import FootInertial, FootOutput
from pdr_core.records import Floats, ImuBlock, Notice, StepEvent, length, part


class SmoothedFoot:
    """Samples in; when all are in, estimates and steps out. The filter's decisions and its count of steps stand."""

    def __init__(self, params: Params, phases_s: Floats | None = None) -> None:
        self._forward = FootInertial(params, phases_s=phases_s)
        self._smoother = Smoother(settings(params.filter, params.place))
        self.steps: list[StepEvent] = []  # so far, as the filter had them at the time

    def run(self, raw: ImuBlock) -> None:
        """Take the next samples, any number of them."""
        for start in range(0, length(raw), SEGMENT):
            before = self._forward.state.copy()
            self._keep(before, self._forward.run(part(raw, start, start + SEGMENT)))

    def finish(self, seen: Callable[[float], object] = bool) -> Iterator[FootOutput]:
        """Yield the smoothed estimates and steps, in order; `seen` is told the share of the work that is done."""
        before = self._forward.state.copy()
        self._keep(before, self._forward.finish())
        for judged, nav, steps in self._smoother.smoothed(self._forward.state, self.steps, seen):
            yield FootOutput(judged, nav, steps)

    def _keep(self, before: FilterState, output: FootOutput) -> None:
        self._smoother.keep(before, output.judged)
        self.steps += output.steps

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._forward.notices

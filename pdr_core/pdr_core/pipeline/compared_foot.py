"""One foot offline beside what somebody else says of the person's place, which it is not told."""

from pdr_core.conventions import NO_STAMP
from pdr_core.external.map_points import compared_with
from pdr_core.params import Params
from pdr_core.pipeline.constrained_foot import ConstrainedFoot
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.rate_limit import RateLimit
from pdr_core.records import ImuBlock, Notice, length
from pdr_core.records_external import ExternalComparison, FixBlock


class ComparedFoot(ConstrainedFoot):
    """Samples and fixes in, in the order in which they came; estimates and steps out as without the fixes."""

    def __init__(self, params: Params) -> None:
        super().__init__(params)
        self._limit = RateLimit(params.node.odom_rate_hz)
        self._comparing = compared_with(params.external)
        self._reached_ns = NO_STAMP

    def fixes(self, fixes: FixBlock) -> None:
        """Take fixes that came after the samples so far."""
        self._comparing.take(fixes, self._reached_ns)

    def run(self, raw: ImuBlock) -> FootOutput:
        """Take the next samples, any number of them."""
        self._reached_ns = int(raw.stamp_ns[-1]) if length(raw) else self._reached_ns
        return self._seen(super().run(raw))

    def finish(self) -> FootOutput:
        """Give out what still waits: there will be no more samples."""
        output = self._seen(super().finish())
        self._comparing.finish()
        return output

    def _seen(self, output: FootOutput) -> FootOutput:
        self._comparing.add(self._limit.thinned(output.nav))
        return output

    @property
    def comparison(self) -> ExternalComparison:
        """How our track and theirs compare so far."""
        return self._comparing.comparison

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return super().notices + self._comparing.notices

"""One foot offline whose steps are answered by what somebody else knows of the person's place, as the nodes do it."""

from pdr_core.conventions import NO_STAMP
from pdr_core.params import Params, changed
from pdr_core.pipeline.aided_fusion import AidedFusion
from pdr_core.pipeline.foot_inertial import FootInertial, FootOutput
from pdr_core.pipeline.heading_fusion import together
from pdr_core.rate_limit import RateLimit
from pdr_core.records import ImuBlock, Notice, StanceBlock, joined, length
from pdr_core.records_external import ExternalComparison, ExternalFrame, FixBlock

FOOT = "foot"


class AidedFoot:
    """Samples and fixes in, in the order in which they came; estimates and steps out."""

    def __init__(self, params: Params) -> None:
        asking = changed(params, "filter", heading_feedback=True)
        self._foot = FootInertial(asking, heading=None)
        self._limit = RateLimit(params.node.odom_rate_hz)
        self._fusion = AidedFusion(asking, (FOOT,))
        self._reached_ns = NO_STAMP

    def fixes(self, fixes: FixBlock) -> None:
        """Take fixes that came after the samples so far."""
        self._fusion.fixes(fixes, {FOOT: self._reached_ns})

    def run(self, raw: ImuBlock) -> FootOutput:
        """Take the next samples, any number of them."""
        self._reached_ns = int(raw.stamp_ns[-1]) if length(raw) else self._reached_ns
        return self._answered(self._foot.run(raw))

    def finish(self) -> FootOutput:
        """Give out what still waits: there will be no more samples."""
        output = self._answered(self._foot.finish())
        self._fusion.finish()
        return output

    def _answered(self, output: FootOutput) -> FootOutput:
        """Tell what the foot has found, and the foot what is answered, until nothing more follows."""
        outputs, new = [], [output]
        while new:
            outputs += new
            told = together([piece for output in new for piece in self._told(output)])
            new = [self._foot.answer(answer) for _, answer in told.answers]
        judged: list[StanceBlock] = [one.judged for one in outputs]
        steps = [step for one in outputs for step in one.steps]
        return FootOutput(joined(judged), joined([one.nav for one in outputs]), steps)

    def _told(self, output: FootOutput) -> list:
        steps = [self._fusion.step(FOOT, step) for step in output.steps]
        return [*steps, self._fusion.odometry(FOOT, self._limit.thinned(output.nav))]

    @property
    def frame(self) -> ExternalFrame | None:
        """Their frame from ours; None: not known yet."""
        return self._fusion.comparison.frame

    @property
    def comparison(self) -> ExternalComparison:
        """The frame, and how far their fixes lie from the track."""
        return self._fusion.comparison

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._foot.notices + self._fusion.notices

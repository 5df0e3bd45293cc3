"""Two feet offline beside what somebody else says of the person's place, which they are not told."""

from collections.abc import Sequence

from pdr_core.conventions import NO_STAMP
from pdr_core.external.map_points import compared_with
from pdr_core.external.worlds import ORIGIN_AND_X, from_another, seen_back
from pdr_core.params import Params
from pdr_core.pipeline.both_feet import BODY, BothFeet, BothOutput
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.records import ImuBlock, NavBlock, Notice, length
from pdr_core.records_external import ExternalComparison, ExternalFrame, FixBlock


class ComparedFeet(BothFeet):
    """`BothFeet`, whose body is laid beside the fixes, in the order in which they came; it changes nothing."""

    def __init__(self, params: Params, feet: Sequence[str] = ("left", "right")) -> None:
        super().__init__(params, feet)
        self._comparing = compared_with(params.external)
        self._first = feet[0]  # whose clock is that of the body
        self._reached_ns = NO_STAMP

    def fixes(self, fixes: FixBlock) -> None:
        """Take fixes that came after the samples so far."""
        self._comparing.take(fixes, self._reached_ns)

    def run(self, foot: str, raw: ImuBlock) -> BothOutput:
        """Take the next samples of a foot, any number of them."""
        if foot == self._first and length(raw):
            self._reached_ns = int(raw.stamp_ns[-1])
        return super().run(foot, raw)

    def finish(self) -> BothOutput:
        """Give out what still waits: there will be no more samples of either foot."""
        output = super().finish()
        self._comparing.finish()
        return output

    def _known(self, feet: list[tuple[str, FootOutput]], body: NavBlock) -> BothOutput:
        self._comparing.add(body)
        return super()._known(feet, body)

    @property
    def comparison(self) -> ExternalComparison:
        """How the track of the body and theirs compare so far."""
        return self._comparing.comparison

    def frame_of(self, foot: str) -> ExternalFrame | None:
        """Return their frame from that of a foot, by where that lies in the body's; None: not known yet."""
        frame = self.comparison.frame
        return from_another(frame, seen_back(self.placed_m(foot, ORIGIN_AND_X))) if frame else None

    @property
    def notices(self) -> dict[str, list[Notice]]:
        """What was wrong so far, with each foot and, under the name "body", with both and beside them."""
        found = super().notices
        return found | {BODY: found[BODY] + self._comparing.notices}

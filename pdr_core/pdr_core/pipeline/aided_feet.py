"""Two feet offline whose steps are answered by each other and by what somebody else knows of the person's place."""

from collections.abc import Sequence

from pdr_core.conventions import NO_STAMP
from pdr_core.params import Params, changed
from pdr_core.pipeline.aided_fusion import AidedFusion
from pdr_core.pipeline.both_feet import BothFeet, BothOutput
from pdr_core.records import ImuBlock, length
from pdr_core.records_external import ExternalComparison, ExternalFrame, FixBlock


class AidedFeet(BothFeet):
    """Samples of both feet and fixes in, in the order in which they came; estimates of both and of the body out."""

    def __init__(self, params: Params, feet: Sequence[str] = ("left", "right")) -> None:
        self._aided = AidedFusion(changed(params, "filter", heading_feedback=True), feet)
        super().__init__(params, feet, self._aided)
        self._reached_ns = dict.fromkeys(feet, NO_STAMP)  # each on its own clock

    def fixes(self, fixes: FixBlock) -> None:
        """Take fixes that came after the samples so far."""
        self._aided.fixes(fixes, self._reached_ns)

    def run(self, foot: str, raw: ImuBlock) -> BothOutput:
        """Take the next samples of a foot, any number of them."""
        if length(raw):
            self._reached_ns[foot] = int(raw.stamp_ns[-1])
        return super().run(foot, raw)

    @property
    def comparison(self) -> ExternalComparison:
        """Their frame from that of the body, and how far their fixes lie from the track of the first foot."""
        return self._aided.comparison

    def frame_of(self, foot: str) -> ExternalFrame | None:
        """Return their frame from that of a foot; None: not known yet."""
        return self._aided.frame_of(foot)

"""Two feet offline: the chain of each, and the fusion that answers their steps."""

from collections.abc import Sequence
from dataclasses import dataclass

from pdr_core.fusion.foot_rows import NO_ROWS
from pdr_core.params import Params, changed
from pdr_core.pipeline.aided_fusion import AidedFusion
from pdr_core.pipeline.foot_inertial import FootInertial, FootOutput
from pdr_core.pipeline.heading_fusion import FusionOutput, HeadingFusion
from pdr_core.pipeline.heading_fusion import together as together_told
from pdr_core.rate_limit import RateLimit
from pdr_core.records import Floats, ImuBlock, NavBlock, Notice, joined, length

BODY = "body"


@dataclass(frozen=True)
class BothOutput:
    """What became known: of each foot, in order, and of the body between them."""

    feet: list[tuple[str, FootOutput]]
    body: NavBlock


class BothFeet:
    """Samples of a left and a right foot in, in this order of names; estimates of both and of the body out.

    The fusion gets as many estimates a second as the nodes tell, so that it finds the same. The feet wait for each
    other: feed them in turn by their stamps, in pieces, and memory stays bounded.
    """

    def __init__(
        self, params: Params, feet: Sequence[str] = ("left", "right"), fusion: HeadingFusion | AidedFusion | None = None
    ) -> None:
        asking = changed(params, "filter", heading_feedback=True)
        self._feet = {name: FootInertial(asking, heading=None) for name in feet}
        self._limits = {name: RateLimit(params.node.odom_rate_hz) for name in feet}
        self._fusion = fusion or HeadingFusion(asking, feet)
        self._ended: set[str] = set()  # feet without more samples, of which some may still wait for an answer

    def run(self, foot: str, raw: ImuBlock) -> BothOutput:
        """Take the next samples of a foot, any number of them."""
        return self._answered([(foot, self._feet[foot].run(raw))])

    def end(self, foot: str) -> BothOutput:
        """Take it that a foot has no more samples: the other one goes on without it."""
        self._ended.add(foot)
        return self._answered([(foot, self._feet[foot].finish())])

    def finish(self) -> BothOutput:
        """Give out what still waits: there will be no more samples of either foot."""
        ends = [self.end(foot) for foot in self._feet if foot not in self._ended]
        last = self._known([], self._fusion.finish().body)  # feet that have ended wait for no answer
        return together([*ends, last])

    def placed_m(self, foot: str, position_m: Floats) -> Floats:
        """Return positions (n, 3) of a foot's world in that of the body, as it is known now."""
        return self._fusion.placed_m(foot, position_m)

    @property
    def notices(self) -> dict[str, list[Notice]]:
        """What was wrong so far, with each foot and, under the name "body", with both."""
        return {name: foot.notices for name, foot in self._feet.items()} | {BODY: self._fusion.notices}

    def _answered(self, new: list[tuple[str, FootOutput]]) -> BothOutput:
        """Tell the fusion what the feet have found, and the feet what it answers, until nothing more follows."""
        outputs = []
        while new:
            told = together_told([self._told(foot, output) for foot, output in new])
            outputs.append(self._known(new, told.body))
            new = [(foot, self._feet[foot].answer(answer)) for foot, answer in told.answers]
        return together(outputs)

    def _known(self, feet: list[tuple[str, FootOutput]], body: NavBlock) -> BothOutput:
        """Return what became known; it passes here once."""
        return BothOutput(feet, body)

    def _told(self, foot: str, output: FootOutput) -> FusionOutput:
        told = [self._fusion.step(foot, step) for step in output.steps]
        told.append(self._fusion.odometry(foot, self._limits[foot].thinned(output.nav)))
        if foot in self._ended and not self._feet[foot].waits:
            told.append(self._fusion.leave(foot))
        return together_told(told)


def together(outputs: list[BothOutput]) -> BothOutput:
    """Return several outputs as one."""
    bodies = [output.body for output in outputs if length(output.body)]
    return BothOutput([foot for output in outputs for foot in output.feet], joined(bodies) if bodies else NO_ROWS)

"""Node `heading_fusion`: `step` and `odom` of one or two feet in; an answer to every step and the person's `odom` out.

The topics of a foot are in the namespace that `node.feet` names, those of the person one level up: `left/odom` is the
left foot's, `odom` the person's. `initialpose` and `reset_estimate` put the person elsewhere, and leave the feet in
their own worlds.
"""

from functools import partial
from typing import ClassVar

from pdr_core.params import Params
from pdr_core.pipeline import AidedFusion, FusionOutput, HeadingFusion, PlacedBody
from pdr_core.records import Level, NavBlock, Notice, StepEvent
from pdr_core.warmup import warm_up
from pdr_nodes.foot_topics import FootTopics, foot_names
from pdr_nodes.managed import ManagedNode
from pdr_nodes.patience import Patience
from pdr_nodes.person import Person
from pdr_nodes.placing import Placing
from pdr_nodes.run import run

PERIOD_S = 0.05
LAST_WORDS_S = 0.05  # what a node has said that has ended may have come and not been seen


class HeadingFusionNode(ManagedNode):
    """Hosts heading constraint and fusion of the feet of one person."""

    NAME = "heading_fusion"
    GROUPS: ClassVar[tuple[str, ...]] = ("heading", "fusion", "node")
    PLACES = True  # the person where somebody says

    def set_up(self, params: Params) -> None:
        """Take steps and estimates of the feet, answer the steps, tell of the person."""
        warm_up(params, both=True)
        node, names = params.node, foot_names(params.node.feet)
        self._fusion = self.make_fusion(params, names)
        self._person = Person(self, node)
        self._placed = PlacedBody()
        self._placing = Placing(self, node.world_frame, self._placed.place) if self.PLACES else None
        self._feet = {name: FootTopics(self, name, node.world_frame, self._stepped, self._moved) for name in names}
        for name in names:
            self._wait_for(name, node.foot_patience_s)
        self.tell("person", self._notices)

    def make_fusion(self, params: Params, feet: tuple[str, ...]) -> HeadingFusion | AidedFusion:
        """Return what answers the steps."""
        return HeadingFusion(params, feet)

    def _stepped(self, foot: str, step: StepEvent) -> None:
        self._say(self._fusion.step(foot, step))

    def _moved(self, foot: str, nav: NavBlock) -> None:
        self._say(self._fusion.odometry(foot, nav))

    def _wait_for(self, foot: str, while_s: float) -> None:
        """Wait for a foot no longer that has ended, once its last words are heard, or that lets wait for too long."""
        for so_long_s, waits in ((while_s, self._awaited_ns), (LAST_WORDS_S, self._awaits_in_vain)):
            patience = Patience(so_long_s, partial(waits, foot), partial(self._go_on_without, foot))
            self.every(PERIOD_S, patience.look)

    def _awaited_ns(self, foot: str) -> int | None:
        return self._fusion.awaited_ns.get(foot)

    def _awaits_in_vain(self, foot: str) -> bool:
        return foot in self._fusion.awaited_ns and self._feet[foot].has_ended

    def _go_on_without(self, foot: str) -> None:
        self._say(self._fusion.leave(foot))

    def _say(self, output: FusionOutput) -> None:
        for foot, answer in output.answers:
            self._feet[foot].answer(answer)
        self._person.publish(self._placed.run(output.body))

    def _notices(self) -> list[Notice]:
        of_feet = [notice for foot in self._feet.values() for notice in foot.notices]
        of_placing = self._placing.notices if self._placing else []
        return [*self._fusion.notices, *of_feet, *self._same_frame(), *of_placing]

    def _same_frame(self) -> list[Notice]:
        frames = [foot.frame for foot in self._feet.values()]
        if len(set(frames)) == len(frames):
            return []
        text = f"both feet call themselves {frames[0]!r}: give each a node.foot_frame of its own"
        return [Notice(Level.WARN, "same_foot_frame", text, 1, 0)] if frames[0] else []


def main() -> None:
    """Run the node."""
    run(HeadingFusionNode)


if __name__ == "__main__":
    main()

"""Node `zupt_ekf`: samples with verdicts in (`stance`); `odom`, `step`, `handover`, `filter_health` and perhaps tf out.

Where `filter.heading_feedback` says so, each step waits for its `heading_observation`.
"""

from pdr_core.eskf import ZuptFilter
from pdr_core.params import Params
from pdr_core.records import Handover, NavBlock, PoseEstimate, StanceBlock, StepEvent
from pdr_core.warmup import warm_up
from pdr_msgs.msg import Handover as HandoverMessage
from pdr_msgs.msg import HeadingObservation, StanceImu
from pdr_nodes.convert import stance_block
from pdr_nodes.convert_feedback import handover_message, heading_observation
from pdr_nodes.hearing import Hearing
from pdr_nodes.managed import ManagedNode
from pdr_nodes.patience import Patience
from pdr_nodes.placing import Placing
from pdr_nodes.qos import ANSWERS
from pdr_nodes.run import run
from pdr_nodes.track_output import TrackOutput

PATIENCE_PERIOD_S = 0.05


class ZuptEkfNode(ManagedNode):
    """Hosts the filter of one foot."""

    NAME = "zupt_ekf"
    GROUPS = ("filter", "place", "node")

    def set_up(self, params: Params) -> None:
        """Take verdicts, give estimates, steps and health."""
        warm_up()
        self._filter = ZuptFilter(params.filter, params.place)
        self._track = TrackOutput(self, params.node, params.node.foot_frame, self._filter)
        self._handover = self.output(HandoverMessage, "handover")
        self._placing = Placing(self, params.node.world_frame, self._place)
        self.input(StanceImu, "stance", stance_block, self._take)
        if params.filter.heading_feedback:
            self._wait_for_answers(params.node.answer_timeout_s)
        # twice the time after which the stance detector gives out its last samples, so that none comes after the step
        self._ends = False  # no sample has come for long, but the filter may have some that wait
        self.when_idle(2.0 * params.node.idle_s, self._finish)
        self.tell("track", lambda: self._filter.notices + self._placing.notices)

    def _wait_for_answers(self, while_s: float) -> None:
        self.part(Hearing(self, HeadingObservation, "heading_observation", self._answered, ANSWERS))
        self.every(PATIENCE_PERIOD_S, Patience(while_s, lambda: self._filter.waits, self._go_on_unanswered).look)

    def _take(self, block: StanceBlock) -> None:
        self._ends = False
        self._publish(*self._filter.run(block))

    def _answered(self, message: HeadingObservation) -> None:
        self._filter.answer(heading_observation(message))
        self._publish(*self._filter.resume())

    def _go_on_unanswered(self) -> None:
        self._filter.give_up_answers()
        self._publish(*self._filter.resume())

    def _finish(self) -> None:
        self._ends = True
        self._publish_end()

    def _publish(self, nav: NavBlock, steps: list[StepEvent]) -> None:
        self._track.estimates(nav)
        self._publish_steps(steps)
        self._publish_end()

    def _publish_end(self) -> None:
        """Publish the step that ends in the last stance, once nothing waits any more."""
        if self._ends and not self._filter.waits:
            self._ends = False
            self._publish_steps(self._filter.finish())

    def _publish_steps(self, steps: list[StepEvent]) -> None:
        for step, handover in zip(steps, self._filter.handovers, strict=True):
            self._track.step(step)
            self._handover.publish(handover_message(handover, *self._track.frames))

    def _place(self, pose: PoseEstimate, keep_biases: bool) -> None:
        now = self._filter.handover
        self._filter.reset(Handover(now.stamp_ns, pose, now.biases if keep_biases else None))


def main() -> None:
    """Run the node."""
    run(ZuptEkfNode)


if __name__ == "__main__":
    main()

"""Node `zupt_ekf`: samples with verdicts in (`stance`); `odom`, `step`, `handover`, `filter_health` and perhaps tf out.

Where `filter.heading_feedback` says so, each step waits for its `heading_observation`.
"""

from nav_msgs.msg import Odometry

from pdr_core.eskf import ZuptFilter
from pdr_core.params import Params
from pdr_core.records import Handover, NavBlock, StanceBlock
from pdr_core.records import StepEvent as Step
from pdr_core.warmup import warm_up
from pdr_msgs.msg import FilterHealth, HeadingObservation, StanceImu, StepEvent
from pdr_msgs.msg import Handover as HandoverMessage
from pdr_msgs.srv import ResetEstimate
from pdr_nodes.convert import odometry_message, pose_estimate, stance_block, step_message
from pdr_nodes.convert_feedback import handover_message, heading_observation
from pdr_nodes.convert_health import health_message
from pdr_nodes.hearing import Hearing
from pdr_nodes.managed import ManagedNode
from pdr_nodes.patience import Patience
from pdr_nodes.qos import ANSWERS, STATUS
from pdr_nodes.rate_limit import RateLimit
from pdr_nodes.run import run
from pdr_nodes.transforms import TransformBroadcaster

HEALTH_PERIOD_S = 1.0
PATIENCE_PERIOD_S = 0.05


class ZuptEkfNode(ManagedNode):
    """Hosts the filter of one foot."""

    NAME = "zupt_ekf"
    GROUPS = ("filter", "place", "node")

    def set_up(self, params: Params) -> None:
        """Take verdicts, give estimates, steps and health."""
        warm_up()
        self._frames = params.node.world_frame, params.node.foot_frame
        self._filter = ZuptFilter(params.filter, params.place)
        self._limit = RateLimit(params.node.odom_rate_hz)
        self._odom = self.sole_output(Odometry, "odom")
        self._tf = TransformBroadcaster(self) if params.node.publish_tf else None
        self._steps = self.output(StepEvent, "step")
        self._handover = self.output(HandoverMessage, "handover")
        self._health = self.output(FilterHealth, "filter_health", STATUS)
        self.every(HEALTH_PERIOD_S, self._publish_health)
        self.service(ResetEstimate, "reset_estimate", self._reset)
        self.input(StanceImu, "stance", stance_block, self._take)
        if params.filter.heading_feedback:
            self._wait_for_answers(params.node.answer_timeout_s)
        # twice the time after which the stance detector gives out its last samples, so that none comes after the step
        self.when_idle(2.0 * params.node.idle_s, lambda: self._publish_steps(self._filter.finish()))
        self.tell("track", lambda: self._filter.notices)

    def _wait_for_answers(self, while_s: float) -> None:
        self.part(Hearing(self, HeadingObservation, "heading_observation", self._answered, ANSWERS))
        self.every(PATIENCE_PERIOD_S, Patience(while_s, lambda: self._filter.waits, self._go_on_unanswered).look)

    def _take(self, block: StanceBlock) -> None:
        self._publish(*self._filter.run(block))

    def _answered(self, message: HeadingObservation) -> None:
        self._filter.answer(heading_observation(message))
        self._publish(*self._filter.resume())

    def _go_on_unanswered(self) -> None:
        self._filter.give_up_answers()
        self._publish(*self._filter.resume())

    def _publish(self, nav: NavBlock, steps: list[Step]) -> None:
        self._publish_estimates(nav)
        self._publish_steps(steps)

    def _publish_estimates(self, nav: NavBlock) -> None:
        for i in self._limit.allowed(nav.stamp_ns):
            odometry = odometry_message(nav, i, *self._frames)
            self._odom.publish(odometry)
            if self._tf:
                self._tf.send(odometry)

    def _publish_steps(self, steps: list[Step]) -> None:
        for step, handover in zip(steps, self._filter.handovers, strict=True):
            self._steps.publish(step_message(step, *self._frames))
            self._handover.publish(handover_message(handover, *self._frames))

    def _publish_health(self) -> None:
        if self._filter.health.samples:
            self._health.publish(health_message(self._filter.health, self._filter.notices, *self._frames))

    def _reset(self, request: ResetEstimate.Request, response: ResetEstimate.Response) -> ResetEstimate.Response:
        try:
            pose, now = pose_estimate(request.pose), self._filter.handover
            self._filter.reset(Handover(now.stamp_ns, pose, now.biases if request.keep_biases else None))
        except ValueError as error:
            response.success, response.message = False, str(error)
        else:
            response.success, response.message = True, "the estimate starts anew with the next sample"
        return response


def main() -> None:
    """Run the node."""
    run(ZuptEkfNode)


if __name__ == "__main__":
    main()

"""Node `zupt_ekf`: samples with verdicts in (`stance`); `odom`, `step`, `filter_health` and perhaps tf out."""

from nav_msgs.msg import Odometry

from pdr_core.eskf import ZuptFilter
from pdr_core.params import Params
from pdr_core.records import NavBlock, StanceBlock
from pdr_core.records import StepEvent as Step
from pdr_core.warmup import warm_up
from pdr_msgs.msg import FilterHealth, StanceImu, StepEvent
from pdr_msgs.srv import ResetEstimate
from pdr_nodes.convert import health_message, odometry_message, pose_of_reset, stance_block, step_message
from pdr_nodes.managed import ManagedNode
from pdr_nodes.qos import STATUS
from pdr_nodes.rate_limit import RateLimit
from pdr_nodes.run import run
from pdr_nodes.transforms import TransformBroadcaster

HEALTH_PERIOD_S = 1.0


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
        self._health = self.output(FilterHealth, "filter_health", STATUS)
        self.every(HEALTH_PERIOD_S, self._publish_health)
        self.service(ResetEstimate, "reset_estimate", self._reset)
        self.input(StanceImu, "stance", stance_block, self._take)
        # twice the time after which the stance detector gives out its last samples, so that none comes after the step
        self.when_idle(2.0 * params.node.idle_s, lambda: self._publish_steps(self._filter.finish()))
        self.tell("track", lambda: self._filter.notices)

    def _take(self, block: StanceBlock) -> None:
        nav, steps = self._filter.run(block)
        self._publish_estimates(nav)
        self._publish_steps(steps)

    def _publish_estimates(self, nav: NavBlock) -> None:
        for i in self._limit.allowed(nav.stamp_ns):
            odometry = odometry_message(nav, i, *self._frames)
            self._odom.publish(odometry)
            if self._tf:
                self._tf.send(odometry)

    def _publish_steps(self, steps: list[Step]) -> None:
        for step in steps:
            self._steps.publish(step_message(step, *self._frames))

    def _publish_health(self) -> None:
        if self._filter.health.samples:
            self._health.publish(health_message(self._filter.health, self._filter.notices, *self._frames))

    def _reset(self, request: ResetEstimate.Request, response: ResetEstimate.Response) -> ResetEstimate.Response:
        try:
            self._filter.reset(pose_of_reset(request), request.keep_biases)
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

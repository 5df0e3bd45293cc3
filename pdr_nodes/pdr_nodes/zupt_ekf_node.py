"""Node `zupt_ekf`: samples with verdicts in (`stance`); `odom`, `step`, `filter_health` and perhaps tf out."""

from nav_msgs.msg import Odometry
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node

from pdr_core.eskf import ZuptFilter
from pdr_core.records import Handover, length
from pdr_core.records import StepEvent as Step
from pdr_core.warmup import warm_up
from pdr_msgs.msg import FilterHealth, StanceImu, StepEvent
from pdr_msgs.srv import ResetEstimate
from pdr_nodes.convert import health_message, odometry_message, pose_estimate, stamp_ns, stance_block, step_message
from pdr_nodes.declare import read_params
from pdr_nodes.idle import IdleWatch
from pdr_nodes.notice_board import NoticeBoard
from pdr_nodes.qos import OWN, STATUS
from pdr_nodes.repeats import Repeats
from pdr_nodes.run import run
from pdr_nodes.transforms import TransformBroadcaster

HEALTH_PERIOD_S = 1.0


class ZuptEkfNode(Node):
    """Hosts the filter of one foot."""

    def __init__(self) -> None:
        super().__init__("zupt_ekf", automatically_declare_parameters_from_overrides=True)
        params = read_params(self, ("filter", "place", "node"))
        warm_up()
        self._frames = params.node.world_frame, params.node.foot_frame
        self._filter = ZuptFilter(params.filter, params.place)
        self._odom = self.create_publisher(Odometry, "odom", OWN)
        self._step = self.create_publisher(StepEvent, "step", OWN)
        self._health = self.create_publisher(FilterHealth, "filter_health", STATUS)
        self._tf = TransformBroadcaster(self) if params.node.publish_tf else None
        self._board = NoticeBoard(self, "track", lambda: self._filter.notices)
        # twice the time after which the stance detector gives out its last samples, so that none comes after the step
        self._idle = IdleWatch(self, 2.0 * params.node.idle_s, lambda: self._publish_steps(self._filter.finish()))
        self._health_timer = self.create_timer(HEALTH_PERIOD_S, self._publish_health)
        self._reset_service = self.create_service(ResetEstimate, "reset_estimate", self._reset)
        self._repeats = Repeats()
        events = SubscriptionEventCallbacks(matched=self._repeats.matched)
        self.create_subscription(StanceImu, "stance", self._take, OWN, event_callbacks=events)

    def _take(self, message: StanceImu) -> None:
        self._idle.fed()
        if self._repeats.has(stamp_ns(message.imu.header.stamp)):
            return
        nav, steps = self._filter.run(stance_block(message))
        for i in range(length(nav)):
            odometry = odometry_message(nav, i, *self._frames)
            self._odom.publish(odometry)
            if self._tf:
                self._tf.send(odometry)
        self._publish_steps(steps)

    def _publish_steps(self, steps: list[Step]) -> None:
        for step in steps:
            self._step.publish(step_message(step, *self._frames))

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

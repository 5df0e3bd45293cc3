"""What a node says that follows a track: `odom`, `step`, now and then `filter_health`, and perhaps the transform."""

from typing import Protocol

from nav_msgs.msg import Odometry

from pdr_core import records
from pdr_core.params import NodeParams
from pdr_core.rate_limit import RateLimit
from pdr_core.records import NavBlock, Notice
from pdr_msgs.msg import FilterHealth, StepEvent
from pdr_nodes.convert import odometry_message, step_message
from pdr_nodes.convert_health import health_message
from pdr_nodes.managed import ManagedNode
from pdr_nodes.qos import STATUS
from pdr_nodes.transforms import TransformBroadcaster

HEALTH_PERIOD_S = 1.0


class Follower(Protocol):
    """What follows the track."""

    @property
    def health(self) -> records.FilterHealth:
        """How far it can be trusted now."""

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""


class TrackOutput:
    """Publishes the track of a frame in the world, at no more than `node.odom_rate_hz`."""

    def __init__(self, node: ManagedNode, params: NodeParams, child_frame: str, follower: Follower) -> None:
        self.frames = params.world_frame, child_frame
        self._follower = follower
        self._limit = RateLimit(params.odom_rate_hz)
        self._odom = node.sole_output(Odometry, "odom")
        self._tf = TransformBroadcaster(node) if params.publish_tf else None
        self._steps = node.output(StepEvent, "step")
        self._health = node.output(FilterHealth, "filter_health", STATUS)
        node.every(HEALTH_PERIOD_S, self._publish_health)

    def estimates(self, nav: NavBlock) -> None:
        """Publish those estimates of a block that are due."""
        for i in self._limit.allowed(nav.stamp_ns):
            odometry = odometry_message(nav, i, *self.frames)
            self._odom.publish(odometry)
            if self._tf:
                self._tf.send(odometry)

    def step(self, step: records.StepEvent) -> None:
        """Publish a step."""
        self._steps.publish(step_message(step, *self.frames))

    def _publish_health(self) -> None:
        health = self._follower.health
        if health.samples:
            self._health.publish(health_message(health, self._follower.notices, *self.frames))

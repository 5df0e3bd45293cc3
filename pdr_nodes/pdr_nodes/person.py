"""What is said of the person, between the feet: odometry, transform and path."""

from collections import deque

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry, Path

from pdr_core.conventions import NO_STAMP
from pdr_core.params import NodeParams
from pdr_core.rate_limit import RateLimit
from pdr_core.records import NavBlock, length
from pdr_nodes.convert import odometry_message, stamp_ns
from pdr_nodes.managed import ManagedNode
from pdr_nodes.qos import LATEST
from pdr_nodes.transforms import TransformBroadcaster


class Person:
    """Publishes `odom` and `path` in the node's own namespace, one level above the feet, and perhaps the transform."""

    def __init__(self, node: ManagedNode, params: NodeParams) -> None:
        self._frames = params.world_frame, params.base_frame
        self._odom = node.sole_output(Odometry, "odom")
        self._tf = TransformBroadcaster(node) if params.publish_base_tf else None
        self._path = PersonPath(node, params)

    def publish(self, body: NavBlock) -> None:
        """Publish all estimates of a block."""
        for i in range(length(body)):
            odometry = odometry_message(body, i, *self._frames)
            self._odom.publish(odometry)
            if self._tf:
                self._tf.send(odometry)
            self._path.add(odometry)


class PersonPath:
    """Publishes the last places, now and then; where a clock jumps back the path begins anew."""

    def __init__(self, node: ManagedNode, params: NodeParams) -> None:
        self._publisher = node.output(Path, "path", LATEST)
        self._limit = RateLimit(params.path_rate_hz)
        self._places: deque[PoseStamped] = deque(maxlen=params.path_places)
        self._latest_ns = NO_STAMP

    def add(self, odometry: Odometry) -> None:
        """Take a place; publish the path if it is time."""
        at_ns = stamp_ns(odometry.header.stamp)
        if at_ns < self._latest_ns:
            self._places.clear()
        self._latest_ns = at_ns
        if self._limit.allows(at_ns):
            self._places.append(PoseStamped(header=odometry.header, pose=odometry.pose.pose))
            self._publisher.publish(Path(header=odometry.header, poses=list(self._places)))

"""Broadcasts odometry as a transform on /tf, without tf2_ros: that is not everywhere, its message is."""

from nav_msgs.msg import Odometry
from rclpy.qos import QoSProfile
from tf2_msgs.msg import TFMessage

from pdr_nodes.convert import transform_message
from pdr_nodes.managed import ManagedNode


class TransformBroadcaster:
    """Publishes world -> foot as tf2's own broadcaster does."""

    def __init__(self, node: ManagedNode) -> None:
        self._publisher = node.output(TFMessage, "/tf", QoSProfile(depth=100))

    def send(self, odometry: Odometry) -> None:
        """Publish the pose of an odometry message."""
        self._publisher.publish(TFMessage(transforms=[transform_message(odometry)]))

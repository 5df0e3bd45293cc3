"""A topic on which others answer what a node asks: told once, to those who listen then."""

from collections.abc import Callable

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription

ANSWERS = QoSProfile(
    history=HistoryPolicy.KEEP_LAST,
    depth=1000,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.VOLATILE,
)


class AnswerInput:
    """Subscribed to while the node is active."""

    def __init__(self, node: Node, kind: type, topic: str, take: Callable) -> None:
        self._node, self._kind, self._topic, self._take = node, kind, topic, take
        self._subscription: Subscription | None = None

    def begin(self) -> None:
        """Subscribe; answers of the past are to questions of the past."""
        self._subscription = self._node.create_subscription(self._kind, self._topic, self._take, ANSWERS)

    def end(self) -> None:
        """Subscribe no more."""
        if self._subscription:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

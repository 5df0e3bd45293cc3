"""A topic that is heard message by message, while its node is active."""

from collections.abc import Callable

from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription


class Hearing:
    """Subscribed to between `begin` and `end`; `raw` messages come as serialised bytes."""

    def __init__(self, node: Node, kind: type, topic: str, take: Callable, qos: QoSProfile, raw: bool = False) -> None:
        self._node, self._kind, self._topic, self._take, self._qos, self._raw = node, kind, topic, take, qos, raw
        self._subscription: Subscription | None = None

    @property
    def publishers(self) -> int:
        """How many publish what is heard."""
        return self._subscription.get_publisher_count() if self._subscription else 0

    def begin(self) -> None:
        """Subscribe."""
        self._subscription = self._node.create_subscription(
            self._kind, self._topic, self._take, self._qos, raw=self._raw
        )

    def end(self) -> None:
        """Subscribe no more."""
        if self._subscription:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

"""A topic whose first listener may come a moment after the first message: that is volatile, and must not be missed."""

from collections import deque
from typing import Any

from rclpy.qos import QoSProfile

from pdr_nodes.managed import ManagedNode

LOOK_S = 0.05


class HeldOutput:
    """Publishes in order; what is said before anybody listens waits for him."""

    def __init__(self, node: ManagedNode, kind: type, topic: str, qos: QoSProfile) -> None:
        self._publisher = node.output(kind, topic, qos)
        self._waiting: deque[Any] = deque(maxlen=qos.depth)
        node.every(LOOK_S, self._send)

    def publish(self, message: Any) -> None:
        """Publish a message, now or when somebody listens."""
        self._waiting.append(message)
        self._send()

    def _send(self) -> None:
        while self._waiting and self._publisher.get_subscription_count():
            self._publisher.publish(self._waiting.popleft())

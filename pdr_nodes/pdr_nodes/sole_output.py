"""A topic that only one node at a time may publish."""

from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher

from pdr_core.records import Level, Notice
from pdr_nodes import publishers
from pdr_nodes.qos import OWN

LAST_WORDS = Duration(seconds=1)  # what subscribers have to take the last messages


class SoleOutput:
    """Publishes while its node is active, and then only is it a publisher of the topic: so others see who owns it."""

    def __init__(self, node: Node, kind: type, topic: str) -> None:
        self._node, self._kind, self._topic = node, kind, topic
        self._publisher: Publisher | None = None

    def begin(self) -> None:
        """Own the topic."""
        self._publisher = self._node.create_publisher(self._kind, self._topic, OWN)

    def end(self) -> None:
        """Give it up, once the subscribers have what was said."""
        if self._publisher:
            self._publisher.wait_for_all_acked(LAST_WORDS)
            self._node.destroy_publisher(self._publisher)
            self._publisher = None

    def publish(self, message: Any) -> None:
        """Publish a message, unless the node is inactive."""
        if self._publisher:
            self._publisher.publish(message)

    @property
    def notices(self) -> list[Notice]:
        """An error where another node publishes the topic too."""
        others = publishers.names(self._node, self._topic) if self._publisher else []
        me = self._node.get_fully_qualified_name()
        if me in others:
            others.remove(me)
        if not others:
            return []
        topic, names = self._node.resolve_topic_name(self._topic), ", ".join(others)
        text = f"another node publishes {topic} too: {names}; only one may: end one, or give it a namespace of its own"
        return [Notice(Level.ERROR, "not_alone", text, 1, 0)]

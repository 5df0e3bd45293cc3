"""A timer that runs only while its node is active."""

from collections.abc import Callable

from rclpy.node import Node


class Timer:
    """Calls again and again between `begin` and `end`."""

    def __init__(self, node: Node, period_s: float, call: Callable[[], None]) -> None:
        self._node = node
        self._period_s = period_s
        self._call = call
        self._timer = None

    def begin(self) -> None:
        """Start; the first call comes after one period."""
        self._timer = self._node.create_timer(self._period_s, self._call)

    def end(self) -> None:
        """Stop."""
        if self._timer:
            self._node.destroy_timer(self._timer)
            self._timer = None

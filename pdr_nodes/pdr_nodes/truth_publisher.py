"""Publishes where the sensor really was, for those who record or judge the run."""

from geometry_msgs.msg import PoseStamped

from pdr_core.records import Truth, TruthKind
from pdr_nodes.convert import point_message
from pdr_nodes.managed import ManagedNode


class TruthPublisher:
    """Publishes `ground_truth`, where the device knows positions."""

    def __init__(self, node: ManagedNode, truth: Truth | None) -> None:
        self._truth = truth if truth and truth.kind is TruthKind.POSITION else None
        self._next = 0
        self._publisher = node.output(PoseStamped, "ground_truth") if self._truth else None

    def publish_until(self, stamp_ns: int) -> None:
        """Publish the rows up to a stamp."""
        if not self._truth or not self._publisher:
            return
        while self._next < len(self._truth.stamp_ns) and self._truth.stamp_ns[self._next] <= stamp_ns:
            row = self._next
            message = point_message(int(self._truth.stamp_ns[row]), self._truth.position_m[row], "ground_truth")
            self._publisher.publish(message)
            self._next += 1

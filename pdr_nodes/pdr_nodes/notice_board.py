"""Tells people what is wrong: once in the log, and every second on /diagnostics."""

from collections.abc import Callable

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from pdr_core.records import Level, Notice
from pdr_nodes.qos import STATUS

PERIOD_S = 1.0


class NoticeBoard:
    """Publishes the notices of a stage; REP-107 names it `node: what`."""

    def __init__(self, node: Node, what: str, notices: Callable[[], list[Notice]]) -> None:
        self._node = node
        self._name = f"{node.get_fully_qualified_name().lstrip('/')}: {what}"
        self._notices = notices
        self._told: set[str] = set()
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", STATUS)
        self._timer = node.create_timer(PERIOD_S, self._publish)

    def _publish(self) -> None:
        notices = self._notices()
        for notice in notices:
            self._log_once(notice)
        message = DiagnosticArray(status=[self._status(notices)])
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)

    def _log_once(self, notice: Notice) -> None:
        if notice.kind in self._told:
            return
        self._told.add(notice.kind)
        if notice.level is Level.ERROR:
            self._node.get_logger().error(notice.text)
        else:
            self._node.get_logger().warning(notice.text)

    def _status(self, notices: list[Notice]) -> DiagnosticStatus:
        worst = max(notices, key=lambda n: n.level.value, default=None)
        status = DiagnosticStatus(name=self._name, message=worst.text if worst else "as it should be")
        status.level = bytes([worst.level.value if worst else 0])
        status.values = [KeyValue(key=n.kind, value=f"{n.count} x {n.text}") for n in notices]
        return status


def notices_from(status: DiagnosticStatus) -> list[Notice]:
    """Return the notices of a status that a board has published."""
    level = Level(status.level[0] if isinstance(status.level, bytes) else status.level)
    found = []
    for item in status.values:
        count, _, text = item.value.partition(" x ")
        found.append(Notice(level, item.key, text, int(count), 0))
    return found

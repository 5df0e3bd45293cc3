"""Tells people what is wrong: once in the log, and every second on /diagnostics."""

from collections.abc import Callable, Iterable

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from pdr_core.records import Level, Notice
from pdr_nodes.qos import STATUS

PERIOD_S = 1.0
NO_INPUT, NO_FIELD = "no_input", "no_field"  # the kinds of notice that also the end of a recording brings
NO_DRIVER = "no_driver"  # so does this
LIFECYCLE, STREAMS = "lifecycle", "streams"
ORIENTATION = "orientation"  # what is said of it is not said of the track
Source = Callable[[], list[Notice]]


class NoticeBoard:
    """Publishes the state of a node and the notices of its sources; REP-107 names each status `node: what`."""

    def __init__(self, node: Node, state: Callable[[], str], streams: Source) -> None:
        self._node = node
        self._state = state
        self._streams = streams
        self.sources: dict[str, Source] = {}
        self._told: set[str] = set()
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", STATUS)
        self._timer = node.create_timer(PERIOD_S, self._publish)

    def _publish(self) -> None:
        found = {what: notices() for what, notices in ({STREAMS: self._streams} | self.sources).items()}
        self._log_new([notice for notices in found.values() for notice in notices])
        statuses = [status(self._name(LIFECYCLE), [], self._state())]
        statuses += [status(self._name(what), notices, "as it should be") for what, notices in found.items()]
        message = DiagnosticArray(status=statuses)
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)

    def _name(self, what: str) -> str:
        return f"{self._node.get_fully_qualified_name().lstrip('/')}: {what}"

    def _log_new(self, notices: list[Notice]) -> None:
        """Log what was not there a moment ago."""
        for notice in notices:
            if notice.kind not in self._told:
                self._log(notice)
        self._told = {notice.kind for notice in notices}

    def _log(self, notice: Notice) -> None:
        """Log a notice; rclpy wants a place in the code for each severity."""
        log = self._node.get_logger()
        if notice.level is Level.ERROR:
            log.error(notice.text)
        elif notice.level is Level.WARN:
            log.warning(notice.text)
        else:
            log.info(notice.text)


def status(name: str, notices: list[Notice], message_without: str) -> DiagnosticStatus:
    """Return notices as one status: the worst gives level and message, the values hold all of every one."""
    worst = max(notices, key=lambda n: n.level.value, default=Notice(Level.OK, "", message_without, 0, 0))
    out = DiagnosticStatus(name=name, message=worst.text, level=bytes([worst.level.value]))
    out.values = [value for notice in notices for value in values(notice)]
    return out


def values(notice: Notice) -> list[KeyValue]:
    """Return a notice as values `kind.field`."""
    said = {"text": notice.text, "level": notice.level.name, "count": notice.count, "since": notice.first_stamp_ns}
    return [KeyValue(key=f"{notice.kind}.{field}", value=str(value)) for field, value in said.items()]


def notices_from(values: Iterable[KeyValue]) -> list[Notice]:
    """Return the notices that the values of a status hold."""
    found: dict[str, dict[str, str]] = {}
    for item in values:
        kind, _, field = item.key.partition(".")
        found.setdefault(kind, {})[field] = item.value
    return [
        Notice(Level[said["level"]], kind, said["text"], int(said["count"]), int(said["since"]))
        for kind, said in found.items()
    ]

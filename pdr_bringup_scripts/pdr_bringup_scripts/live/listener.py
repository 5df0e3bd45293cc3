"""Listens to a running chain: records its topics and keeps the latest of each."""

import importlib
from collections.abc import Callable, Mapping
from pathlib import Path

import rclpy
from ament_index_python.packages import get_package_share_directory
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rclpy.signals import SignalHandlerOptions

from pdr_core.recording.bag_writer import BagWriter
from pdr_nodes.qos import ANSWERS, MODES, OWN, STATUS

OF_A_SENSOR = {
    "imu/data_raw": "sensor_msgs/msg/Imu",
    "imu/mag": "sensor_msgs/msg/MagneticField",
    "ground_truth": "geometry_msgs/msg/PoseStamped",
    "odom": "nav_msgs/msg/Odometry",
    "step": "pdr_msgs/msg/StepEvent",
    "filter_health": "pdr_msgs/msg/FilterHealth",
}
OF_A_FOOT = OF_A_SENSOR | {"stance": "pdr_msgs/msg/StanceImu"}
OF_A_SWITCHED_FOOT = {"walk": "pdr_msgs/msg/WalkStatus", "mode": "pdr_msgs/msg/NavigationMode"}
OF_A_PERSON = {"odom": "nav_msgs/msg/Odometry"}
OF_ALL = {"diagnostics": "diagnostic_msgs/msg/DiagnosticArray"}
# the last parts of topics that go on while there are no samples
STATUS_TOPICS = ("filter_health", "diagnostics", "mode")
QOS = {"filter_health": STATUS, "diagnostics": STATUS, "mode": MODES, "walk": ANSWERS}  # by the last part; others: OWN


class Listener(Node):
    """Subscribes to everything that the nodes of a namespace say; `take` gets each message with its topic."""

    def __init__(self, take: Callable[[str, str, bytes], None], namespace: str, topics: Mapping[str, str]) -> None:
        super().__init__("pdr_listener", namespace=f"/{namespace}")
        for topic, name in topics.items():
            qos = QOS.get(topic.rpartition("/")[2], OWN)
            address = "/diagnostics" if topic == "diagnostics" else topic
            self.create_subscription(message_class(name), address, self._to(take, topic, name), qos, raw=True)

    @staticmethod
    def _to(take: Callable[[str, str, bytes], None], topic: str, name: str) -> Callable[[bytes], None]:
        return lambda cdr: take(topic, name, cdr)


class Ears:
    """A context manager around a listener, spun by `listen`."""

    def __init__(self, take: Callable[[str, str, bytes], None], namespace: str, topics: Mapping[str, str]) -> None:
        self._take = take
        self._namespace = namespace
        self._topics = topics

    def __enter__(self) -> "Ears":
        """Join the graph."""
        rclpy.init(signal_handler_options=SignalHandlerOptions.NO)  # Ctrl-C is ours
        self._executor = EventsExecutor()
        self.node = Listener(self._take, self._namespace, self._topics)
        self._executor.add_node(self.node)
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the graph."""
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.try_shutdown()

    def listen(self, timeout_s: float) -> None:
        """Serve what comes within a time."""
        self._executor.spin_once(timeout_sec=timeout_s)


def is_status(topic: str) -> bool:
    """Tell whether a topic goes on while there are no samples."""
    return topic.rpartition("/")[2] in STATUS_TOPICS


def message_class(name: str) -> type:
    """Return the class of 'package/msg/Name'."""
    package, _, message = name.split("/")
    return getattr(importlib.import_module(f"{package}.msg"), message)


def message(name: str, cdr: bytes) -> object:
    """Return serialised bytes as a message."""
    return deserialize_message(cdr, message_class(name))


def bag_writer(path: Path) -> BagWriter:
    """Return a writer that knows our own messages."""
    return BagWriter(path, own_definitions())


def own_definitions() -> dict[str, str]:
    """Return the texts of our own messages by type."""
    folder = Path(get_package_share_directory("pdr_msgs")) / "msg"
    return {f"pdr_msgs/msg/{p.stem}": p.read_text() for p in sorted(folder.glob("*.msg"))}

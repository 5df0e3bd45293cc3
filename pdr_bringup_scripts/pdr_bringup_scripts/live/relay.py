"""Hears a driver and passes on what it says: our nodes and the recording get exactly the same samples."""

import os
import time
from collections.abc import Callable
from typing import NamedTuple

from rclpy.node import Node
from sensor_msgs.msg import Imu, MagneticField

from pdr_bringup_scripts.live.cast import below
from pdr_nodes.qos import OWN, driver_input

IMU, MAG = "sensor_msgs/msg/Imu", "sensor_msgs/msg/MagneticField"
INPUT, MAG_INPUT = (
    "imu/data_raw",
    "imu/mag",
)  # in the namespace of the foot, and in the recording
SHOWN = 12


class DriverTopics(NamedTuple):
    """Where a driver publishes, from the root."""

    imu: str
    mag: str  # empty: nowhere
    reliable: bool  # a driver of ours, which loses nothing; others are heard whatever their delivery


class Relay:
    """Subscribes once: a second subscriber of a best-effort driver might begin, end or lose samples elsewhere."""

    def __init__(
        self, node: Node, topics: DriverTopics, take: Callable[[str, str, bytes], None], foot: str = ""
    ) -> None:
        self._node = node
        self._input, self._mag_input = below(foot, INPUT), below(foot, MAG_INPUT)
        self.topics = topics
        self._take = take
        self._closed = False
        self.first_s: float | None = None  # when the first sample came
        self.lacks_field = bool(topics.mag)  # a field is expected and none has come yet
        self._publisher = node.create_publisher(Imu, self._input, OWN)
        qos = driver_input(topics.reliable)
        node.create_subscription(Imu, topics.imu, self._pass_on, qos, raw=True)
        if topics.mag:
            self._fields = node.create_publisher(MagneticField, self._mag_input, OWN)
            node.create_subscription(MagneticField, topics.mag, self._pass_field_on, qos, raw=True)

    def close(self) -> None:
        """Take nothing more."""
        self._closed = True

    def why_silent(self) -> str:
        """Return in a sentence why nothing may have come."""
        infos = self._node.get_publishers_info_by_topic(self.topics.imu)
        types = sorted({info.topic_type for info in infos})
        start = f"no messages on {self.topics.imu} yet: "
        if types and IMU not in types:
            return f"{start}it is published as {', '.join(types)}, not as {IMU}"
        if types:
            return f"{start}its publisher is there but sends nothing, check the sensor"
        domain = os.environ.get("ROS_DOMAIN_ID", "0")
        reach = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "")
        graph = f"in ROS domain {domain}, discovery range {reach}"
        if found := self._imu_topics():
            return f"{start}nobody publishes it {graph}; {IMU} is published on {', '.join(found[:SHOWN])}"
        return f"{start}nobody publishes any {IMU} {graph}; start the driver, or set the variables as it has them"

    def _imu_topics(self) -> list[str]:
        """Return the topics on which others publish samples."""
        own = self._node.get_namespace().rstrip("/") + "/"
        topics = [name for name, types in self._node.get_topic_names_and_types() if IMU in types]
        return [name for name in topics if self._node.count_publishers(name) and not name.startswith(own)]

    def _pass_on(self, cdr: bytes) -> None:
        if self._closed:
            return
        if self.first_s is None:
            self.first_s = time.monotonic()
        self._publisher.publish(cdr)
        self._take(self._input, IMU, cdr)

    def _pass_field_on(self, cdr: bytes) -> None:
        if not self._closed:
            self.lacks_field = False
            self._fields.publish(cdr)
            self._take(self._mag_input, MAG, cdr)

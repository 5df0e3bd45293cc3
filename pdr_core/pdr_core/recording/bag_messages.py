"""Decodes the messages of a bag, over all its files; what cannot be read is a notice."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.recording.bag_storage import Storage
from pdr_core.recording.session import put_warning
from pdr_core.records import ImuBlock, Notice, Truth, TruthKind


@dataclass(frozen=True)
class BagReader:
    """The files of a bag in their order, and where to tell what could not be read."""

    storages: list[Storage]
    notices: list[Notice]

    def topics(self) -> dict[str, str]:
        """Return the message type of every topic."""
        return {topic: msgtype for storage in self.storages for topic, msgtype in storage.topics.items()}

    def messages(self, topic: str) -> Iterator[Any]:
        """Yield the messages of a topic that can be read, decoded."""
        from rosbags.typesys import Stores, get_typestore

        decode, msgtype = get_typestore(Stores.ROS2_JAZZY).deserialize_cdr, self.topics()[topic]
        unreadable, last_stamp_ns = 0, 0
        for cdr in self._raw(topic):
            message = _decoded(decode, cdr, msgtype)
            if message is not None:
                last_stamp_ns = stamp_ns(message)
                yield message
                continue
            unreadable += 1
            text = f"{topic}: messages that cannot be decoded were left out."
            put_warning(self.notices, "unreadable_message", text, unreadable, last_stamp_ns)

    def _raw(self, topic: str) -> Iterator[bytes]:
        for storage in self.storages:
            yield from self._raw_from(storage, topic)

    def _raw_from(self, storage: Storage, topic: str) -> Iterator[bytes]:
        try:
            yield from storage.messages(topic)
        except Exception as error:  # a damaged file makes its reader raise anything
            reason = str(error) or type(error).__name__
            text = f"{storage.path.name} is damaged: {topic} was read up to there, the rest is lost ({reason})."
            put_warning(self.notices, "damaged_recording", text, 1, 0)


def _decoded(decode: Callable[[bytes, str], Any], cdr: bytes, msgtype: str) -> Any:
    """Return the message, None if its bytes are damaged."""
    try:
        return decode(cdr, msgtype)
    except Exception:  # damaged bytes make rosbags raise anything
        return None


def stamp_ns(message: Any) -> int:
    """Return the header stamp of a message [ns]."""
    return message.header.stamp.sec * NANOSECONDS + message.header.stamp.nanosec


def imu_block(messages: list[Any]) -> ImuBlock:
    """Return sensor_msgs/Imu messages as a block. A quantity whose covariance starts with -1 was not measured."""
    stamps = np.array([stamp_ns(m) for m in messages], np.int64)
    gyro = np.array([(v.x, v.y, v.z) for v in (m.angular_velocity for m in messages)])
    accel = np.array([(v.x, v.y, v.z) for v in (m.linear_acceleration for m in messages)])
    no_gyro = np.array([m.angular_velocity_covariance[0] for m in messages]) == -1.0
    no_accel = np.array([m.linear_acceleration_covariance[0] for m in messages]) == -1.0
    gyro[no_gyro], accel[no_accel] = 0.0, 0.0
    return ImuBlock(stamps, gyro, accel, -1.0 * no_gyro, -1.0 * no_accel)


def position_truth(messages: list[Any]) -> Truth:
    """Return Odometry, PoseStamped or PointStamped messages as truth."""
    points = [_point(m) for m in messages]
    position_m = np.array([(p.x, p.y, p.z) for p in points]).reshape(-1, 3)
    return Truth(TruthKind.POSITION, np.array([stamp_ns(m) for m in messages], np.int64), position_m)


def _point(message: Any) -> Any:
    if hasattr(message, "point"):
        return message.point
    pose = message.pose
    return pose.position if hasattr(pose, "position") else pose.pose.position

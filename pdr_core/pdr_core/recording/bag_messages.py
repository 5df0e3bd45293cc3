"""Decodes the messages of a bag, over all its files; what cannot be read is a notice."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.recording.bag_storage import Storage
from pdr_core.recording.imu_cdr import imu_block_from_cdr
from pdr_core.recording.session import put_warning
from pdr_core.records import ImuBlock, Notice, Truth, TruthKind, joined


@dataclass(frozen=True)
class BagReader:
    """The files of a bag in their order, and where to tell what could not be read."""

    storages: list[Storage]
    notices: list[Notice]

    def topics(self) -> dict[str, str]:
        """Return the message type of every topic."""
        return {topic: msgtype for storage in self.storages for topic, msgtype in storage.topics.items()}

    def imu_blocks(self, topic: str, max_samples: int) -> Iterator[ImuBlock]:
        """Yield the samples of a sensor_msgs/Imu topic, at most `max_samples` at a time."""
        messages = self._raw(topic)
        unreadable, last_stamp_ns = 0, 0
        while piece := list(islice(messages, max_samples)):
            blocks = _blocks(piece)
            if missing := len(piece) - sum(len(b.stamp_ns) for b in blocks):
                unreadable += missing
                self._tell_unreadable(topic, unreadable, last_stamp_ns)
            if blocks:
                last_stamp_ns = int(blocks[-1].stamp_ns[-1])
                yield joined(blocks)

    def position_truth(self, topic: str) -> Truth:
        """Return the Odometry, PoseStamped or PointStamped messages of a topic as truth."""
        from rosbags.typesys import Stores, get_typestore

        decode, msgtype = get_typestore(Stores.ROS2_JAZZY).deserialize_cdr, self.topics()[topic]
        decoded = [_decoded(decode, cdr, msgtype) for cdr in self._raw(topic)]
        messages = [m for m in decoded if m is not None]
        if len(messages) < len(decoded):
            self._tell_unreadable(topic, len(decoded) - len(messages), 0)
        stamps = [m.header.stamp.sec * NANOSECONDS + m.header.stamp.nanosec for m in messages]
        points = [(p.x, p.y, p.z) for p in map(_point, messages)]
        return Truth(TruthKind.POSITION, np.array(stamps, np.int64), np.array(points, np.float64).reshape(-1, 3))

    def _tell_unreadable(self, topic: str, count: int, near_ns: int) -> None:
        text = f"{topic}: messages that cannot be decoded were left out."
        put_warning(self.notices, "unreadable_message", text, count, near_ns)

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


def _blocks(messages: list[bytes]) -> list[ImuBlock]:
    """Return the messages in one block where they are alike, else those that can be decoded one by one."""
    whole = imu_block_from_cdr(messages)
    single = [whole] if whole else [imu_block_from_cdr([message]) for message in messages]
    return [block for block in single if block]


def _decoded(decode: Callable[[bytes, str], Any], cdr: bytes, msgtype: str) -> Any:
    """Return the message, None if its bytes are damaged."""
    try:
        return decode(cdr, msgtype)
    except Exception:  # damaged bytes make rosbags raise anything
        return None


def _point(message: Any) -> Any:
    if hasattr(message, "point"):
        return message.point
    pose = message.pose
    return pose.position if hasattr(pose, "position") else pose.pose.position

"""Decodes the messages of a bag, over all its files; what cannot be read is a notice."""

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any, TypeVar

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.field_pairing import FieldPairing
from pdr_core.recording.imu_cdr import imu_block_from_cdr
from pdr_core.recording.mag_cdr import field_block_from_cdr
from pdr_core.recording.session import put_warning
from pdr_core.recording.storage import Storage
from pdr_core.records import ImuBlock, Level, Notice, Truth, TruthKind, joined, length, part

FIELD_WAIT_NS = NANOSECONDS  # by so much a magnetometer may have been recorded later than its inertial sensor
AT_ONCE = 512  # messages, at least, where two topics are read
Decoded = TypeVar("Decoded", bound=tuple)


@dataclass
class Count:
    """What was met of a topic so far."""

    unreadable: int = 0
    last_stamp_ns: int = 0


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
        messages, count = self.messages_of([topic]), Count()
        while piece := list(islice(messages, max_samples)):
            yield from self._blocks([cdr for _, cdr in piece], imu_block_from_cdr, topic, count)

    def paired_blocks(self, topic: str, field_topic: str, max_samples: int) -> Iterator[ImuBlock]:
        """Yield the samples of a sensor_msgs/Imu topic with the field of a sensor_msgs/MagneticField topic."""
        messages, pairing = self.messages_of([topic, field_topic]), FieldPairing(FIELD_WAIT_NS)
        count, field_count = Count(), Count()
        while piece := list(islice(messages, max(max_samples, AT_ONCE))):
            cdr = {t: [raw for name, raw in piece if name == t] for t in (topic, field_topic)}
            for field in self._blocks(cdr[field_topic], field_block_from_cdr, field_topic, field_count):
                pairing.take_field(*field)
            for block in self._blocks(cdr[topic], imu_block_from_cdr, topic, count):
                yield from _cut(pairing.run(block), max_samples)
            self._tell_of_pairing(field_topic, pairing)
        yield from _cut(pairing.finish(), max_samples)

    def position_truth(self, topic: str) -> Truth:
        """Return the Odometry, PoseStamped or PointStamped messages of a topic as truth."""
        from rosbags.typesys import Stores, get_typestore

        decode, msgtype = get_typestore(Stores.ROS2_JAZZY).deserialize_cdr, self.topics()[topic]
        decoded = [_decoded(decode, cdr, msgtype) for _, cdr in self.messages_of([topic])]
        messages = [m for m in decoded if m is not None]
        if len(messages) < len(decoded):
            self.tell_unreadable(topic, len(decoded) - len(messages), 0)
        stamps = [m.header.stamp.sec * NANOSECONDS + m.header.stamp.nanosec for m in messages]
        points = [(p.x, p.y, p.z) for p in map(_point, messages)]
        return Truth(TruthKind.POSITION, np.array(stamps, np.int64), np.array(points, np.float64).reshape(-1, 3))

    def tell_unreadable(self, topic: str, count: int, near_ns: int) -> None:
        """Note that messages of a topic could not be decoded."""
        text = f"{topic}: messages that cannot be decoded were left out."
        put_warning(self.notices, "unreadable_message", text, count, near_ns)

    def _tell_of_pairing(self, topic: str, pairing: FieldPairing) -> None:
        for n in pairing.notices:
            if n.level is not Level.OK:
                put_warning(self.notices, n.kind, f"{topic}: {n.text}.", n.count, n.first_stamp_ns)

    def _blocks(
        self, messages: list[bytes], decode: Callable[[list[bytes]], Decoded | None], topic: str, count: Count
    ) -> Iterator[Decoded]:
        """Yield messages in one block, as far as they can be decoded; those that cannot are counted."""
        blocks = _decoded_blocks(messages, decode) if messages else []
        if missing := len(messages) - sum(map(length, blocks)):
            count.unreadable += missing
            self.tell_unreadable(topic, count.unreadable, count.last_stamp_ns)
        if blocks:
            count.last_stamp_ns = int(blocks[-1][0][-1])
            yield joined(blocks)

    def messages_of(self, topics: Collection[str]) -> Iterator[tuple[str, bytes]]:
        """Yield topic and bytes of the messages of these topics, in the order of the files."""
        for storage in self.storages:
            yield from self._raw_from(storage, topics)

    def _raw_from(self, storage: Storage, topics: Collection[str]) -> Iterator[tuple[str, bytes]]:
        try:
            yield from storage.messages(topics)
        except Exception as error:  # a damaged file makes its reader raise anything
            reason = str(error) or type(error).__name__
            what = " with ".join(topics)
            text = f"{storage.path.name} is damaged: {what} was read up to there, the rest is lost ({reason})."
            put_warning(self.notices, "damaged_recording", text, 1, 0)


def _decoded_blocks(messages: list[bytes], decode: Callable[[list[bytes]], Decoded | None]) -> list[Decoded]:
    """Return the messages in one block where they are alike, else those that can be decoded one by one."""
    whole = decode(messages)
    single = [whole] if whole else [decode([message]) for message in messages]
    return [block for block in single if block]


def _cut(block: ImuBlock, max_samples: int) -> Iterator[ImuBlock]:
    """Yield the samples, at most `max_samples` at a time."""
    for start in range(0, length(block), max_samples):
        yield part(block, start, start + max_samples)


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

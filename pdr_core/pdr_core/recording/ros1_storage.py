"""ROS 1 bags, lz4 and bz2 included: their messages come out as ROS 2 would have written them."""

from collections.abc import Collection, Iterator
from pathlib import Path

from pdr_core.recording.session import RecordingError
from pdr_core.recording.storage import Storage

SUFFIX = ".bag"


def ros1_storage(path: Path) -> Storage:
    """Open the file by its index; RecordingError without one."""
    from rosbags.rosbag1 import Reader, ReaderError
    from rosbags.typesys import Stores, get_typestore

    def messages(topics: Collection[str]) -> Iterator[tuple[str, bytes]]:
        to_cdr = get_typestore(Stores.ROS2_JAZZY).ros1_to_cdr  # leaves out what only ROS 1 has: the header's `seq`
        with Reader(path) as reader:
            connections = [c for c in reader.connections if c.topic in topics]
            for connection, _, raw in reader.messages(connections=connections):
                yield connection.topic, bytes(to_cdr(raw, connection.msgtype))

    try:
        with Reader(path) as reader:
            return Storage(path, {c.topic: c.msgtype for c in reader.connections}, messages)
    except ReaderError as error:
        raise RecordingError(f"{path} is no whole ROS 1 bag ({error}): repair it with `rosbag reindex`.") from error

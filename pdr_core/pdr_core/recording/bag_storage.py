"""The files of a bag, by topic: through their index where it can be read, and as far as they go where it cannot."""

from collections.abc import Collection, Iterator
from pathlib import Path

from pdr_core.recording.mcap_salvage import salvaged_mcap
from pdr_core.recording.ros1_storage import SUFFIX as ROS1
from pdr_core.recording.ros1_storage import ros1_storage
from pdr_core.recording.sqlite_salvage import ends_within_page, salvaged_sqlite
from pdr_core.recording.storage import Storage

SUFFIXES = {".mcap": "mcap", ".db3": "sqlite3"}


def open_storage(path: Path) -> Storage:
    """Open a bag file, or a directory that must be read as a whole, whatever its state; nothing readable: no topics."""
    if path.suffix == ROS1:
        return ros1_storage(path)
    if path.suffix == ".db3" and ends_within_page(path):
        return salvaged_sqlite(path)
    try:
        return _indexed(path)
    except Exception:  # a damaged file makes rosbags raise anything
        return salvaged_mcap(path) if path.suffix == ".mcap" else salvaged_sqlite(path)


def _indexed(path: Path) -> Storage:
    from rosbags.rosbag2 import Reader

    def messages(topics: Collection[str]) -> Iterator[tuple[str, bytes]]:
        with Reader(path) as reader:
            connections = [c for c in reader.connections if c.topic in topics]
            if connections:  # rosbags takes none for all
                yield from ((c.topic, cdr) for c, _, cdr in reader.messages(connections))

    with Reader(path) as reader:
        return Storage(path, {c.topic: c.msgtype for c in reader.connections}, messages)

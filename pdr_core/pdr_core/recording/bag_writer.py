"""Writes rosbag2 directories with MCAP storage from messages that are CDR bytes already."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from pdr_core.recording.message_types import known_types
from pdr_core.recording.session import RecordingError

if TYPE_CHECKING:
    from types import TracebackType

    from rosbags.interfaces import Connection


class BagWriter:
    """A context manager: the bag is complete, with its index and metadata.yaml, once the block is left."""

    def __init__(self, path: Path, definitions: dict[str, str]) -> None:
        """Prepare a bag at `path`; `definitions`: texts of messages that ROS 2 Jazzy does not bring, by type."""
        from rosbags.rosbag2 import StoragePlugin, Writer
        from rosbags.rosbag2.errors import WriterError

        self._types = known_types(definitions)
        self._connections: dict[str, Connection] = {}
        try:
            self._writer = Writer(path, version=9, storage_plugin=StoragePlugin.MCAP)
        except WriterError as error:
            raise RecordingError(f"{path} exists already: remove it or choose another name for the bag.") from error

    def __enter__(self) -> BagWriter:
        """Create the directory."""
        self._writer.open()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Write the index and metadata.yaml."""
        self._writer.__exit__(kind, error, trace)

    @property
    def topics(self) -> frozenset[str]:
        """Topics that have a message."""
        return frozenset(self._connections)

    def write(self, topic: str, msgtype: str, stamp_ns: int, cdr: bytes) -> None:
        """Append one message, stamped [ns]; its type must be one of Jazzy or of the definitions."""
        if topic not in self._connections:
            self._connections[topic] = self._writer.add_connection(topic, msgtype, typestore=self._types)
        self._writer.write(self._connections[topic], stamp_ns, cdr)

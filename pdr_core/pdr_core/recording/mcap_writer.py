"""Writes one MCAP file of which a crash takes only what was not yet flushed.

After each `flush` the file ends with a whole chunk: what reads on without a summary (`mcap_salvage`, `mcap recover`)
finds everything up to there. Schemas and channels stand in the chunk of their first message, again in the summary.
Layout: https://mcap.dev/spec
"""

from __future__ import annotations

import os
import zlib
from collections import defaultdict
from typing import TYPE_CHECKING

from pdr_core.recording.message_types import known_types

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path
    from types import TracebackType

    from mcap.records import AttachmentIndex, Channel, ChunkIndex, McapRecord, Schema

PROFILE, LIBRARY = "ros2", "pdr"
COMPRESSION = "zstd"
SCHEMA, ENCODING = "ros2msg", "cdr"


class McapWriter:
    """A context manager: the file has its summary once the block is left; FileExistsError if there is one already."""

    def __init__(self, path: Path, definitions: Mapping[str, str]) -> None:
        """Create `path`; `definitions`: texts of messages that ROS 2 Jazzy does not bring, by type."""
        self._types = known_types(definitions)
        self._schemas: dict[str, Schema] = {}
        self._channels: dict[str, Channel] = {}
        self._chunks: list[ChunkIndex] = []
        self._attachments: list[AttachmentIndex] = []
        self._counts: dict[int, int] = defaultdict(int)  # messages of each channel
        self._chunk = Chunk()
        self._file = path.open("xb")

    def __enter__(self) -> McapWriter:
        """Write the beginning."""
        from mcap.records import Header
        from mcap.writer import MCAP0_MAGIC

        self._file.write(MCAP0_MAGIC + encoded(Header(PROFILE, LIBRARY)))
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Write the summary and close the file."""
        from mcap.writer import MCAP0_MAGIC

        with self._file:
            self.flush()
            self._file.write(self._summary() + MCAP0_MAGIC)

    def knows(self, msgtype: str) -> bool:
        """Tell whether messages of a type can be written."""
        return msgtype in self._types.fielddefs

    @property
    def counts(self) -> dict[str, int]:
        """How many messages each topic has."""
        return {topic: self._counts[channel.id] for topic, channel in self._channels.items()}

    @property
    def size_bytes(self) -> int:
        """How long the file is, without what waits for the next flush."""
        return self._file.tell()

    def write(self, topic: str, msgtype: str, stamp_ns: int, cdr: bytes) -> None:
        """Append one message, stamped [ns]; its type must be one that it `knows`."""
        channel = self._channels.get(topic) or self._new_channel(topic, msgtype)
        self._counts[channel.id] += 1
        self._chunk.add(channel.id, stamp_ns, cdr)

    def attach(self, name: str, media_type: str, stamp_ns: int, data: bytes) -> None:
        """Append a file within the file; it stands there at once."""
        from mcap.records import Attachment, AttachmentIndex

        self.flush()
        record = encoded(Attachment(stamp_ns, stamp_ns, name, media_type, data))
        at = self._file.tell()
        index = AttachmentIndex(at, len(record), stamp_ns, stamp_ns, len(data), name, media_type)
        self._attachments.append(index)
        self._put(record)

    def flush(self) -> None:
        """Write what was appended as a whole chunk, and let the disk have it."""
        if not self._chunk.empty:
            record, index = self._chunk.closed(self._file.tell())
            self._chunks.append(index)
            self._chunk = Chunk()
            self._put(record)

    def _put(self, record: bytes) -> None:
        self._file.write(record)
        self._file.flush()
        os.fsync(self._file.fileno())

    def _new_channel(self, topic: str, msgtype: str) -> Channel:
        from mcap.records import Channel, Schema

        if msgtype not in self._schemas:
            text, _ = self._types.generate_msgdef(msgtype, ros_version=2)
            self._schemas[msgtype] = Schema(len(self._schemas) + 1, text.encode(), SCHEMA, msgtype)
            self._chunk.put(self._schemas[msgtype])
        channel = Channel(len(self._channels) + 1, topic, ENCODING, {}, self._schemas[msgtype].id)
        self._chunk.put(channel)
        self._channels[topic] = channel
        return channel

    def _summary(self) -> bytes:
        """Return the end of the file: what a reader with an index needs."""
        from mcap.records import DataEnd, Footer, Statistics

        end = encoded(DataEnd(0))
        times_ns = [ns for chunk in self._chunks for ns in (chunk.message_start_time, chunk.message_end_time)]
        statistics = Statistics(
            attachment_count=len(self._attachments),
            channel_count=len(self._channels),
            channel_message_counts=dict(self._counts),
            chunk_count=len(self._chunks),
            message_count=sum(self._counts.values()),
            message_start_time=min(times_ns, default=0),
            message_end_time=max(times_ns, default=0),
            metadata_count=0,
            schema_count=len(self._schemas),
        )
        records = [*self._schemas.values(), *self._channels.values(), statistics, *self._chunks, *self._attachments]
        start = self._file.tell() + len(end)
        return end + b"".join(map(encoded, records)) + encoded(Footer(start, 0, 0))  # no offsets, no checksum


class Chunk:
    """Records that are written together, compressed."""

    def __init__(self) -> None:
        from mcap.data_stream import RecordBuilder

        self._records = RecordBuilder()
        self._places: dict[int, list[tuple[int, int]]] = defaultdict(list)  # of each channel: stamp [ns] and offset

    @property
    def empty(self) -> bool:
        """Nothing was put in."""
        return self._records.count == 0

    def put(self, record: McapRecord) -> None:
        """Take a schema or a channel."""
        record.write(self._records)

    def add(self, channel: int, stamp_ns: int, cdr: bytes) -> None:
        """Take a message."""
        from mcap.records import Message

        self._places[channel].append((stamp_ns, self._records.count))
        Message(channel, stamp_ns, cdr, stamp_ns, 0).write(self._records)

    def closed(self, at: int) -> tuple[bytes, ChunkIndex]:
        """Return the chunk with the indexes of its messages, and what the summary says of it, which stands `at`."""
        import zstandard
        from mcap import records

        raw = self._records.end()
        packed = zstandard.compress(raw)
        times_ns = [stamp_ns for places in self._places.values() for stamp_ns, _ in places]
        first_ns, last_ns = min(times_ns), max(times_ns)
        chunk = encoded(records.Chunk(COMPRESSION, packed, last_ns, first_ns, zlib.crc32(raw), len(raw)))
        out, offsets = chunk, {}
        for channel, places in self._places.items():
            offsets[channel] = at + len(out)
            out += encoded(records.MessageIndex(channel, places))
        index = records.ChunkIndex(
            chunk_length=len(chunk),
            chunk_start_offset=at,
            compression=COMPRESSION,
            compressed_size=len(packed),
            message_end_time=last_ns,
            message_index_length=len(out) - len(chunk),
            message_index_offsets=offsets,
            message_start_time=first_ns,
            uncompressed_size=len(raw),
        )
        return out, index


def encoded(record: McapRecord) -> bytes:
    """Return the bytes of a record."""
    from mcap.data_stream import RecordBuilder

    builder = RecordBuilder()
    record.write(builder)
    return builder.end()

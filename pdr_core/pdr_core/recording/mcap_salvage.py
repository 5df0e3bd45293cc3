"""Reads an MCAP file from its start to where it breaks off, without its summary."""

from collections.abc import Collection, Iterator
from contextlib import suppress
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from pdr_core.recording.storage import Storage

if TYPE_CHECKING:
    from mcap.records import Chunk, McapRecord


def salvaged_mcap(path: Path) -> Storage:
    """Open the file as far as it goes; its messages raise where it breaks."""
    from mcap.records import Channel, Schema

    names: dict[int, str] = {}
    topics: dict[str, str] = {}
    with suppress(Exception):  # the damage is told when the messages are read
        for record in _records(path):
            if isinstance(record, Schema):
                names[record.id] = record.name
            elif isinstance(record, Channel):
                topics[record.topic] = names.get(record.schema_id, "")
    return Storage(path, topics, partial(_messages, path))


def mcap_attachments(path: Path) -> dict[str, bytes]:
    """Return the files within an MCAP file by name, as far as it goes; of one name the last."""
    from mcap.records import Attachment
    from mcap.stream_reader import StreamReader

    found: dict[str, bytes] = {}
    with path.open("rb") as file, suppress(Exception):  # the damage is told when the messages are read
        for record in StreamReader(file, emit_chunks=True, record_size_limit=path.stat().st_size).records:
            if isinstance(record, Attachment):
                found[record.name] = record.data
    return found


def _messages(path: Path, topics: Collection[str]) -> Iterator[tuple[str, bytes]]:
    from mcap.records import Channel, Message

    channels: dict[int, str] = {}
    for record in _records(path):
        if isinstance(record, Channel) and record.topic in topics:
            channels[record.id] = record.topic
        elif isinstance(record, Message) and record.channel_id in channels:
            yield channels[record.channel_id], record.data


def _records(path: Path) -> "Iterator[McapRecord]":
    """Yield the records, those of chunks too; raises after the last one that is whole if the file is not."""
    from mcap.records import Chunk
    from mcap.stream_reader import StreamReader, breakup_chunk

    with path.open("rb") as file:
        end = 0
        try:
            for record in StreamReader(file, emit_chunks=True, record_size_limit=path.stat().st_size).records:
                end = file.tell()
                yield from breakup_chunk(record) if isinstance(record, Chunk) else (record,)
        except Exception:
            file.seek(end)
            with suppress(Exception):
                yield from _records_of_cut_chunk(file)
            raise


def _records_of_cut_chunk(file: BinaryIO) -> "Iterator[McapRecord]":
    from mcap.data_stream import ReadDataStream
    from mcap.opcode import Opcode
    from mcap.records import Chunk
    from mcap.stream_reader import StreamReader

    opcode, _length = file.read(1), file.read(8)
    if opcode == bytes([Opcode.CHUNK]):
        chunk = Chunk.read(ReadDataStream(file))
        yield from StreamReader(BytesIO(_unpacked(chunk)), skip_magic=True).records


def _unpacked(chunk: "Chunk") -> bytes:
    """Return what the data of a cut chunk decompress to, as far as they go."""
    if chunk.compression == "zstd":
        import zstandard

        return zstandard.ZstdDecompressor().decompressobj().decompress(chunk.data)
    if chunk.compression == "lz4":
        from lz4.frame import LZ4FrameDecompressor

        return LZ4FrameDecompressor().decompress(chunk.data)
    return chunk.data

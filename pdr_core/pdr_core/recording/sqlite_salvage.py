"""Reads an SQLite bag whose end is missing: row after row until a page is not there."""

from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

if TYPE_CHECKING:
    from sqlite3 import Connection


def salvaged_sqlite(path: Path) -> tuple[dict[str, str], Callable[[str], Iterator[bytes]]]:
    """Return the message types by topic, and what yields the CDR bytes of a topic and raises where the file breaks."""
    topics: dict[str, str] = {}
    with suppress(Exception), closing(_connected(path)) as database:  # the damage is told when the messages are read
        topics.update(database.execute("SELECT name, type FROM topics"))
    return topics, partial(_messages, path)


def _messages(path: Path, topic: str) -> Iterator[bytes]:
    with closing(_connected(path)) as database:
        ids = {row[0] for row in database.execute("SELECT id FROM topics WHERE name = ?", (topic,))}
        for topic_id, cdr in database.execute("SELECT topic_id, data FROM messages NOT INDEXED ORDER BY id"):
            if topic_id in ids:
                yield cdr


def _connected(path: Path) -> "Connection":
    import sqlite3

    database = sqlite3.connect(f"file:{quote(str(path.absolute()))}?mode=ro&immutable=1", uri=True)
    database.execute("PRAGMA writable_schema = ON")  # otherwise SQLite opens no file that is shorter than it says
    return database

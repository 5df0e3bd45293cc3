"""Reads an SQLite bag whose end is missing: row after row until a page is not there."""

from collections.abc import Collection, Iterator
from contextlib import closing, suppress
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from pdr_core.recording.storage import Storage

if TYPE_CHECKING:
    from apsw import VFS, Connection

WHOLE_PAGES = "pdr-whole-pages"


def salvaged_sqlite(path: Path) -> Storage:
    """Open the file as far as it goes; its messages raise where it breaks."""
    topics: dict[str, str] = {}
    with suppress(Exception), closing(_connected(path)) as database:  # the damage is told when the messages are read
        topics.update(database.execute("SELECT name, type FROM topics"))
    return Storage(path, topics, partial(_messages, path))


def ends_within_page(path: Path) -> bool:
    """Return whether an SQLite file breaks off within a page: SQLite would read the missing bytes as zeros."""
    with path.open("rb") as file:
        header = file.read(18)
    return path.stat().st_size % _page_size(header) != 0


def _page_size(header: bytes) -> int:
    size = int.from_bytes(header[16:18], "big")
    return 65536 if size <= 1 else size


def _messages(path: Path, topics: Collection[str]) -> Iterator[tuple[str, bytes]]:
    with closing(_connected(path)) as database:
        names = {row[0]: row[1] for row in database.execute("SELECT id, name FROM topics") if row[1] in topics}
        for topic_id, cdr in database.execute("SELECT topic_id, data FROM messages NOT INDEXED ORDER BY id"):
            if topic_id in names:
                yield names[topic_id], cdr


def _connected(path: Path) -> "Connection":
    import apsw

    _whole_pages()
    flags = apsw.SQLITE_OPEN_READONLY | apsw.SQLITE_OPEN_URI
    database = apsw.Connection(f"file:{quote(str(path.absolute()))}?immutable=1", flags=flags, vfs=WHOLE_PAGES)
    database.execute("PRAGMA writable_schema = ON")  # otherwise SQLite opens no file that is shorter than it says
    return database


@cache
def _whole_pages() -> "VFS":
    """Let SQLite see files without the page within which they break off; it does as long as the result lives."""
    import apsw

    class WholePages(apsw.VFSFile):
        def __init__(self, name: "str | apsw.URIFilename | None", flags: list[int]) -> None:
            super().__init__("", name, flags)

        def xFileSize(self) -> int:  # noqa: N802
            size = super().xFileSize()
            return size - size % _page_size(self.xRead(18, 0)) if size >= 18 else 0

    class Files(apsw.VFS):
        def xOpen(self, name: "str | apsw.URIFilename | None", flags: list[int]) -> apsw.VFSFile:  # noqa: N802
            return WholePages(name, flags)

    return Files(WHOLE_PAGES, "")

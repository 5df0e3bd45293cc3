"""Merges streams by their stamps, with the same result in whatever order they arrive.

Each stream says up to which stamp it has told everything: its mark. What lies at or before the smallest mark is
certain, since no stream can still bring something earlier. It is given out in the order of the stamps, and where they
are equal in the order in which the streams were named.
"""

from collections.abc import Sequence
from operator import itemgetter
from typing import Generic, TypeVar

from pdr_core.conventions import NO_STAMP

Item = TypeVar("Item")


class Watermark(Generic[Item]):
    """Holds items back until every stream has passed them. The stamps of one stream ascend."""

    def __init__(self, streams: Sequence[str]) -> None:
        self._marks_ns: dict[str, int | None] = dict.fromkeys(streams, NO_STAMP)  # None: the stream has left
        self._places = {stream: place for place, stream in enumerate(streams)}
        self._waiting: list[tuple[int, int, str, Item]] = []

    def put(self, stream: str, stamp_ns: int, item: Item) -> list[tuple[str, Item]]:
        """Take an item; return the streams and items that are certain now.

        A stamp that is not after the stream's mark comes from a clock that has jumped back: all that waits is given out
        before it, and the merge begins anew.
        """
        mark_ns = self._marks_ns[stream]
        before = self.finish() if mark_ns is not None and stamp_ns <= mark_ns else []
        self._waiting.append((stamp_ns, self._places[stream], stream, item))
        return before + self.advance(stream, stamp_ns)

    def advance(self, stream: str, stamp_ns: int) -> list[tuple[str, Item]]:
        """Note that a stream has told everything up to a stamp; return what is certain now."""
        mark_ns = self._marks_ns[stream]
        self._marks_ns[stream] = stamp_ns if mark_ns is None else max(mark_ns, stamp_ns)
        return self._certain()

    def leave(self, stream: str) -> list[tuple[str, Item]]:
        """Wait for a stream no longer, until it brings something again; return what is certain without it."""
        self._marks_ns[stream] = None
        return self._certain()

    def finish(self) -> list[tuple[str, Item]]:
        """Return all that waits, and begin anew."""
        self._marks_ns = dict.fromkeys(self._marks_ns, NO_STAMP)
        return self._given_out(len(self._waiting))

    @property
    def awaited_ns(self) -> dict[str, int]:
        """The streams that hold something back, and the earliest stamp that waits for them."""
        earliest_ns = min((stamp_ns for stamp_ns, *_ in self._waiting), default=NO_STAMP)
        marks_ns = {stream: mark_ns for stream, mark_ns in self._marks_ns.items() if mark_ns is not None}
        return {stream: earliest_ns for stream, mark_ns in marks_ns.items() if mark_ns < earliest_ns}

    def _certain(self) -> list[tuple[str, Item]]:
        marks_ns = [mark_ns for mark_ns in self._marks_ns.values() if mark_ns is not None]
        certain = [stamp_ns for stamp_ns, *_ in self._waiting if not marks_ns or stamp_ns <= min(marks_ns)]
        return self._given_out(len(certain))

    def _given_out(self, count: int) -> list[tuple[str, Item]]:
        """Return the `count` items with the earliest stamps."""
        self._waiting.sort(key=itemgetter(0, 1))
        given, self._waiting = self._waiting[:count], self._waiting[count:]
        return [(stream, item) for _, _, stream, item in given]

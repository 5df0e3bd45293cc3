"""A tally of what went wrong: one notice per kind, with how often and when first."""

from pdr_core.records import Flags, Level, Notice, Stamps


class Tally:
    """Counts faults by kind; stages own one each, nodes and reports read it."""

    def __init__(self) -> None:
        self._notices: dict[str, Notice] = {}

    def add(self, kind: str, level: Level, text: str, stamp_ns: int, count: int = 1) -> None:
        """Count a fault `count` more times; its first stamp stays, its text is the newest."""
        known = self._notices.get(kind)
        total, first_ns = (known.count + count, known.first_stamp_ns) if known else (count, stamp_ns)
        self._notices[kind] = Notice(level, kind, text, total, first_ns)

    def once(self, kind: str, level: Level, text: str, stamp_ns: int) -> None:
        """Say it once, however often it is so."""
        if kind not in self._notices:
            self.add(kind, level, text, stamp_ns)

    def add_flagged(self, kind: str, level: Level, text: str, flags: Flags, stamps_ns: Stamps) -> None:
        """Count the samples that are flagged, (n,)."""
        if flags.any():
            self.add(kind, level, text, int(stamps_ns[flags.argmax()]), int(flags.sum()))

    @property
    def notices(self) -> list[Notice]:
        """All kinds so far, in the order in which they first appeared."""
        return list(self._notices.values())

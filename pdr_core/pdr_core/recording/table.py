"""What a text file and a .mat file have in common: named columns that are read in pieces."""

from collections.abc import Iterator, Sequence
from decimal import Decimal
from fnmatch import fnmatchcase
from pathlib import Path
from typing import NamedTuple, Protocol

import numpy as np

from pdr_core.recording.session import put_warning
from pdr_core.records import Floats, Notice, Stamps


class Clock(NamedTuple):
    """The column that holds the time, and how many nanoseconds its unit has; without a column the rows count."""

    column: int | None
    ns_per_unit: Decimal

    def row_stamps(self, start: int, stop: int) -> Stamps:
        """Return the stamps of the rows start:stop where the rows count."""
        return np.rint(np.arange(start, stop) * float(self.ns_per_unit)).astype(np.int64)


class Rows(NamedTuple):
    """n rows of a table."""

    stamp_ns: Stamps  # (n,)
    values: Floats  # (n, columns), NaN where a cell holds no number


class Table(Protocol):
    """A file of named columns."""

    @property
    def columns(self) -> Sequence[str]:
        """The names of the columns."""

    def pieces(self, clock: Clock, columns: Sequence[int], max_rows: int, notices: list[Notice]) -> Iterator[Rows]:
        """Yield the rows in the order of the file, at most `max_rows` at a time."""


def positions(table: Table, patterns: Sequence[str]) -> list[int]:
    """Return where the columns are that the patterns mean; LookupError names a pattern that means none or several."""
    return [_position(table.columns, pattern) for pattern in patterns]


def _position(columns: Sequence[str], pattern: str) -> int:
    hits = [i for i, name in enumerate(columns) if name == pattern or fnmatchcase(name, pattern)]
    if len(hits) != 1:
        raise LookupError(f"{len(hits) or 'no'} columns match '{pattern}'")
    return hits[0]


def put_unreadable_times(notices: list[Notice], path: Path, count: int, near_ns: int) -> None:
    """Say that rows without a readable time were left out, the first of them near a stamp [ns]."""
    put_warning(notices, "unreadable_time", f"{path.name}: rows whose time is no number were left out.", count, near_ns)

"""Text files of separated columns, read in pieces: in one go with numpy, row by row only where that fails."""

from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import TextIO

import numpy as np

from pdr_core.recording.session import RecordingError
from pdr_core.recording.stamps import stamp_ns_from_text
from pdr_core.recording.table import Clock, Rows, put_unreadable_times
from pdr_core.records import Notice

DELIMITERS = ",;\t"


@dataclass(frozen=True)
class TextTable:
    """A text file. The rows of its header are joined by '/'; without a header the columns are called 0, 1, 2 ..."""

    path: Path
    header_rows: int
    delimiter: str
    columns: tuple[str, ...]

    def pieces(self, clock: Clock, columns: Sequence[int], max_rows: int, notices: list[Notice]) -> Iterator[Rows]:
        """Yield rows of at most `max_rows`; rows without a readable time are left out and counted in a notice."""
        done, unreadable, last_stamp_ns = 0, 0, 0
        with _opened(self.path) as file:
            _next_lines(file, self.header_rows)
            while lines := _next_lines(file, max_rows):
                filled = [self._with_points(line) for line in lines if line.strip()]
                rows = self._parsed(filled, clock, columns, done)
                done += len(filled)
                if missing := len(filled) - len(rows.stamp_ns):
                    unreadable += missing
                    put_unreadable_times(notices, self.path, unreadable, last_stamp_ns)
                if len(rows.stamp_ns):
                    last_stamp_ns = int(rows.stamp_ns[-1])
                    yield rows

    def _with_points(self, line: str) -> str:
        """Return a row whose decimal commas, which only another delimiter allows, are points."""
        return line if self.delimiter == "," else line.replace(",", ".")

    def _parsed(self, lines: list[str], clock: Clock, columns: Sequence[int], first_row: int) -> Rows:
        try:
            return self._parsed_at_once(lines, clock, columns, first_row)
        except ValueError:
            return self._parsed_one_by_one(lines, clock, columns, first_row)

    def _parsed_at_once(self, lines: list[str], clock: Clock, columns: Sequence[int], first_row: int) -> Rows:
        values = ("values", np.float64, (len(columns),))
        if clock.column is None:
            table = self._loaded(lines, np.dtype([values]), list(columns), {})
            return Rows(clock.row_stamps(first_row, first_row + len(lines)), table["values"])
        convert = {clock.column: lambda text: stamp_ns_from_text(text, clock.ns_per_unit)}
        table = self._loaded(lines, np.dtype([("stamp_ns", np.int64), values]), [clock.column, *columns], convert)
        return Rows(table["stamp_ns"], table["values"])

    def _loaded(self, lines: list[str], dtype: np.dtype, columns: list[int], converters: dict) -> np.ndarray:
        if not lines:
            return np.empty(0, dtype)
        return np.loadtxt(
            lines, dtype, comments=None, delimiter=self.delimiter, converters=converters, usecols=columns,
            ndmin=1, encoding="utf-8",
        )  # fmt: skip

    def _parsed_one_by_one(self, lines: list[str], clock: Clock, columns: Sequence[int], first_row: int) -> Rows:
        cells = [dict(enumerate(_cells(line, self.delimiter))) for line in lines]
        values = np.array([[_number(row.get(c, "")) for c in columns] for row in cells], np.float64)
        if clock.column is None:
            return Rows(clock.row_stamps(first_row, first_row + len(lines)), values)
        stamps = [_stamp(row.get(clock.column, ""), clock) for row in cells]
        readable = [stamp is not None for stamp in stamps]
        return Rows(np.array([stamp for stamp in stamps if stamp is not None], np.int64), values[readable])


def open_text_table(path: Path, header_rows: int) -> TextTable:
    """Read the header of a text file; RecordingError if the file cannot be read."""
    with _opened(path) as file:
        lines = _next_lines(file, max(header_rows, 1)) or [""]
    delimiter = max(DELIMITERS, key=lines[0].count)
    header = [_cells(line, delimiter) for line in lines]
    if header_rows == 0:
        return TextTable(path, 0, delimiter, tuple(str(i) for i in range(len(header[0]))))
    return TextTable(path, header_rows, delimiter, tuple("/".join(parts) for parts in zip(*header, strict=False)))


def _opened(path: Path) -> TextIO:
    try:
        with path.open("rb") as file:
            encoding = "utf-16" if file.read(2) in (BOM_UTF16_LE, BOM_UTF16_BE) else "utf-8-sig"
        return path.open(encoding=encoding, errors="replace")
    except OSError as error:
        raise RecordingError(f"{path} cannot be read, check its path and its permissions: {error}.") from error


def _next_lines(file: TextIO, count: int) -> list[str]:
    return list(islice(file, count))


def _cells(line: str, delimiter: str) -> list[str]:
    return [cell.strip().strip('"') for cell in line.rstrip("\r\n").split(delimiter)]


def _stamp(cell: str, clock: Clock) -> int | None:
    try:
        return stamp_ns_from_text(cell, clock.ns_per_unit)
    except ValueError:
        return None


def _number(cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        return float("nan")

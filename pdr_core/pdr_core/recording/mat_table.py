"""MATLAB files, seen as a table: a vector is a column of its name, a matrix `m` has the columns m.0, m.1, m.2 ..."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pdr_core.conventions import NANOSECONDS, stamp_ns_from_seconds
from pdr_core.recording.session import RecordingError
from pdr_core.recording.table import Clock, Rows, put_unreadable_times
from pdr_core.records import Floats, Notice

LONGEST_S = 9e9  # what 64 bits of nanoseconds hold


@dataclass(frozen=True)
class MatTable:
    """A MATLAB file; it is in memory as a whole."""

    path: Path
    columns: tuple[str, ...]
    data: tuple[Floats, ...]  # one (n,) a column; n is the same within a variable only

    def pieces(self, clock: Clock, columns: Sequence[int], max_rows: int, notices: list[Notice]) -> Iterator[Rows]:
        """Yield rows of at most `max_rows`; RecordingError if the columns asked for differ in length."""
        clocks = [] if clock.column is None else [clock.column]
        if len({len(self.data[c]) for c in (*columns, *clocks)}) > 1:
            raise RecordingError(f"{self.path}: its variables differ in length, export the recording again.")
        rows = self._rows(clock, columns, notices)
        for start in range(0, len(rows.values), max_rows):
            yield Rows(rows.stamp_ns[start : start + max_rows], rows.values[start : start + max_rows])

    def _rows(self, clock: Clock, columns: Sequence[int], notices: list[Notice]) -> Rows:
        values = np.column_stack([self.data[c] for c in columns])
        if clock.column is None:
            return Rows(clock.row_stamps(0, len(values)), values)
        time_s = self.data[clock.column] * (float(clock.ns_per_unit) / NANOSECONDS)
        readable = np.abs(time_s) < LONGEST_S
        stamp_ns = stamp_ns_from_seconds(time_s[readable])
        if unreadable := int(np.sum(~readable)):
            put_unreadable_times(notices, self.path, unreadable, int(stamp_ns[0]) if len(stamp_ns) else 0)
        return Rows(stamp_ns, values[readable])


def open_mat_table(path: Path) -> MatTable:
    """Read a MATLAB file up to v7.2; RecordingError if it is damaged or of another version."""
    from scipy.io import loadmat

    try:
        variables = loadmat(path)
    except Exception as error:  # a damaged file makes loadmat raise anything
        raise RecordingError(
            f"{path} cannot be read as a MATLAB file ({error}): copy it again, or save it in MATLAB with '-v7'."
        ) from error
    named = {}
    for name, value in variables.items():
        if isinstance(value, np.ndarray) and value.ndim == 2 and value.dtype.kind in "fiub":
            named.update(_columns_of(name, value.astype(np.float64)))
    return MatTable(path, tuple(named), tuple(named.values()))


def _columns_of(name: str, value: Floats) -> dict[str, Floats]:
    if 1 in value.shape:
        return {name: value.ravel()}
    return {f"{name}.{i}": column for i, column in enumerate(value.T)}

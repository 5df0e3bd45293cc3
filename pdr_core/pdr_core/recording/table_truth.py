"""Loads the truth that a column map declares beside the samples."""

from decimal import Decimal
from pathlib import Path

import numpy as np

from pdr_core.recording.column_map import TimeColumn, TruthMap
from pdr_core.recording.mat_table import open_mat_table
from pdr_core.recording.session import DEFAULT_PIECE, RecordingError, put_warning
from pdr_core.recording.table import Clock, Table, positions
from pdr_core.recording.text_table import open_text_table
from pdr_core.records import Floats, Notice, Stamps, Truth, TruthKind

NO_STAMPS = np.empty(0, np.int64)
ROW_COUNT = TimeColumn(None, Decimal(1))


def open_table(path: Path, header_rows: int) -> Table:
    """Open a .mat or a text file as a table."""
    return open_mat_table(path) if path.suffix.lower() == ".mat" else open_text_table(path, header_rows)


def load_truth(
    truth: TruthMap | None, recording: Table, time: TimeColumn, path: Path, notices: list[Notice]
) -> Truth | None:
    """Return the truth of the recording at `path`, None where there is none; a truth that is damaged is a notice."""
    if truth is None or (truth.stems is not None and path.stem not in truth.stems):
        return None
    if truth.kind is TruthKind.CLOSED_LOOP:
        return Truth(truth.kind, NO_STAMPS, np.empty((0, 3)))
    beside = path.with_name(truth.file.replace("{stem}", path.stem)) if truth.file else path
    if not beside.exists():
        return None
    try:
        table = open_table(beside, truth.header_rows) if truth.file else recording
        return _positions(truth, table, recording, time, notices)
    except (RecordingError, LookupError) as error:
        put_warning(notices, "unreadable_truth", f"The truth in {beside.name} was left out: {error}.", 1, 0)
        return None


def _positions(truth: TruthMap, table: Table, recording: Table, time: TimeColumn, notices: list[Notice]) -> Truth:
    if truth.kind is TruthKind.STRIDES:
        return Truth(truth.kind, NO_STAMPS, _points(truth, table, ROW_COUNT, notices)[1].mean(axis=1))
    stamps, points = _points(truth, table, truth.time or time, notices)
    known = np.isfinite(points).all(axis=(1, 2))
    if truth.time:
        stamps = stamps - stamps[:1] + _first_stamp_ns(recording, time)
    several = points[known] if len(truth.points) > 1 else None
    return Truth(truth.kind, stamps[known], points[known].mean(axis=1), several)


def _points(truth: TruthMap, table: Table, time: TimeColumn, notices: list[Notice]) -> tuple[Stamps, Floats]:
    """Return stamps of the table's own clock, (n,), and the points [m] there, (n, points, axes)."""
    columns = positions(table, [c for point in truth.points for c in point.columns])
    pieces = list(table.pieces(clock_of(table, time), columns, DEFAULT_PIECE, notices))
    if not pieces:
        raise RecordingError("it holds no readable row")
    points = np.concatenate([p.values for p in pieces]).reshape(-1, len(truth.points), len(truth.points[0].columns))
    scale = np.array([point.scale for point in truth.points])
    return np.concatenate([p.stamp_ns for p in pieces]), points * scale


def _first_stamp_ns(recording: Table, time: TimeColumn) -> int:
    for rows in recording.pieces(clock_of(recording, time), [0], 1, []):
        return int(rows.stamp_ns[0])
    raise RecordingError("the recording has no stamp to start it with")


def clock_of(table: Table, time: TimeColumn) -> Clock:
    """Return where the time of a column map is in a table; LookupError if it is not."""
    column = positions(table, [time.column])[0] if time.column is not None else None
    return Clock(column, time.ns_per_unit)

"""Positions with stamps, from whatever file holds them: a trajectory, a CSV file or the truth of a recording."""

from pathlib import Path

import numpy as np

from pdr_core.recording.opening import open_recording
from pdr_core.recording.session import DEFAULT_PIECE, RecordingError
from pdr_core.recording.stamps import NS_PER_UNIT
from pdr_core.recording.table import Clock, positions
from pdr_core.recording.text_table import open_text_table
from pdr_core.recording.tum import read_tum
from pdr_core.records import Truth, TruthKind

AXES = ["x_m", "y_m", "z_m"]
TIMES = {"t_s": NS_PER_UNIT["s"], "t_ns": NS_PER_UNIT["ns"]}


def open_positions(path: Path, column_map: Path | None = None, sensor: str = "") -> Truth:
    """Return the positions in a .tum file, in a CSV with t_s or t_ns, x_m, y_m, z_m, or of a recording's truth.

    RecordingError if there are none, or several sensors have some and none is named.
    """
    if path.suffix == ".tum":
        trajectory = read_tum(path)
        return Truth(TruthKind.POSITION, trajectory.stamp_ns, trajectory.position_m)
    plain = _plain(path) if path.suffix == ".csv" and path.exists() and column_map is None else None
    found = plain or _truth_of(path, column_map, sensor)
    known = np.isfinite(found.position_m).all(axis=1)
    return Truth(found.kind, found.stamp_ns[known], found.position_m[known])


def _plain(path: Path) -> Truth | None:
    """Return what a CSV of positions holds, None if its columns are others."""
    table = open_text_table(path, 1)
    time = next((name for name in TIMES if name in table.columns), None)
    if time is None or not set(AXES) <= set(table.columns):
        return None
    clock = Clock(table.columns.index(time), TIMES[time])
    pieces = list(table.pieces(clock, positions(table, AXES), DEFAULT_PIECE, []))
    stamps = [np.empty(0, np.int64), *(p.stamp_ns for p in pieces)]
    return Truth(
        TruthKind.POSITION, np.concatenate(stamps), np.concatenate([np.empty((0, 3)), *(p.values for p in pieces)])
    )


def _truth_of(path: Path, column_map: Path | None, sensor: str) -> Truth:
    sensors = open_recording(path, column_map).sensors
    truths = {name: s.truth for name, s in sensors.items() if s.truth and s.truth.kind is TruthKind.POSITION}
    if not truths:
        raise RecordingError(f"{path} holds no positions with stamps: give a .tum file, or a recording with a truth.")
    if sensor and sensor not in truths:
        raise RecordingError(f"{path} has no positions of {sensor!r}; choose from {', '.join(truths)}.")
    if not sensor and len(truths) > 1:
        raise RecordingError(f"{path} has several sensors; choose one by --sensor: {', '.join(truths)}.")
    return truths[sensor or next(iter(truths))]

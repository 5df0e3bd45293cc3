"""Opens text and .mat recordings: finds the column map that fits, and reads sensors and truth as it says."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from pdr_core.recording.column_map import ColumnMap, SensorMap
from pdr_core.recording.column_map_yaml import column_map_from_file, known_maps
from pdr_core.recording.session import RecordingError, Sensor, Session
from pdr_core.recording.table import Clock, Table, positions
from pdr_core.recording.table_truth import clock_of, load_truth, open_table
from pdr_core.records import Floats, ImuBlock, Notice, inertial_block

FOLDER_MAP = "pdr_columns.yaml"
COLUMNS_SHOWN = 12
AXES = 6  # of a gyro and an accelerometer
HOW_TO_MAP = (
    "say which is which in a file '{stem}.yaml' beside it, for example `time: {{column: t, unit: s}}` and `sensors: "
    "{{imu: {{gyro: {{columns: [wx, wy, wz], unit: rad/s}}, accel: {{columns: [ax, ay, az], unit: m/s^2}}}}}}` "
    "(pdr_core/docs/recordings.md has the rest)."
)


def open_table_session(path: Path, column_map: Path | None) -> Session:
    """Open a text or .mat recording; RecordingError if no column map fits or it holds no samples."""
    own = column_map or _map_beside(path)
    if own:
        chosen = column_map_from_file(own)
        table = open_table(path, chosen.header_rows)
        _check_fit(chosen, table, path, own)
    else:
        chosen, table = _known(path)
    notices: list[Notice] = []
    sensors = {name: _sensor(name, s, chosen, table, path, notices) for name, s in chosen.sensors.items()}
    return Session(path.stem, path, chosen.name, sensors, notices)


def _map_beside(path: Path) -> Path | None:
    candidates = [path.with_suffix(".yaml"), path.with_name(FOLDER_MAP)]
    return next((c for c in candidates if c.exists()), None)


def _check_fit(chosen: ColumnMap, table: Table, path: Path, source: Path) -> None:
    try:
        positions(table, [*chosen.columns(), *chosen.field_columns()])
    except LookupError as error:
        advice = "correct the map"
        if len(table.columns) < AXES:
            advice = f"these are all columns of its first line: remove what stands before the names, or {advice}"
        raise RecordingError(
            f"{path} does not fit the column map {source}: {error} of {_shown(table)}; {advice}."
        ) from error


def _known(path: Path) -> tuple[ColumnMap, Table]:
    maps = known_maps()
    tables = _tables(path, {known.header_rows for known in maps})
    for known in maps:
        if _fits(known.columns(), tables[known.header_rows]):
            return _as_far_as_there(known, tables[known.header_rows]), tables[known.header_rows]
    table = tables[1]
    if any(_fits(_truth_columns(known), table) for known in maps):
        raise RecordingError(f"{path} holds only the truth of a walk: open the samples beside it, {path.stem}.csv.")
    raise RecordingError(
        f"{path} is of no known format, its columns are {_shown(table)}: {HOW_TO_MAP.format(stem=path.stem)}"
    )


def _tables(path: Path, header_rows: set[int]) -> dict[int, Table]:
    """Return the file as a table for every number of header rows; a .mat file has none and is read once."""
    if path.suffix.lower() == ".mat":
        return dict.fromkeys(header_rows, open_table(path, 1))
    return {rows: open_table(path, rows) for rows in header_rows}


def _as_far_as_there(known: ColumnMap, table: Table) -> ColumnMap:
    """Return the map without the magnetic fields that the file does not hold."""
    there = {name: s for name, s in known.sensors.items() if s.mag and _fits(s.mag.columns, table)}
    return replace(known, sensors={name: there.get(name, replace(s, mag=None)) for name, s in known.sensors.items()})


def _fits(patterns: list[str], table: Table) -> bool:
    try:
        return len(positions(table, patterns)) > 0
    except LookupError:
        return False


def _truth_columns(known: ColumnMap) -> list[str]:
    truths = [s.truth for s in known.sensors.values() if s.truth and s.truth.file]
    return [c for truth in truths for point in truth.points for c in point.columns]


def _shown(table: Table) -> str:
    more = ", ..." if len(table.columns) > COLUMNS_SHOWN else ""
    return ", ".join(f"'{c[:60]}'" for c in table.columns[:COLUMNS_SHOWN]) + more


def _sensor(name: str, sensor: SensorMap, chosen: ColumnMap, table: Table, path: Path, notices: list[Notice]) -> Sensor:
    truth = load_truth(sensor.truth, table, chosen.time, path, notices)
    return Sensor(name, truth, partial(_blocks, table, clock_of(table, chosen.time), sensor, notices))


def _blocks(
    table: Table, clock: Clock, sensor: SensorMap, notices: list[Notice], max_samples: int
) -> Iterator[ImuBlock]:
    axes = [sensor.gyro, sensor.accel, *([sensor.mag] if sensor.mag else [])]
    columns = positions(table, [c for a in axes for c in a.columns])
    scale = np.array([s for a in axes for s in a.scale])
    for rows in table.pieces(clock, columns, max_samples, notices):
        values, unknown = rows.values * scale, np.zeros(len(rows.values))
        block = inertial_block(rows.stamp_ns, values[:, :3], values[:, 3:6], unknown, unknown)
        yield with_field(block, values[:, 6:]) if sensor.mag else block


def with_field(block: ImuBlock, field_tesla: Floats) -> ImuBlock:
    """Return samples with their field, (n, 3); one that is no number is none."""
    field_sd_tesla = np.where(np.isfinite(field_tesla).all(axis=1), 0.0, -1.0)
    field_tesla = np.where(field_sd_tesla[:, None] < 0.0, 0.0, field_tesla)
    return block._replace(field_tesla=field_tesla, field_sd_tesla=field_sd_tesla)

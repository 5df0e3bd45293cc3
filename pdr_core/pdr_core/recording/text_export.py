"""Writes a sensor as a CSV file with its column map and its truth beside it, exact to the last bit."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from pdr_core.recording.session import Sensor
from pdr_core.records import Floats, Stamps, Truth, TruthKind

TIME = {"column": "t_ns", "unit": "ns"}
GYRO = ["gyro_x_radps", "gyro_y_radps", "gyro_z_radps"]
ACCEL = ["accel_x_mps2", "accel_y_mps2", "accel_z_mps2"]
FIELD = ["mag_x_tesla", "mag_y_tesla", "mag_z_tesla"]
POSITION = ["x_m", "y_m", "z_m"]


def write_text(path: Path, sensor: Sensor) -> list[Path]:
    """Write the files and return them, the samples last. A rate that was not measured is NaN: that loses the sample."""
    start_ns, magnetic = _write_samples(path, sensor)
    column_map = {"name": "pdr", "time": TIME, "sensors": {sensor.name: _sensor_map(path, sensor.truth, magnetic)}}
    map_file = _write_map(path.with_suffix(".yaml"), column_map)
    beside = truth_file(path, sensor.truth)
    if sensor.truth and beside:
        _write_truth(beside, sensor.truth, start_ns)
    return [*([beside] if beside else []), map_file, path]


def truth_file(path: Path, truth: Truth | None) -> Path | None:
    """Return where the truth of a CSV file goes; None where there are no positions."""
    there = truth is not None and truth.kind is not TruthKind.CLOSED_LOOP
    return path.with_name(f"{path.stem}_truth.csv") if there else None


def _write_samples(path: Path, sensor: Sensor, magnetic: bool = False) -> tuple[int, bool]:
    """Write the samples; return the first stamp, and whether any of them has a field: only then it has columns.

    Where the first field comes after the first piece, all is written once more.
    """
    start_ns = 0
    with path.open("w") as file:
        for n, piece in enumerate(sensor.pieces()):
            if not magnetic and (piece.field_sd_tesla >= 0.0).any():
                if n > 0:
                    return _write_samples(path, sensor, magnetic=True)
                magnetic = True
            if n == 0:
                start_ns = int(piece.stamp_ns[0])
                file.write(",".join([TIME["column"], *GYRO, *ACCEL, *(FIELD if magnetic else [])]) + "\n")
            vectors = [_measured(piece.gyro_radps, piece.gyro_sd_radps), piece.accel_mps2]
            field_tesla = [_measured(piece.field_tesla, piece.field_sd_tesla)] if magnetic else []
            _write_rows(file, piece.stamp_ns, np.hstack([*vectors, *field_tesla]))
    return start_ns, magnetic


def _measured(vectors: Floats, deviations: Floats) -> Floats:
    """Return vectors, (n, 3), NaN where they were not measured."""
    return np.where(deviations[:, None] < 0.0, np.nan, vectors)


def _sensor_map(path: Path, truth: Truth | None, magnetic: bool) -> dict[str, Any]:
    section: dict[str, Any] = {
        "gyro": {"columns": list(GYRO), "unit": "rad/s"},
        "accel": {"columns": list(ACCEL), "unit": "m/s^2"},
    }
    if magnetic:
        section["mag"] = {"columns": list(FIELD), "unit": "T"}
    if truth:
        section["truth"] = {"kind": truth.kind.value}
    if truth and (beside := truth_file(path, truth)):
        section["truth"] |= {"file": beside.name, "points": [POSITION[: truth.position_m.shape[1]]], "unit": "m"}
    if truth and truth.kind is TruthKind.POSITION:
        section["truth"]["time"] = dict(TIME)
    return section


def _write_map(path: Path, content: dict[str, Any]) -> Path:
    import yaml

    path.write_text(yaml.safe_dump(content, sort_keys=False, default_flow_style=None))
    return path


def _write_truth(path: Path, truth: Truth, start_ns: int) -> None:
    """Write the positions. Stamped ones begin with a row of NaN: to a column map a truth starts with its recording."""
    columns = POSITION[: truth.position_m.shape[1]]
    with path.open("w") as file:
        if truth.kind is TruthKind.STRIDES:
            file.write(",".join(columns) + "\n")
            file.writelines(_line(row) for row in truth.position_m.tolist())
            return
        file.write(",".join([TIME["column"], *columns]) + "\n")
        _write_rows(file, np.array([start_ns]), np.full((1, len(columns)), np.nan))
        _write_rows(file, truth.stamp_ns, truth.position_m)


def _write_rows(file: TextIO, stamp_ns: Stamps, values: Floats) -> None:
    file.writelines(_line([stamp, *row]) for stamp, row in zip(stamp_ns.tolist(), values.tolist(), strict=True))


def _line(numbers: Iterable[float]) -> str:
    return ",".join(map(repr, numbers)) + "\n"

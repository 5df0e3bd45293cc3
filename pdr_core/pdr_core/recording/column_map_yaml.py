"""Reads column maps from YAML, and says by name what is wrong in one."""

from collections.abc import Iterable
from decimal import Decimal
from importlib.resources import files
from math import pi
from pathlib import Path
from typing import Any

from pdr_core.conventions import NANOSECONDS, STANDARD_GRAVITY_MPS2
from pdr_core.recording.column_map import Axes, ColumnMap, SensorMap, TimeColumn, TruthMap
from pdr_core.recording.session import RecordingError
from pdr_core.recording.stamps import NS_PER_UNIT
from pdr_core.records import TruthKind

GYRO_UNITS = {"rad/s": 1.0, "deg/s": pi / 180.0}
ACCEL_UNITS = {"m/s^2": 1.0, "g": STANDARD_GRAVITY_MPS2}
FIELD_UNITS = {"T": 1.0, "uT": 1e-6, "nT": 1e-9, "G": 1e-4, "mG": 1e-7}
LENGTH_UNITS = {"m": 1.0, "mm": 1e-3}
HEADER_ROWS = {0: 0, 1: 1, 2: 2}


def known_maps() -> list[ColumnMap]:
    """Return the maps of the formats that pdr knows, by name."""
    folder = files("pdr_core.recording") / "formats"
    texts = {f.name: f.read_text() for f in folder.iterdir() if f.name.endswith(".yaml")}
    return [column_map_from_text(texts[name], name) for name in sorted(texts)]


def column_map_from_file(path: Path) -> ColumnMap:
    """Read a user's column map; RecordingError that names the file and what is wrong in it."""
    try:
        return column_map_from_text(path.read_text(), path.name)
    except (OSError, UnicodeDecodeError) as error:
        raise RecordingError(f"The column map {path} cannot be read, check its path: {error}.") from error


def column_map_from_text(text: str, source: str) -> ColumnMap:
    """Parse a column map; `source` names it in the RecordingError that an unknown key or unit raises."""
    import yaml

    try:
        document = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise RecordingError(f"{source} is not YAML: {' '.join(str(error).split())}.") from error
    top = _section(document, source, {"time", "sensors"}, {"name", "header_rows", "match"})
    if not isinstance(top["sensors"], dict) or not top["sensors"]:
        raise RecordingError(f"{source}: sensors must hold at least one sensor under its name.")
    sensors = {str(n): _sensor(s, f"{source}: sensors.{n}") for n, s in top["sensors"].items()}
    name, time = str(top.get("name", Path(source).stem)), _time(top["time"], f"{source}: time")
    match = [str(c) for c in _list(top["match"], f"{source}: match")] if "match" in top else []
    return ColumnMap(name, _header_rows(top, source), time, sensors, match)


def _time(value: Any, where: str) -> TimeColumn:
    section = _section(value, where, set(), {"column", "unit", "rate_hz"})
    column = str(section["column"]) if "column" in section else None
    if ("unit" in section) == ("rate_hz" in section) or ("unit" in section and column is None):
        raise RecordingError(f"{where} needs column and unit, or rate_hz with or without a column that counts.")
    if "unit" in section:
        return TimeColumn(column, _one_of(section["unit"], NS_PER_UNIT, f"{where}.unit"))
    rate_hz = section["rate_hz"]
    if not isinstance(rate_hz, (int, float)) or not 0.0 < rate_hz < NANOSECONDS:
        raise RecordingError(f"{where}.rate_hz is '{rate_hz}'; it must be a positive number.")
    return TimeColumn(column, Decimal(NANOSECONDS) / Decimal(str(rate_hz)))


def _sensor(value: Any, where: str) -> SensorMap:
    section = _section(value, where, {"gyro", "accel"}, {"mag", "truth"})
    truth = _truth(section["truth"], f"{where}.truth") if "truth" in section else None
    gyro = _vector(section["gyro"], f"{where}.gyro", GYRO_UNITS)
    accel = _vector(section["accel"], f"{where}.accel", ACCEL_UNITS)
    mag = _vector(section["mag"], f"{where}.mag", FIELD_UNITS) if "mag" in section else None
    return SensorMap(gyro, accel, mag, truth)


def _vector(value: Any, where: str, units: dict[str, float]) -> Axes:
    section = _section(value, where, {"columns", "unit"})
    scale = _one_of(section["unit"], units, f"{where}.unit")
    return Axes([str(c) for c in _list(section["columns"], f"{where}.columns", 3)], [scale] * 3)


def _truth(value: Any, where: str) -> TruthMap:
    kinds = {kind.value: kind for kind in TruthKind}
    kind = _one_of(value.get("kind") if isinstance(value, dict) else value, kinds, f"{where}.kind")
    if kind is TruthKind.CLOSED_LOOP:
        stems = _section(value, where, {"kind"}, {"stems"}).get("stems")
        return TruthMap(kind, None if stems is None else _list(stems, f"{where}.stems"), [], None, 1, None)
    section = _section(value, where, {"kind", "points", "unit"}, {"signs", "file", "header_rows", "time"})
    if kind is TruthKind.POSITION and ("file" in section) != ("time" in section):
        raise RecordingError(f"{where} needs file and time together, or neither where it is in the recording itself.")
    time = _time(section["time"], f"{where}.time") if "time" in section else None
    return TruthMap(kind, None, _points(section, where, kind), section.get("file"), _header_rows(section, where), time)


def _points(section: dict[str, Any], where: str, kind: TruthKind) -> list[Axes]:
    axes = 3 if kind is TruthKind.POSITION else 2
    unit = _one_of(section["unit"], LENGTH_UNITS, f"{where}.unit")
    signs = _list(section.get("signs", [1] * axes), f"{where}.signs", axes)
    scale = [unit * _one_of(s, {1: 1, -1: -1}, f"{where}.signs") for s in signs]
    points = _list(section["points"], f"{where}.points")
    return [Axes([str(c) for c in _list(p, f"{where}.points", axes)], scale) for p in points]


def _header_rows(section: dict[str, Any], where: str) -> int:
    return _one_of(section.get("header_rows", 1), HEADER_ROWS, f"{where}: header_rows")


def _section(value: Any, where: str, required: set[str], optional: Iterable[str] = ()) -> dict[str, Any]:
    allowed = required | set(optional)
    if not isinstance(value, dict):
        raise RecordingError(f"{where} must be a section with the keys {_listed(allowed)}.")
    for key in value:
        if key not in allowed:
            raise RecordingError(f"{where} has the unknown key '{key}'; allowed are {_listed(allowed)}.")
    for key in sorted(required - value.keys()):
        raise RecordingError(f"{where} lacks the key '{key}'; allowed are {_listed(allowed)}.")
    return value


def _list(value: Any, where: str, count: int | None = None) -> list[Any]:
    if not isinstance(value, list) or not value or len(value) != (count or len(value)):
        raise RecordingError(f"{where} is '{value}'; it must be a list of {count or 'at least one'}.")
    return value


def _one_of(value: Any, allowed: dict[Any, Any], where: str) -> Any:
    if not isinstance(value, (str, int)) or value not in allowed:
        raise RecordingError(f"{where} is '{value}'; allowed are {_listed(allowed)}.")
    return allowed[value]


def _listed(words: Iterable[Any]) -> str:
    return ", ".join(str(w) for w in sorted(words))

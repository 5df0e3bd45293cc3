"""Column maps: which column of a text or .mat file holds what, and in which unit."""

from dataclasses import dataclass
from decimal import Decimal

from pdr_core.records import TruthKind


@dataclass(frozen=True)
class TimeColumn:
    """The column that holds the time, in units of `ns_per_unit`; without a column the rows count."""

    column: str | None
    ns_per_unit: Decimal


@dataclass(frozen=True)
class Axes:
    """The columns of one vector, and the factors that turn the numbers of the file into SI."""

    columns: list[str]
    scale: list[float]


@dataclass(frozen=True)
class TruthMap:
    """Where the truth of one sensor is. Without `file` it is in the recording itself, at the sample stamps."""

    kind: TruthKind
    stems: list[str] | None  # of the recordings that end where they began; None: all
    points: list[Axes]  # the truth is their mean; empty for CLOSED_LOOP
    file: str | None  # '{stem}' stands for the name of the recording without its suffix
    header_rows: int
    time: TimeColumn | None  # of `file`, which starts with the recording


@dataclass(frozen=True)
class SensorMap:
    """The columns of one inertial (and magnetic) sensor."""

    gyro: Axes
    accel: Axes
    mag: Axes | None
    truth: TruthMap | None


@dataclass(frozen=True)
class ColumnMap:
    """What one text or .mat format holds. Columns are fnmatch patterns, the rows of a header are joined by '/'."""

    name: str
    header_rows: int
    time: TimeColumn
    sensors: dict[str, SensorMap]
    match: list[str]  # further columns that tell the format

    def columns(self) -> list[str]:
        """Return the patterns of the columns without which a file is not of this format."""
        axes = [a for s in self.sensors.values() for a in (s.gyro, s.accel)]
        time = [] if self.time.column is None else [self.time.column]
        return [*self.match, *time, *(c for a in axes for c in a.columns)]

    def field_columns(self) -> list[str]:
        """Return the patterns of the columns that hold the magnetic field."""
        return [c for s in self.sensors.values() if s.mag for c in s.mag.columns]

"""The totals of gait analysis as a person reads them."""

import math
from typing import NamedTuple

from pdr_core.evaluation.gait_totals import GaitTotals, Spread
from pdr_core.evaluation.words import counted

UNKNOWN = "unknown"


class GaitRow(NamedTuple):
    """One row of the table."""

    name: str
    mean: str
    sd: str


def gait_rows(gait: GaitTotals) -> list[GaitRow]:
    """Return the rows of the table: what is spread over strides first, then what is one figure."""
    rows = [
        _spread("Stride length", gait.length_m, "m"),
        _spread("Duration", gait.duration_s, "s"),
        _spread("Cadence", gait.cadence_per_min, "steps/min", 1),
        _spread("Speed", gait.speed_mps, "m/s"),
        _spread("Stance", gait.stance_s, "s"),
        _spread("Swing", gait.swing_s, "s"),
        _spread("Clearance", gait.clearance_m, "m"),
        _spread("Largest foot pitch (push-off)", _degrees(gait.pitch_max_rad), "°", 1),
        _spread("Smallest foot pitch (strike)", _degrees(gait.pitch_min_rad), "°", 1),
        GaitRow("Largest clearance", _number(gait.clearance_max_m, "m"), ""),
        GaitRow("Turned in total (left is positive)", _number(math.degrees(gait.turned_rad), "°", 0), ""),
    ]
    return [*rows, *_stairs(gait), *_mounting(gait)]


def _stairs(gait: GaitTotals) -> list[GaitRow]:
    if not math.isfinite(gait.riser_m):
        return []
    up, down = f"{gait.climbed_m:.2f} m", f"{gait.descended_m:.2f} m"
    rows = [GaitRow("Stairs up", f"{up}, {counted(gait.floors_up, 'floor')}", "")]
    rows += [GaitRow("Stairs down", f"{down}, {counted(gait.floors_down, 'floor')}", "")]
    return [*rows, GaitRow("Height of a step of the stairs", f"{gait.riser_m:.3f} m", "")]


def _mounting(gait: GaitTotals) -> list[GaitRow]:
    if gait.mounting is None:
        return [GaitRow("Walking direction in the sensor's axes", UNKNOWN, "")]
    sure = math.degrees(gait.mounting.yaw_sd_rad)
    text = f"from {gait.mounting.strides} straight strides"
    return [GaitRow("Walking direction in the sensor's axes", text, f"{sure:.1f} °")]


def _spread(name: str, spread: Spread, unit: str, digits: int = 2) -> GaitRow:
    return GaitRow(name, _number(spread.mean, unit, digits), _number(spread.sd, unit, digits))


def _degrees(spread: Spread) -> Spread:
    return Spread(math.degrees(spread.mean), math.degrees(spread.sd))


def _number(value: float, unit: str, digits: int = 2) -> str:
    return f"{value:.{digits}f} {unit}" if math.isfinite(value) else UNKNOWN

"""The table of strides that a run leaves behind; docs/gait.md says what each column means."""

from collections.abc import Sequence
from pathlib import Path

from pdr_core.recording.stamps import text_from_stamp_ns
from pdr_core.records import Floats, StepEvent
from pdr_core.records_gait import Stride

FIRST = ["stride", "t_s", "x_m", "y_m", "z_m", "length_m", "heading_rad"]
GAIT = ["start_s", "dx_m", "dy_m", "dz_m", "duration_s", "cadence_per_min", "speed_mps", "stance_s", "swing_s"]
GAIT += ["clearance_m", "turn_rad", "heading_change_rad", "toe_off_s", "heel_strike_s"]
GAIT += ["pitch_max_rad", "pitch_min_rad"]
Cell = float | str | None  # None: unknown, an empty cell


def write_strides(path: Path, strides: Sequence[Stride]) -> None:
    """Write one row a stride after a row 0 for where the walk starts; only the header if there are no strides."""
    with path.open("w") as file:
        file.write(",".join([*FIRST, *GAIT]) + "\n")
        if strides:
            file.write(_start(strides[0].step))
        file.writelines(_row(stride) for stride in strides)


def _start(step: StepEvent) -> str:
    position_m = step.position_m - step.displacement_m
    return _line(0, step.start_ns, position_m, [0.0, 0.0, *[None] * len(GAIT)])


def _row(stride: Stride) -> str:
    step = stride.step
    cells = [step.length_m, step.heading_rad, _stamp(step.start_ns), *step.displacement_m]
    cells += [stride.duration_s, stride.cadence_per_min, stride.speed_mps, stride.stance_s, stride.swing_s]
    cells += [stride.clearance_m, stride.turn_rad, stride.heading_change_rad]
    cells += [_stamp(stride.toe_off_ns), _stamp(stride.heel_strike_ns), stride.pitch_max_rad, stride.pitch_min_rad]
    return _line(step.index, step.stamp_ns, step.position_m, cells)


def _stamp(stamp_ns: int | None) -> str | None:
    return None if stamp_ns is None else text_from_stamp_ns(stamp_ns)


def _line(index: int, stamp_ns: int, position_m: Floats, cells: Sequence[Cell]) -> str:
    texts = [_text(cell) for cell in (*position_m, *cells)]
    return ",".join([str(index), text_from_stamp_ns(stamp_ns), *texts]) + "\n"


def _text(cell: Cell) -> str:
    return "" if cell is None else cell if isinstance(cell, str) else f"{cell:.6f}"

"""The table of strides that a run leaves behind."""

from collections.abc import Sequence
from pathlib import Path

from pdr_core.recording.stamps import text_from_stamp_ns
from pdr_core.records import Floats, StepEvent

HEADER = "stride,t_s,x_m,y_m,z_m,length_m,heading_rad\n"


def write_strides(path: Path, steps: Sequence[StepEvent]) -> None:
    """Write one row a step after a row 0 for where the walk starts; only the header if there are no steps."""
    with path.open("w") as file:
        file.write(HEADER)
        if steps:
            file.write(_row(0, steps[0].start_ns, steps[0].position_m - steps[0].displacement_m, 0.0, 0.0))
        file.writelines(_row(s.index, s.stamp_ns, s.position_m, s.length_m, s.heading_rad) for s in steps)


def _row(index: int, stamp_ns: int, position_m: Floats, length_m: float, heading_rad: float) -> str:
    numbers = ",".join(f"{value:.6f}" for value in (*position_m, length_m, heading_rad))
    return f"{index},{text_from_stamp_ns(stamp_ns)},{numbers}\n"

"""Known points on the command line, `--at SECONDS:X,Y`, and the track laid on their map."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from pdr_bringup_scripts.problems import Problem
from pdr_core.conventions import nanoseconds
from pdr_core.recording import Arrivals, Sensor
from pdr_core.recording.tum import append_tum, in_frame, read_tum, write_tum_header
from pdr_core.records_external import ExternalFrame, FixBlock, unknown_yaws

NUMBER = r"([-+]?\d+\.?\d*)"
POINT = re.compile(rf"{NUMBER}:{NUMBER},{NUMBER}")
ON_MAP = "trajectory_map.tum"


class KnownPoint(NamedTuple):
    """The person says where on the map she is, some time after the first sample."""

    at_s: float
    x_m: float
    y_m: float


def known_point(text: str) -> KnownPoint:
    """Return a point as it is typed; Problem if it is none."""
    found = POINT.fullmatch(text.replace(" ", ""))
    if not found:
        raise Problem(f"--at {text}: give seconds since the first sample and a place on the map, as --at 12.5:3.0,-4")
    return KnownPoint(*map(float, found.groups()))


def arrivals_of(points: Sequence[KnownPoint], sensor: Sensor) -> Arrivals:
    """Return the points as they would have come; Problem if the recording ends before one."""
    told = sorted(points)
    stamps = np.concatenate([piece.stamp_ns for piece in sensor.pieces()])
    if not len(stamps):
        return Arrivals(FixBlock(stamps, np.zeros((0, 3)), np.zeros((0, 3)), unknown_yaws(0)), stamps)
    at_ns = int(stamps[0]) + np.array([nanoseconds(point.at_s) for point in told], np.int64)
    if at_ns[-1] > stamps[-1] or at_ns[0] < stamps[0]:
        length_s = (stamps[-1] - stamps[0]) * 1e-9
        raise Problem(f"--at {told[-1].at_s:g}: the recording of {sensor.name} lasts {length_s:.1f} s")
    places_m = np.array([[point.x_m, point.y_m, 0.0] for point in told])
    fixes = FixBlock(at_ns, places_m, np.zeros((len(told), 3)), unknown_yaws(len(told)))
    return Arrivals(fixes, np.searchsorted(stamps, at_ns, side="right"))


def write_on_map(folder: Path, frame: ExternalFrame) -> None:
    """Write the trajectory of a folder once more, in their frame."""
    theirs = in_frame(read_tum(folder / "trajectory.tum"), frame)
    with (folder / ON_MAP).open("w") as file:
        write_tum_header(file)
        append_tum(file, theirs)

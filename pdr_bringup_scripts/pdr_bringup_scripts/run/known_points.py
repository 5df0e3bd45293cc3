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
from pdr_core.records import Stamps
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


def arrivals_of(points: Sequence[KnownPoint], sensors: Sequence[Sensor]) -> Arrivals:
    """Return the points as they would have come, each sensor's time counted from its own first sample.

    They are stamped as the first sensor is; Problem if its recording ends before one, or two are of one moment.
    """
    stamps = [stamps_of(sensor) for sensor in sensors]
    told = sorted(points) if all(map(len, stamps)) else []  # without samples there is nothing to lay anywhere
    at_ns = np.array([nanoseconds(point.at_s) for point in told], np.int64)
    first_ns, last_ns = stamps[0][[0, -1]] if told else (0, 0)
    outside, again = (at_ns < 0) | (at_ns > last_ns - first_ns), np.diff(at_ns) == 0
    if outside.any():
        at_s, length_s = told[outside.argmax()].at_s, (last_ns - first_ns) * 1e-9
        raise Problem(f"--at {at_s:g}: the recording of {sensors[0].name} lasts {length_s:.1f} s")
    if again.any():
        raise Problem(f"--at {told[again.argmax()].at_s:g} is given twice: say one place for one moment")
    places_m = np.array([[point.x_m, point.y_m, 0.0] for point in told]).reshape(-1, 3)
    fixes = FixBlock(first_ns + at_ns, places_m, np.zeros((len(told), 3)), unknown_yaws(len(told)))
    return Arrivals(fixes, np.column_stack([np.searchsorted(ns - ns[:1], at_ns, side="right") for ns in stamps]))


def stamps_of(sensor: Sensor) -> Stamps:
    """Return the stamps of all samples, (n,)."""
    return np.concatenate([np.zeros(0, np.int64), *(piece.stamp_ns for piece in sensor.pieces())])


def write_on_map(folder: Path, frame: ExternalFrame) -> None:
    """Write the trajectory of a folder once more, in their frame."""
    theirs = in_frame(read_tum(folder / "trajectory.tum"), frame)
    with (folder / ON_MAP).open("w") as file:
        write_tum_header(file)
        append_tum(file, theirs)

"""A walk round a campus after Gui figure 6: straight lines in directions of no building, curves between them, closed.

The figure has no numbers. Here arcs join six lines, four of which fit no spacing of 30, 45 or 90 degrees. The first
four lines keep their shares; the last two, and the scale of the shares, make the walk close and have its length.
"""

from typing import NamedTuple

import numpy as np

HEADINGS_DEG = (0.0, 50.0, 125.0, 180.0, 250.0, 310.0, 360.0)  # of the lines; the walk ends as it began
SHARES = (1.0, 0.5, 0.7, 0.8)  # of the first four lines
ARC_DEG = 8.0  # that a stride turns on an arc: a radius of 9 m
SHORTEST_M = 100.0


class Pace(NamedTuple):
    """One stride along the chord of an arc; left is positive."""

    length_m: float
    turn_rad: float


def campus(length_m: float, stride_m: float) -> list[Pace]:
    """Return the strides of a closed walk of `length_m`, at least 100 m; those on lines are about `stride_m` long."""
    headings_rad = np.radians(HEADINGS_DEG)
    arcs = [arc(turn_rad, stride_m) for turn_rad in np.diff(headings_rad)]
    walked: list[Pace] = []
    for line_m, bend in zip(lines_m(max(SHORTEST_M, length_m), arcs), arcs, strict=True):
        count = max(1, round(line_m / stride_m))
        walked += [Pace(line_m / count, 0.0)] * count + bend
    return walked


def arc(turn_rad: float, stride_m: float) -> list[Pace]:
    """Return strides along an arc."""
    count = round(np.degrees(turn_rad) / ARC_DEG)
    return [Pace(stride_m, float(turn_rad) / count)] * count


def lines_m(length_m: float, arcs: list[list[Pace]]) -> list[float]:
    """Return the lengths of the lines: three equations, x and y of the end and the length of the walk."""
    headings_rad = np.radians(HEADINGS_DEG[:-1])
    curved_m = np.sum([chords_m(bend, start) for bend, start in zip(arcs, headings_rad, strict=True)], axis=0)
    ahead = np.vstack([np.cos(headings_rad), np.sin(headings_rad), np.ones(len(headings_rad))])
    shared = ahead[:, :4] @ SHARES
    unknown = np.column_stack([shared, ahead[:, 4:]])
    scale_m, *last_m = np.linalg.solve(unknown, np.array([0.0, 0.0, length_m]) - curved_m)
    return [*(scale_m * np.array(SHARES)), *last_m]


def chords_m(bend: list[Pace], start_rad: float) -> np.ndarray:
    """Return how far an arc leads, x, y and length, (3,), that begins in a direction."""
    turn_rad, stride_m = np.array([p.turn_rad for p in bend]), np.array([p.length_m for p in bend])
    chord_rad = start_rad + np.cumsum(turn_rad) - 0.5 * turn_rad
    return np.array([stride_m @ np.cos(chord_rad), stride_m @ np.sin(chord_rad), stride_m.sum()])

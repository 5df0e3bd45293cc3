"""Directions that the walk itself has shown: a corridor is walked again, and back.

A line whose heading is far from all known directions shows a new one, if the yaw is still known well enough to say so.
"""

from math import pi

from pdr_core.heading.line import Heading, Line
from pdr_core.heading.straight import LastStrides
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import HeadingParams
from pdr_core.records import HeadingSource


class LearnedDirections:
    """The directions of the lines walked so far; there and back are alike."""

    source = HeadingSource.STRAIGHT_WALK

    def __init__(self, params: HeadingParams) -> None:
        self._new_gate = params.learn_gate
        self._yaw_sd_max_rad = params.learn_yaw_sd_max_rad
        self._known: list[Line] = []  # each the first of its direction

    def line(self, strides: LastStrides, seen: Heading, own_rad2: float) -> Line | None:  # noqa: ARG002
        """Return a line in the nearest direction known; one of a new direction learns it."""
        nearest = min(self._known, key=lambda known: _off_rad(known, seen), default=None)
        line = nearest.repeated(2.0 * own_rad2, pi) if nearest else None  # the line that showed it was off it too
        if line and line.fits(seen, self._new_gate):
            return line
        if seen.yaw_variance_rad2 >= self._yaw_sd_max_rad**2:
            return None
        self._known.append(Line(seen.heading_rad))
        return self._known[-1]


def _off_rad(known: Line, seen: Heading) -> float:
    return abs(wrapped_rad(seen.heading_rad - known.direction_rad, pi))

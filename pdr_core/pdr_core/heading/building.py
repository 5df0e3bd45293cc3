"""Heuristic drift elimination, HDE: straight lines follow the directions of the building (Gui section 4.1).

Gui says of Borenstein's HDE that it takes a building to have four directions and a walk to go along its corridors, and
spaces the directions by 45 or 30 deg. How the building stands in the world is given, or its first line shows it.
"""

from pdr_core.heading.line import Heading, Line
from pdr_core.heading.straight import LastStrides
from pdr_core.maths.circular import TURN_RAD
from pdr_core.params import HeadingParams
from pdr_core.records import HeadingSource


class BuildingDirections:
    """Directions with the same angle between neighbours."""

    source = HeadingSource.BUILDING

    def __init__(self, params: HeadingParams) -> None:
        self._spacing_rad = TURN_RAD / params.building_directions
        given = params.building_from == "given"
        self._given = Line(params.building_heading_rad, 0.0) if given else None
        self._first: Line | None = None

    def line(self, strides: LastStrides, seen: Heading, own_rad2: float) -> Line:  # noqa: ARG002  (the form of all)
        """Return a line in the directions of the building; where these are not given, the first one learns them."""
        if self._given:
            return self._given.repeated(own_rad2, self._spacing_rad)
        if self._first:
            return self._first.repeated(2.0 * own_rad2, self._spacing_rad)  # the first line was off them too
        self._first = Line(seen.heading_rad)
        return self._first

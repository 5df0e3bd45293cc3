"""Improved heuristic drift elimination, iHDE: as HDE, but what fits badly counts less (Gui section 4.1).

Gui says of Jimenez's iHDE no more than that it improves HDE. What is better here is our own: a line counts by how
straight its first strides are and how near to a direction. With d their largest deviation in the straight-walk test,
its limit, and r the distance to the nearest direction, which is half the spacing at most,

    weight = (1 - d / limit) (1 - r / (spacing / 2)),    variance of the direction = variance / weight:

between two directions, and on the verge of a curve, the building says nothing of the line.
"""

from pdr_core.heading.building import BuildingDirections
from pdr_core.heading.line import Heading, Line
from pdr_core.heading.straight import LastStrides
from pdr_core.params import HeadingParams


class WeightedBuildingDirections(BuildingDirections):
    """Directions of a building that count by how well a line fits."""

    def __init__(self, params: HeadingParams) -> None:
        super().__init__(params)
        self._straight_max_rad = params.straight_max_rad

    def line(self, strides: LastStrides, seen: Heading, own_rad2: float) -> Line:
        """Return the line with the variance that its fit leaves."""
        line = super().line(strides, seen, own_rad2)
        if line is self._first:
            return line
        straight = 1.0 - strides.largest_deviation_rad / self._straight_max_rad
        near = 1.0 - 2.0 * abs(line.off_rad(seen.heading_rad)) / line.spacing_rad
        return line.weighted(straight * near)

"""What a kind of heading constraint knows: which direction a straight line has."""

from typing import Protocol

from pdr_core.heading.line import Heading, Line
from pdr_core.heading.straight import LastStrides
from pdr_core.records import HeadingSource


class Directions(Protocol):
    """Knows the directions of straight lines, or learns them."""

    source: HeadingSource

    def line(self, strides: LastStrides, seen: Heading, own_rad2: float) -> Line | None:
        """Return the line that begins with the last strides, None if it shall not be held.

        `seen` is their mean heading, `own_rad2` the variance of what true lines are off their directions.
        """

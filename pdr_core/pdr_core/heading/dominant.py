"""The dominant direction (Gui eq. 9): each straight line is held in the direction in which it began.

The first line has the mean direction of its first strides. A later one has the direction of the line before, plus the
change over the curve between them, which Gui never defines. All that is known of this change is what the estimate says:
the mean of the first strides of the new line minus the heading at the end of the line before. The filter has been told
what that heading was off, so by its own account nothing is left of it: there the heading is psi_main(m-1). Then

    psi_main(m) = psi_main(m-1) + (mean of new line - psi_main(m-1)) = mean of new line,

and what the estimate turns in a curve stays. (Taking the last strides of the old line instead adds up, line after line,
by how much people begin a curve in the last strides before it; on real walks it turned the track by up to 11 deg.)
"""

from pdr_core.heading.line import Heading, Line
from pdr_core.heading.straight import LastStrides
from pdr_core.records import HeadingSource


class DominantDirection:
    """Nothing is known of the direction of a line before it begins."""

    source = HeadingSource.STRAIGHT_WALK

    def line(self, strides: LastStrides, seen: Heading, own_rad2: float) -> Line:  # noqa: ARG002  (the form of all)
        """Return a line that learns its direction."""
        return Line(seen.heading_rad)

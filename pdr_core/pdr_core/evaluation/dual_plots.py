"""Both feet: mean tracks, where they end, and how their headings drift (paper 004, figures 3 and 4, eq. 4-6)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from pdr_core.evaluation import style
from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

COLOURS = {"left": style.BLUE, "right": style.GREEN, "direction": style.PURPLE, "truth": style.ORANGE}
DASHES = {"alone": "dot", "together": "solid", "": "dash"}


class Curve(NamedTuple):
    """A line or a cloud of points."""

    what: str  # left, right, direction (in which the person walks) or truth
    how: str  # alone, together; empty: the truth
    x: Floats  # (n,)
    y: Floats  # (n,)

    @property
    def name(self) -> str:
        """What the legend says."""
        return f"{self.what}, {self.how}" if self.how else self.what


def tracks(curves: Sequence[Curve], *, to_scale: bool) -> "Figure":
    """Return tracks from above; not to scale, so that what is across a long straight walk can be seen."""
    fig = style.figure("x [m]", "y [m]")
    lines(fig, curves, "m")
    fig.update_layout(hovermode="closest")
    if to_scale:
        fig.update_yaxes(scaleanchor="x", scaleratio=1)
    return fig


def ends(curves: Sequence[Curve]) -> "Figure":
    """Return by how much the last steps are off, as paper 004 figure 4: along the walk and across."""
    fig = style.figure("Error along the walk [m]", "Error across the walk [m]")
    for c in curves:
        look = {"color": COLOURS[c.what], "size": 9, "symbol": "circle-open" if c.how == "alone" else "circle"}
        fig.add_scatter(x=style.listed(c.x), y=style.listed(c.y), name=c.name, mode="markers", marker=look)
    fig.update_layout(hovermode="closest")
    return fig


def drifts(curves: Sequence[Curve]) -> "Figure":
    """Return the heading errors [deg] over the time of the walk."""
    fig = style.figure(style.TIME, "Heading error [°]")
    lines(fig, curves, "°")
    return fig


def lines(fig: "Figure", curves: Sequence[Curve], unit: str) -> None:
    """Add every curve as a line: a foot keeps its colour, alone it is dotted; a name stands in the legend once."""
    first = {c.name: id(c) for c in reversed(curves)}
    for c in curves:
        listed = first[c.name] == id(c)
        style.line(fig, c.name, c.x, c.y, COLOURS[c.what], unit=unit, dash=DASHES[c.how], showlegend=listed)

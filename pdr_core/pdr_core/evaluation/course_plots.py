"""Several tracks of one walk over one another: from above, and their headings over time."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from pdr_core.evaluation import style
from pdr_core.evaluation.style import BESIDE_TRUTH
from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure


class CourseTrack(NamedTuple):
    """Where a foot went and how it turned, from the origin."""

    name: str
    time_s: Floats  # (n,) since the start of the walk
    position_m: Floats  # (n, 3)
    heading_deg: Floats  # (n,) counter-clockwise; it goes on at 180 degrees and does not jump


def courses(estimates: Sequence[CourseTrack], truth: CourseTrack) -> "Figure":
    """Return the tracks from above."""
    fig = style.figure("x [m]", "y [m]")
    for track, colour, dash in looks(estimates, truth):
        style.line(fig, track.name, track.position_m[:, 0], track.position_m[:, 1], colour, dash=dash)
    return style.from_above(fig)


def headings(estimates: Sequence[CourseTrack], truth: CourseTrack) -> "Figure":
    """Return the headings over time as Qiu figure 14 has them, but without jumps at 180 degrees."""
    fig = style.figure(style.TIME, "Heading [°]")
    for track, colour, dash in looks(estimates, truth):
        style.line(fig, track.name, track.time_s, track.heading_deg, colour, unit="°", dash=dash)
    fig.update_yaxes(dtick=90)
    return fig


def heights(estimates: Sequence[CourseTrack], truth: CourseTrack) -> "Figure":
    """Return the heights over time."""
    fig = style.figure(style.TIME, "Height z [m]")
    for track, colour, dash in looks(estimates, truth):
        style.line(fig, track.name, track.time_s, track.position_m[:, 2], colour, dash=dash)
    return fig


def looks(estimates: Sequence[CourseTrack], truth: CourseTrack) -> list[tuple[CourseTrack, str, str]]:
    """Return each track with its colour and dash; the truth lies below."""
    coloured = [(track, BESIDE_TRUTH[i % len(BESIDE_TRUTH)], "solid") for i, track in enumerate(estimates)]
    return [(truth, style.ORANGE, "dash"), *coloured]

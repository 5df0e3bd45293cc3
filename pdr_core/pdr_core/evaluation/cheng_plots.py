"""Figures 4 to 6, 8 and 9 of Cheng: K in theory and in the real loop, and the error at every footfall."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from pdr_core.evaluation import style
from pdr_core.evaluation.style import BESIDE_TRUTH
from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure


class Line(NamedTuple):
    """A line of a figure; one point alone is a mark."""

    name: str
    x: Floats  # (n,)
    y: Floats  # (n,)


def over_number(lines: Sequence[Line], y_title: str, unit: str) -> "Figure":
    """Return lines over the K of eq. 14-22, a number between 0 and 1 of any magnitude."""
    fig = over_rate(lines, y_title, unit)
    fig.update_xaxes(title_text="K", type="log", exponentformat="power", dtick=1)
    return fig


def over_rate(lines: Sequence[Line], y_title: str, unit: str) -> "Figure":
    """Return lines over the K of the real loop, a rate; what is not positive has no place."""
    fig = style.figure("K [1/s]", y_title)
    for line, colour in zip(lines, BESIDE_TRUTH, strict=False):
        style.line(fig, line.name, line.x, style.positive(line.y), colour, unit=unit)
        if len(line.x) == 1:
            fig.data[-1].update(mode="markers", marker={"size": 10, "symbol": "diamond"})
    fig.update_yaxes(type="log", exponentformat="power")
    return fig


def footfalls(errors_m: Mapping[str, tuple[Floats, Floats]]) -> "Figure":
    """Return the distance to the truth at every footfall, {method: (time [s], error [m])} (figure 8)."""
    fig = style.figure(style.TIME, "Position error [m]")
    for (name, (time_s, error_m)), colour in zip(errors_m.items(), BESIDE_TRUTH, strict=False):
        style.line(fig, name, time_s, error_m, colour)
        fig.data[-1].update(mode="lines+markers", marker={"size": 5})
    return fig

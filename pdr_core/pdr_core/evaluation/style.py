"""One look for all figures: colours that colour-blind people can tell apart (Okabe and Ito 2008; Tol 2021) on white."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

BLUE = "#0072B2"  # the estimate
ORANGE = "#D55E00"  # the truth
GREEN = "#009E73"  # stance, height
PURPLE = "#AA4499"  # the end
INK = "#222222"
COLOURS = (BLUE, ORANGE, GREEN, PURPLE, "#56B4E9", "#E69F00", INK, "#882255", "#999933")  # of lines side by side
BESIDE_TRUTH = tuple(colour for colour in COLOURS if colour != ORANGE)  # where one line is the truth
PALE_BLUE = "rgba(0, 114, 178, 0.18)"
PALE_GREEN = "rgba(0, 158, 115, 0.22)"
GRID = "#E3E6E8"
TIME = "Time since the start [s]"
POINTS = 6_000  # of one line: more than a screen has columns


def figure(x_title: str, y_title: str) -> "Figure":
    """Return an empty figure with titled axes."""
    from plotly.graph_objects import Figure

    fig = Figure()
    dress(fig)
    fig.update_xaxes(title_text=x_title)
    fig.update_yaxes(title_text=y_title)
    return fig


def from_above(fig: "Figure", **which: Any) -> "Figure":
    """Return a figure whose lines are ways on the ground: a metre is as long in x as in y; `which` of them say so."""
    fig.update_traces(hovertemplate="x %{x:.2f} m, y %{y:.2f} m", **which)
    fig.update_yaxes(scaleanchor="x", scaleratio=1)
    fig.update_layout(hovermode="closest")
    return fig


def dress(fig: "Figure") -> None:
    """Give a figure the common look: a legend above, thin grid lines, room for the axes' titles."""
    fig.update_layout(
        template="none",
        autosize=True,
        font={"family": "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif", "size": 13, "color": INK},
        margin={"l": 62, "r": 16, "t": 36, "b": 52},
        legend={"orientation": "h", "x": 0, "y": 1.01, "xanchor": "left", "yanchor": "bottom"},
        hovermode="x unified",
        hoverlabel={"bgcolor": "white"},
    )
    axis = {"gridcolor": GRID, "zeroline": False, "linecolor": "#9AA0A4", "showline": True, "automargin": True}
    fig.update_xaxes(**axis)
    fig.update_yaxes(**axis)


def line(
    fig: "Figure",
    name: str,
    x: Floats,
    y: Floats,
    colour: str,
    *,
    unit: str = "m",
    dash: str = "solid",
    width: float = 2,
    digits: int = 6,
    **more: Any,
) -> None:
    """Add a line through points (n,), thinned to what a screen can show; what is not finite leaves a gap."""
    every = slice(None, None, max(1, math.ceil(len(x) / POINTS)))
    look = {"color": colour, "width": width, "dash": dash}
    hover = f"%{{y:.3~f}} {unit}"
    fig.add_scatter(
        x=listed(x[every]), y=listed(y[every], digits), name=name, mode="lines", line=look, hovertemplate=hover, **more
    )


def area(fig: "Figure", name: str, x: Floats, y: Floats, colour: str, **more: Any) -> None:
    """Add filled outlines, (n,), that NaN separates."""
    look = {"mode": "lines", "line": {"width": 0}, "fill": "toself", "fillcolor": colour, "hoverinfo": "skip"}
    fig.add_scatter(x=listed(x), y=listed(y), name=name, **look, **more)


def listed(values: Floats, digits: int = 6) -> list[float | None]:
    """Return values, (n,), as a short list: so many digits each, None where not finite."""
    return [float(f"{value:.{digits}g}") if math.isfinite(value) else None for value in values.tolist()]


def positive(values: Floats) -> Floats:
    """Return the values, (n,), NaN where a logarithm has none."""
    return np.where(values > 0.0, values, np.nan)

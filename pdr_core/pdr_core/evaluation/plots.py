"""The figures over time and over strides. A view is what `Scorer.view` returned, None where no truth can be drawn."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from pdr_core.evaluation import style
from pdr_core.evaluation.score import TruthView
from pdr_core.evaluation.trace import Trace, TracePoints
from pdr_core.records import Floats, StepEvent, TruthKind

if TYPE_CHECKING:
    from plotly.graph_objects import Figure


def stance(trace: Trace) -> "Figure":
    """Return the detector's statistic, if any, with its threshold on a logarithmic axis, the stances shaded."""
    points, edges_s = trace.points, np.array(trace.stance_intervals_s).reshape(-1, 2)
    fig = style.figure(style.TIME, "")
    outline = np.array([0.0, 1.0, 1.0, 0.0, 0.0, np.nan])
    style.area(fig, "Stance", edges_s[:, [0, 0, 1, 1, 0, 0]].ravel(), np.tile(outline, len(edges_s)), style.PALE_GREEN)
    if (points.statistic > 0.0).any():
        _add_statistic(fig, points)
    fig.update_layout(yaxis={"visible": False, "range": [0, 1], "fixedrange": True, "title": None})
    return fig


def _add_statistic(fig: "Figure", points: TracePoints) -> None:
    style.line(fig, "Statistic", points.time_s, style.positive(points.statistic), style.BLUE, unit="", width=1.2)
    style.line(fig, "Threshold", points.time_s, style.positive(points.threshold), style.ORANGE, unit="", dash="dash")
    for logarithmic in fig.data[1:]:
        logarithmic.update(yaxis="y2", hovertemplate="%{y:.3~g}")
    axis = {**fig.layout.yaxis.to_plotly_json(), "title": {"text": "Detector statistic [-]"}}
    fig.update_layout(yaxis2={**axis, "type": "log", "overlaying": "y", "dtick": 1, "exponentformat": "power"})


def height(trace: Trace, view: TruthView | None) -> "Figure":
    """Return the height over time with its 1-sigma band, and the true height where it is known."""
    points = trace.points
    z_m, sd_m = points.position_m[:, 2], points.height_sd_m
    fig = style.figure(style.TIME, "Height z [m]")
    _add_band(fig, points.time_s, z_m - sd_m, z_m + sd_m)
    if view and view.kind is TruthKind.POSITION:
        style.line(fig, "Truth", view.time_s, view.truth_m[:, 2], style.ORANGE, dash="dash")
    style.line(fig, "Estimate", points.time_s, z_m, style.BLUE)
    return fig


def error(view: TruthView) -> "Figure":
    """Return the error against the truth: over time, or stride by stride where only the footfalls are known."""
    error_m = view.estimate_m - view.truth_m
    horizontal_m = np.hypot(error_m[:, 0], error_m[:, 1])
    if view.kind is TruthKind.STRIDES:
        fig = style.figure("Stride", "Error [m]")
        style.line(fig, "Horizontal error", np.arange(len(error_m), dtype=np.float64), horizontal_m, style.BLUE)
        fig.update_traces(mode="lines+markers")
    else:
        fig = style.figure(style.TIME, "Error [m]")
        style.line(fig, "Horizontal error", view.time_s, horizontal_m, style.BLUE)
        style.line(fig, "Height error", view.time_s, error_m[:, 2], style.ORANGE, width=1.2)
    fig.update_yaxes(rangemode="tozero", zeroline=True, zerolinecolor=style.INK, zerolinewidth=1)
    return fig


def deviation(trace: Trace) -> "Figure":
    """Return the growth of the standard deviation: what is known of the error where there is no truth."""
    points = trace.points
    fig = style.figure(style.TIME, "Standard deviation [m]")
    style.line(fig, "Horizontal (larger axis)", points.time_s, points.horizontal_sd_m, style.BLUE)
    style.line(fig, "Height", points.time_s, points.height_sd_m, style.ORANGE, dash="dash")
    fig.update_yaxes(rangemode="tozero")
    return fig


def strides(steps: Sequence[StepEvent], counts: str = "stride") -> "Figure":
    """Return length and heading of every stride or step, one above the other; the bars are 1 sigma of the heading."""
    from plotly.subplots import make_subplots

    fig = make_subplots(rows=2, cols=1, shared_xaxes=True, vertical_spacing=0.08)
    style.dress(fig)
    index = [step.index for step in steps]
    heading_rad = np.unwrap([step.heading_rad for step in steps])
    bars = {"array": style.listed(np.rad2deg([step.heading_sd_rad for step in steps])), "thickness": 1}
    length = {"y": style.listed(np.array([step.length_m for step in steps])), "name": "Length"}
    heading = {"y": style.listed(np.rad2deg(heading_rad)), "name": "Heading", "error_y": bars}
    look = {"x": index, "mode": "lines+markers", "marker": {"size": 6}}
    fig.add_scatter(**look, **length, line={"color": style.BLUE}, hovertemplate="%{y:.2f} m", row=1, col=1)
    fig.add_scatter(**look, **heading, line={"color": style.ORANGE}, hovertemplate="%{y:.1f}°", row=2, col=1)
    fig.update_yaxes(title_text="Length [m]", rangemode="tozero", row=1, col=1)
    quarters = {"dtick": 90} if np.ptp(heading_rad) > np.pi else {}
    fig.update_yaxes(title_text="Heading [°]", **quarters, row=2, col=1)
    fig.update_xaxes(title_text=counts.capitalize(), row=2, col=1)
    return fig


def _add_band(fig: "Figure", time_s: Floats, low: Floats, high: Floats) -> None:
    """Add the area between two lines, (n,)."""
    rows = slice(None, None, max(1, len(time_s) * 2 // style.POINTS))
    time_s, low, high = time_s[rows], low[rows], high[rows]
    known = np.isfinite(low + high)
    there_and_back_s = np.concatenate([time_s[known], time_s[known][::-1]])
    style.area(
        fig, "Uncertainty (1 σ)", there_and_back_s, np.concatenate([high[known], low[known][::-1]]), style.PALE_BLUE
    )

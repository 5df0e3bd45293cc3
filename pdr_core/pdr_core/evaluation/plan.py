"""The walk seen from above."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from pdr_core.evaluation import style
from pdr_core.evaluation.score import TruthView
from pdr_core.evaluation.trace import Trace, TracePoints
from pdr_core.records import Floats, StepEvent, TruthKind

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

ELLIPSES = 12  # at most, spread over the walk
CIRCLE = np.array([np.cos(np.linspace(0, 2 * np.pi, 33)), np.sin(np.linspace(0, 2 * np.pi, 33))])  # (2, 33)


def plan(trace: Trace, steps: Sequence[StepEvent], view: TruthView | None) -> "Figure":
    """Return the track from above: estimate, truth laid onto it, footfalls, 1-sigma ellipses, start and end."""
    points = trace.points
    fig = style.figure("x [m]", "y [m]")
    if steps:
        outline_x_m, outline_y_m = _ellipses(trace, points, steps)
        style.area(fig, "Uncertainty (1 σ)", outline_x_m, outline_y_m, style.PALE_BLUE)
    if view:
        _add_truth(fig, view)
    style.line(fig, "Estimate", points.position_m[:, 0], points.position_m[:, 1], style.BLUE)
    if steps:
        _add_footfalls(fig, steps)
    _add_mark(fig, "Start", points.position_m[0], "triangle-up", style.GREEN)
    _add_mark(fig, "End", points.position_m[-1], "square", style.PURPLE)
    return style.from_above(fig, selector={"mode": "lines"})


def _add_truth(fig: "Figure", view: TruthView) -> None:
    """Add the truth: a line, with marks where only the footfalls are known."""
    style.line(fig, "Truth", view.truth_m[:, 0], view.truth_m[:, 1], style.ORANGE, dash="dash")
    if view.kind is TruthKind.STRIDES:
        fig.data[-1].update(mode="lines+markers", marker={"symbol": "x", "size": 7, "color": style.ORANGE})


def _add_footfalls(fig: "Figure", steps: Sequence[StepEvent]) -> None:
    position_m = np.array([step.position_m for step in steps])
    texts = [f"stride {step.index}: {step.length_m:.2f} m" for step in steps]
    fig.add_scatter(
        x=style.listed(position_m[:, 0]),
        y=style.listed(position_m[:, 1]),
        text=texts,
        name="Footfalls",
        mode="markers",
        marker={"size": 7, "color": "white", "line": {"color": style.BLUE, "width": 1.5}},
        hovertemplate="%{text}<br>x %{x:.2f} m, y %{y:.2f} m",
    )


def _add_mark(fig: "Figure", name: str, position_m: Floats, symbol: str, colour: str) -> None:
    look = {"symbol": symbol, "size": 14, "color": colour, "line": {"color": "white", "width": 1.5}}
    x, y = style.listed(position_m[:2])
    fig.add_scatter(x=[x], y=[y], name=name, mode="markers", marker=look, hovertemplate="x %{x:.2f} m, y %{y:.2f} m")


def _ellipses(trace: Trace, points: TracePoints, steps: Sequence[StepEvent]) -> Floats:
    """Return the outlines, (2, n) [m], of the 1-sigma ellipses at some footfalls, NaN between them."""
    chosen = [steps[i] for i in np.unique(np.linspace(0, len(steps) - 1, ELLIPSES).round().astype(int))]
    time_s = trace.seconds(np.array([step.stamp_ns for step in chosen]))
    rows = np.minimum(np.searchsorted(points.time_s, time_s), len(points.time_s) - 1)
    gap = np.full((2, 1), np.nan)
    outlines = []
    for step, row in zip(chosen, rows, strict=True):
        variance_m2, axes = np.linalg.eigh(points.horizontal_covariance_m2[row])
        outline_m = step.position_m[:2, None] + axes * np.sqrt(np.maximum(variance_m2, 0.0)) @ CIRCLE
        outlines += [outline_m, gap]
    return np.hstack(outlines)

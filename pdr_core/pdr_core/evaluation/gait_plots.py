"""The figures of gait analysis (Qiu figures 10 to 14), of bounded size however long the walk."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from pdr_core.evaluation import style
from pdr_core.evaluation.trace import Trace
from pdr_core.records import Floats
from pdr_core.records_gait import CYCLE_POINTS, Stride

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

POINTS = 3_000  # of one line
CURVES = 80  # of single strides in one figure
MOST_BARS = 60
FAINT = "rgba(0, 114, 178, 0.16)"
SHORTEST_SD = 1e-6  # of lengths that have a density


def lengths(strides: Sequence[Stride], counts: str = "stride") -> "Figure":
    """Return the distribution of the stride or step lengths: histogram, kernel density, normal fit (Qiu figure 12)."""
    length_m = np.array([stride.step.length_m for stride in strides])
    density, edges_m = np.histogram(length_m, _edges(length_m), density=True)
    middle_m, width_m = 0.5 * (edges_m[1:] + edges_m[:-1]), float(edges_m[1] - edges_m[0])
    fig = style.figure(f"{counts.capitalize()} length [m]", "Density [1/m]")
    look = {"marker": {"color": style.PALE_BLUE, "line": {"color": style.BLUE, "width": 1}}, "width": width_m}
    fig.add_bar(x=style.listed(middle_m), y=style.listed(density), name="Histogram", **look, hovertemplate="%{y:.3~g}")
    sd_m = float(np.std(length_m, ddof=1)) if len(length_m) > 2 else 0.0
    if sd_m > SHORTEST_SD:
        _add_densities(fig, length_m, sd_m)
    return fig


def _edges(values: Floats) -> Floats:
    """Return the edges of at least one bar and not too many."""
    if np.ptp(values) <= SHORTEST_SD:
        return np.array([-0.05, 0.05]) + values[0]
    edges = np.histogram_bin_edges(values, "auto")
    return edges if len(edges) <= MOST_BARS + 1 else np.linspace(edges[0], edges[-1], MOST_BARS + 1)


def _add_densities(fig: "Figure", length_m: Floats, sd_m: float) -> None:
    """Add the kernel density and the normal distribution of the same mean and deviation."""
    from scipy.stats import gaussian_kde  # takes half a second to load

    grid_m = np.linspace(max(0.0, length_m.min() - 2.0 * sd_m), length_m.max() + 2.0 * sd_m, 200)
    mean_m = length_m.mean()
    normal = np.exp(-0.5 * ((grid_m - mean_m) / sd_m) ** 2) / (sd_m * math.sqrt(2.0 * math.pi))
    style.line(fig, "Kernel density", grid_m, gaussian_kde(length_m)(grid_m), style.BLUE, unit="")
    name = f"Normal, {mean_m:.2f} ± {sd_m:.2f} m"
    style.line(fig, name, grid_m, normal, style.ORANGE, unit="", dash="dash")


def pitch(strides: Sequence[Stride]) -> "Figure":
    """Return the pitch of the foot over the cycle: strides faint, their mean bold (Qiu figure 13)."""
    known_deg = np.degrees([stride.pitch_cycle_rad for stride in strides if stride.pitch_cycle_rad is not None])
    every = max(1, math.ceil(len(known_deg) / CURVES))
    shown_deg = np.column_stack([known_deg[::every], np.full(len(known_deg[::every]), np.nan)])
    percent = np.arange(CYCLE_POINTS, dtype=np.float64)
    fig = style.figure("Share of the stride [%]", "Foot pitch [°]")
    look = {"mode": "lines", "line": {"color": FAINT, "width": 1}, "hoverinfo": "skip"}
    x = np.tile(np.append(percent, np.nan), len(shown_deg))
    fig.add_scatter(x=style.listed(x), y=style.listed(shown_deg.ravel(), 3), name="Strides", **look)
    mean_deg: Floats = known_deg.mean(axis=0)
    style.line(fig, "Mean", percent, mean_deg, style.ORANGE, unit="°", width=3)
    return fig


def climb(strides: Sequence[Stride]) -> "Figure":
    """Return height and clearance over the distance walked, one above the other (Qiu figures 10 and 11)."""
    from plotly.subplots import make_subplots

    fig = make_subplots(rows=2, cols=1, shared_xaxes=True, vertical_spacing=0.08)
    style.dress(fig)
    rows = _thinned(len(strides))
    walked_m = np.cumsum([stride.step.length_m for stride in strides])[rows]
    height_m = np.array([stride.step.position_m[2] for stride in strides])[rows]
    clearance_m = np.array([math.nan if s.clearance_m is None else s.clearance_m for s in strides])[rows]
    style.line(fig, "Height of the foot", walked_m, height_m, style.BLUE, row=1, col=1, digits=5)
    style.line(fig, "Clearance", walked_m, clearance_m, style.GREEN, row=2, col=1, digits=3)
    fig.update_traces(mode="lines+markers", marker={"size": 5})
    fig.update_yaxes(title_text="Height [m]", row=1, col=1)
    fig.update_yaxes(title_text="Clearance [m]", rangemode="tozero", row=2, col=1)
    fig.update_xaxes(title_text="Distance walked [m]", row=2, col=1)
    return fig


def heading(strides: Sequence[Stride], trace: Trace, worn_on: str = "foot", counts: str = "stride") -> "Figure":
    """Return how far foot or chest, and walk, have turned over time, without jumps at half a turn (Qiu figure 14)."""
    time_s = trace.seconds(np.array([stride.step.stamp_ns for stride in strides]))
    foot_deg = np.rad2deg(np.cumsum([stride.turn_rad or 0.0 for stride in strides]))
    walk_deg = np.rad2deg(np.cumsum([stride.heading_change_rad or 0.0 for stride in strides]))
    fig = style.figure(style.TIME, "Turned [°]")
    rows = _thinned(len(strides))
    style.line(fig, f"Direction of the {counts}s", time_s[rows], walk_deg[rows], style.ORANGE, unit="°", dash="dot")
    style.line(fig, worn_on.capitalize(), time_s[rows], foot_deg[rows], style.BLUE, unit="°")
    if np.ptp(foot_deg) > 180.0:
        fig.update_yaxes(dtick=90)
    return fig


def velocity(trace: Trace) -> "Figure":
    """Return the velocity of the foot in the world frame (Qiu figure 10)."""
    points = trace.points
    rows = _thinned(len(points.time_s))
    time_s, velocity_mps = points.time_s[rows], points.velocity_mps[rows]
    fig = style.figure(style.TIME, "Velocity [m/s]")
    for axis, colour in enumerate((style.BLUE, style.ORANGE, style.GREEN)):
        style.line(fig, "xyz"[axis], time_s, velocity_mps[:, axis], colour, unit="m/s", width=1.2, digits=3)
    return fig


def _thinned(count: int) -> slice:
    """Return which of so many points are drawn."""
    return slice(None, None, max(1, math.ceil(count / POINTS)))

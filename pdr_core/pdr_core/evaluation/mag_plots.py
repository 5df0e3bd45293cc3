"""Figures of a calibrated magnetometer: the sphere in three dimensions, and the strength over time."""

import math
from typing import TYPE_CHECKING

import numpy as np

from pdr_core.evaluation import style
from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

MICROTESLA = 1e6
CLOUD = 4_000  # points of one cloud
MERIDIANS, PARALLELS, CORNERS = 12, 7, 49


def spheres(before_tesla: Floats, after_tesla: Floats, norm_tesla: float) -> "Figure":
    """Return the fields before and after, (n, 3) each, side by side, with the sphere on which they should lie."""
    from plotly.subplots import make_subplots

    titles = ("Before: in the sensor's axes", "After: about the origin")
    scene = {"type": "scene"}
    fig = make_subplots(rows=1, cols=2, specs=[[scene, scene]], subplot_titles=titles, horizontal_spacing=0.02)
    style.dress(fig)
    _add_cloud(fig, 1, "Measured", before_tesla, style.ORANGE)
    _add_cloud(fig, 2, "Calibrated", after_tesla, style.BLUE)
    for column in (1, 2):
        _add_sphere(fig, column, norm_tesla)
    axes = {f"{axis}axis": {"title": f"{axis} [µT]", "gridcolor": style.GRID} for axis in "xyz"}
    fig.update_scenes(aspectmode="data", camera={"eye": {"x": 1.5, "y": 1.5, "z": 0.9}}, **axes)
    fig.update_layout(hovermode="closest", showlegend=False, margin={"l": 0, "r": 0, "t": 60, "b": 0})
    return fig


def strength(time_s: Floats, before_tesla: Floats, after_tesla: Floats, norm_tesla: float) -> "Figure":
    """Return the strength of the field before and after over time, (n,) and (n, 3), and what it should be."""
    fig = style.figure(style.TIME, "Strength [µT]")
    for name, field_tesla, colour in (("Before", before_tesla, style.ORANGE), ("After", after_tesla, style.BLUE)):
        norms = np.linalg.norm(field_tesla, axis=1) * MICROTESLA
        style.line(fig, name, time_s, norms, colour, unit="µT", width=1.2, digits=4)
    level = np.full(2, norm_tesla * MICROTESLA)
    style.line(fig, "The field", time_s[[0, -1]], level, style.INK, unit="µT", dash="dash", width=1.2)
    fig.update_yaxes(rangemode="tozero")
    return fig


def _add_cloud(fig: "Figure", column: int, name: str, field_tesla: Floats, colour: str) -> None:
    x, y, z = (style.listed(c, 4) for c in thinned(field_tesla).T * MICROTESLA)
    look = {"size": 2, "color": colour}
    hover = "x %{x:.1f}, y %{y:.1f}, z %{z:.1f} µT"
    fig.add_scatter3d(x=x, y=y, z=z, name=name, mode="markers", marker=look, hovertemplate=hover, row=1, col=column)


def _add_sphere(fig: "Figure", column: int, radius_tesla: float) -> None:
    x, y, z = (style.listed(c, 4) for c in grid() * radius_tesla * MICROTESLA)
    look = {"color": "rgba(34, 34, 34, 0.35)", "width": 1}
    more = {"name": "The field, in any direction", "hoverinfo": "skip"}
    fig.add_scatter3d(x=x, y=y, z=z, mode="lines", line=look, **more, row=1, col=column)


def thinned(field_tesla: Floats) -> Floats:
    """Return fields, (n, 3), evenly picked where a cloud cannot show more."""
    return field_tesla[:: max(1, math.ceil(len(field_tesla) / CLOUD))]


def grid() -> Floats:
    """Return meridians and parallels of the unit sphere, (3, n), with NaN between the lines."""
    around = np.linspace(0.0, 2.0 * np.pi, CORNERS)
    gap = np.full((3, 1), np.nan)
    lines = []
    for angle in np.linspace(0.0, np.pi, MERIDIANS // 2, endpoint=False):
        lines += [np.array([np.sin(around) * np.cos(angle), np.sin(around) * np.sin(angle), np.cos(around)]), gap]
    for z in np.sin(np.linspace(-0.5 * np.pi, 0.5 * np.pi, PARALLELS + 2)[1:-1]):
        across = np.sqrt(1.0 - z * z)
        lines += [np.array([across * np.cos(around), across * np.sin(around), np.full(CORNERS, z)]), gap]
    return np.hstack(lines)

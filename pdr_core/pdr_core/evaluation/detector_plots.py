"""The pictures that compare stance detectors on one recording."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pdr_core.evaluation import style
from pdr_core.evaluation.detector_curves import Curve, DetectorCurves
from pdr_core.evaluation.detector_study import WindowSteps
from pdr_core.evaluation.style import COLOURS
from pdr_core.evaluation.words import spoken
from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

ROW_PX, EDGES_PX = 130, 110
OUTLINE = np.array([0.0, 1.0, 1.0, 0.0, 0.0, np.nan])  # of a band that is 1 high
BANDS = (style.PALE_GREEN, style.PALE_BLUE, "rgba(170, 68, 153, 0.20)", "rgba(230, 159, 0, 0.25)")
DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot", "solid")


def detectors(curves: Sequence[DetectorCurves], speed: Curve | None) -> "Figure":
    """Return the true speed of the foot, and below it statistic, threshold and stances of each detector."""
    from plotly.subplots import make_subplots

    titles = [*(["Speed of the foot in truth"] if speed else []), *(spoken(c.detector) for c in curves)]
    rows, first = len(titles), 2 if speed else 1
    fig = make_subplots(
        rows=rows,
        cols=1,
        shared_xaxes=True,
        vertical_spacing=0.25 / rows,
        subplot_titles=titles,
        specs=[[{"secondary_y": True}]] * rows,
    )
    style.dress(fig)
    if speed:
        add_speed(fig, speed)
    for row, one in enumerate(curves, first):
        place = {"row": row, "col": 1, "showlegend": row == first}
        add_stances(fig, one.stance_s, place)
        add_statistic(fig, one, place)
        fig.update_yaxes(visible=False, range=[0, 1], fixedrange=True, row=row, col=1, secondary_y=False)
        fig.update_yaxes(**decades(one.statistic.value), side="left", row=row, col=1, secondary_y=True)
    fig.update_xaxes(domain=[0, 1])
    fig.update_xaxes(title_text=style.TIME, row=rows, col=1)
    fig.update_annotations(x=0, xanchor="left", font={"size": 13})
    fig.update_layout(height=ROW_PX * rows + EDGES_PX, hoversubplots="axis", legend={"y": 1.0 + 30 / (ROW_PX * rows)})
    return fig


def windows(found: WindowSteps, true_steps: int | None) -> "Figure":
    """Return the steps that each detector finds with windows of each length, and how many there were if known."""
    fig = style.figure("Length of the window [s]", "Steps found")
    for i, (detector, steps) in enumerate(found.steps.items()):
        colour, dash = COLOURS[i % len(COLOURS)], DASHES[i % len(DASHES)]
        y = style.positive(np.array(steps, dtype=np.float64))
        style.line(fig, spoken(detector), found.window_s, y, colour, unit="", dash=dash)
    if true_steps is not None:
        ends_s = found.window_s[[0, -1]]
        style.line(fig, "In truth", ends_s, np.full(2, float(true_steps)), style.INK, unit="", dash="dot", width=1.2)
    fig.update_yaxes(type="log", dtick="D2")
    return fig


def add_speed(fig: "Figure", speed: Curve) -> None:
    """Draw the true speed in the first row."""
    place: dict[str, Any] = {"row": 1, "col": 1}
    style.line(fig, "True speed", *speed, style.INK, unit="m/s", width=1.2, digits=3, **place)
    fig.update_yaxes(title_text="m/s", rangemode="tozero", secondary_y=False, **place)


def add_stances(fig: "Figure", stance_s: Mapping[str, Floats], place: Mapping[str, Any]) -> None:
    """Shade the stances; with several time gates in lanes, the first on top."""
    height = 1.0 / len(stance_s)
    for i, (gate, edges_s) in enumerate(stance_s.items()):
        name = "Stance" if len(stance_s) == 1 else f"Stance, gate {spoken(gate)}"
        x, y = edges_s[:, [0, 0, 1, 1, 0, 0]].ravel(), 1.0 - height * (i + 1.0 - OUTLINE)
        style.area(fig, name, x, np.tile(y, len(edges_s)), BANDS[i % len(BANDS)], legendgroup=name, **place)


def add_statistic(fig: "Figure", one: DetectorCurves, place: Mapping[str, Any]) -> None:
    """Draw statistic and threshold of a detector on a logarithmic axis."""
    looks = {"Statistic": (style.BLUE, "solid"), "Threshold": (style.ORANGE, "dash")}
    for (name, (colour, dash)), curve in zip(looks.items(), (one.statistic, one.threshold), strict=True):
        more = {"digits": 3, "legendgroup": name, "secondary_y": True, **place}
        style.line(fig, name, curve.time_s, style.positive(curve.value), colour, unit="", dash=dash, width=1.2, **more)


def decades(value: Floats) -> dict[str, Any]:
    """Return a logarithmic axis for values, (n,), with about four marks at powers of ten."""
    known = value[np.isfinite(value) & (value > 0.0)]
    wide = float(np.ptp(np.log10(known))) if len(known) else 1.0
    return {"type": "log", "dtick": max(1, round(wide / 3.0)), "exponentformat": "power"}

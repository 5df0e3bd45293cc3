"""The pictures that compare methods of orientation: Qiu figures 7, 12 and 13."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.stats import gaussian_kde, norm

from pdr_core.evaluation import style
from pdr_core.evaluation.detector_plots import DASHES
from pdr_core.evaluation.orientation_study import Drift, GaitErrors, PitchCycle
from pdr_core.evaluation.style import COLOURS
from pdr_core.evaluation.words import spoken
from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

AXES = ("Forward", "Left", "Up")
FEWEST = 3  # errors that a density can be drawn of
ROW_PX = 190


def stride_errors(gait: Mapping[str, GaitErrors]) -> "Figure":
    """Return histogram, kernel density and normal fit of the error of the stride length, a row for each method."""
    from plotly.subplots import make_subplots

    known = {method: 100.0 * g.length_error_m for method, g in gait.items() if len(g.length_error_m) >= FEWEST}
    titles = [f"{spoken(method)}: {e.mean():.2f} ± {e.std(ddof=1):.2f} cm" for method, e in known.items()]
    fig = make_subplots(rows=max(1, len(known)), cols=1, shared_xaxes=True, subplot_titles=titles)
    style.dress(fig)
    for row, errors_cm in enumerate(known.values(), 1):
        add_density(fig, errors_cm, row)
        fig.update_yaxes(title_text="per cm", row=row, col=1)
    fig.update_xaxes(title_text="Error of the stride length [cm]", row=max(1, len(known)), col=1)
    fig.update_layout(height=ROW_PX * max(1, len(known)) + 90, barmode="overlay")
    return fig


def add_density(fig: "Figure", errors_cm: Floats, row: int) -> None:
    """Draw the errors of one method, (n,), into a row."""
    place: dict[str, Any] = {"row": row, "col": 1, "showlegend": row == 1}
    fig.add_histogram(
        x=style.listed(errors_cm), histnorm="probability density", marker_color=style.PALE_BLUE, name="Strides", **place
    )
    sd = float(errors_cm.std(ddof=1)) or 1e-3
    x = np.linspace(errors_cm.min() - 2.0 * sd, errors_cm.max() + 2.0 * sd, 200)
    density = gaussian_kde(errors_cm)(x) if errors_cm.std() > 0.0 else np.full_like(x, np.nan)
    style.line(fig, "Kernel density", x, density, style.BLUE, unit="per cm", **place)
    style.line(
        fig, "Normal fit", x, norm.pdf(x, errors_cm.mean(), sd), style.ORANGE, unit="per cm", dash="dash", **place
    )


def pitch(cycle: PitchCycle) -> "Figure":
    """Return the pitch of the foot over one cycle, and below it the difference to the truth."""
    from plotly.subplots import make_subplots

    fig = make_subplots(rows=2, cols=1, shared_xaxes=True, row_heights=[0.6, 0.4], vertical_spacing=0.08)
    style.dress(fig)
    true_deg = np.degrees(cycle.true_rad)
    style.line(fig, "Motion capture", cycle.time_s, true_deg, style.INK, unit="deg", dash="dot", row=1, col=1)
    for i, (method, estimated_rad) in enumerate(cycle.estimated_rad.items()):
        look: dict[str, Any] = {"unit": "deg", "dash": DASHES[i % len(DASHES)], "legendgroup": method, "col": 1}
        colour, estimated_deg = COLOURS[i % len(COLOURS)], np.degrees(estimated_rad)
        style.line(fig, spoken(method), cycle.time_s, estimated_deg, colour, row=1, **look)
        off_deg = estimated_deg - true_deg
        style.line(fig, spoken(method), cycle.time_s, off_deg, colour, row=2, showlegend=False, **look)
    fig.update_yaxes(title_text="Pitch, toe up [deg]", row=1, col=1)
    fig.update_yaxes(title_text="Difference [deg]", row=2, col=1)
    fig.update_xaxes(title_text="Time since mid-stance [s]", row=2, col=1)
    fig.update_layout(height=520)
    return fig


def velocities(drift: Drift) -> "Figure":
    """Return the velocity of the foot before and after its drift was taken off, an axis a row."""
    from plotly.subplots import make_subplots

    fig = make_subplots(rows=3, cols=1, shared_xaxes=True, vertical_spacing=0.05)
    style.dress(fig)
    for i, axis in enumerate(AXES):
        place: dict[str, Any] = {"row": i + 1, "col": 1, "showlegend": i == 0, "unit": "m/s"}
        style.line(fig, "Before", drift.time_s, drift.before_mps[:, i], style.ORANGE, dash="dot", **place)
        style.line(fig, "After", drift.time_s, drift.after_mps[:, i], style.BLUE, width=1.2, **place)
        fig.update_yaxes(title_text=f"{axis} [m/s]", row=i + 1, col=1)
    fig.update_xaxes(title_text=style.TIME, row=3, col=1)
    fig.update_layout(height=560)
    return fig

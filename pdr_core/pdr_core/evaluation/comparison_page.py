"""The picture of a comparison: one HTML file that needs nothing else."""

from pathlib import Path

import numpy as np

from pdr_core.conventions import seconds_between
from pdr_core.evaluation import alignment, style
from pdr_core.evaluation.comparison import Comparison
from pdr_core.records import Floats, Stamps


def write_comparison(path: Path, result: Comparison, stamp_ns: Stamps, estimate_m: Floats, truth_m: Floats) -> None:
    """Draw paired rows, (n,) and (n, 3), from above, and their distance over time; OSError if it cannot be written."""
    from plotly.subplots import make_subplots

    laid_m = alignment.over_whole(truth_m, estimate_m).apply(truth_m)
    error_m, time_s = estimate_m - laid_m, seconds_between(stamp_ns, int(stamp_ns[0]))
    tracks = style.figure("x [m]", "y [m]")
    style.line(tracks, "Truth", laid_m[:, 0], laid_m[:, 1], style.ORANGE, dash="dash")
    style.line(tracks, "Estimate", estimate_m[:, 0], estimate_m[:, 1], style.BLUE)
    errors = style.figure(style.TIME, "Error [m]")
    style.line(errors, "Horizontal error", time_s, np.hypot(error_m[:, 0], error_m[:, 1]), style.BLUE)
    style.line(errors, "Height error", time_s, error_m[:, 2], style.ORANGE, width=1.2)
    fig = make_subplots(rows=2, cols=1, row_heights=[0.65, 0.35], vertical_spacing=0.1)
    for row, part in enumerate((tracks, errors), 1):
        fig.add_traces(part.data, rows=row, cols=1)
        fig.update_xaxes(title_text=part.layout.xaxis.title.text, row=row, col=1)
        fig.update_yaxes(title_text=part.layout.yaxis.title.text, row=row, col=1)
    style.dress(fig)
    fig.update_yaxes(scaleanchor="x", scaleratio=1, row=1, col=1)
    words = f"ATE2 {result.ate2_m:.3f} m, ATE3 {result.ate3_m:.3f} m, {result.pairs} pairs"
    fig.update_layout(title={"text": words}, margin={"t": 80}, hovermode="closest")
    fig.write_html(path, include_plotlyjs=True, default_height="95vh")

"""The timeline of modes and of the gyro as a figure."""

from typing import TYPE_CHECKING

import numpy as np

from pdr_core.evaluation import style
from pdr_core.evaluation.saving import Saving
from pdr_core.records_power import Mode

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

ROWS = (  # upwards
    Mode.DEAD_RECKONING,
    Mode.STANDING,
    Mode.SWINGS,
    Mode.EXAMINING,
    Mode.SUSPICION,
    Mode.INITIALISING,
    Mode.FAULT,
)


def modes(saving: Saving) -> "Figure":
    """Return which mode held when, with the times shaded in which the gyro was wanted on all the time."""
    end_s = max(saving.energy.duration_s, float(saving.times_s.max(initial=0.0)))
    edges_s = np.append(saving.times_s, end_s)
    fig = style.figure("Time since the first command [s]", "")
    on = np.array([command.gyro and not command.on_motion for command in saving.commands], np.bool_)
    bars_s = np.column_stack([edges_s[:-1], edges_s[1:]])[on]
    outline = np.array([-0.5, len(ROWS) - 0.5, len(ROWS) - 0.5, -0.5, -0.5, np.nan])
    style.area(fig, "Gyro on", bars_s[:, [0, 0, 1, 1, 0, 0]].ravel(), np.tile(outline, len(bars_s)), style.PALE_GREEN)
    rows = np.array([ROWS.index(command.mode) for command in saving.commands], np.float64)
    names = [mode.name.lower().replace("_", " ") for mode in ROWS]
    style.line(fig, "Mode", edges_s, np.append(rows, rows[-1:]), style.BLUE, unit="", line_shape="hv")
    told = [names[int(row)] for row in np.append(rows, rows[-1:])]
    fig.data[-1].update(customdata=told, hovertemplate="%{customdata}")
    fig.update_yaxes(tickmode="array", tickvals=list(range(len(ROWS))), ticktext=names, range=[-0.5, len(ROWS) - 0.5])
    return fig

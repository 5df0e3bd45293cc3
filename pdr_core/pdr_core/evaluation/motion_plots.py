"""How a foot moved by several methods: attitude angles and velocity over time (Gui figures 12, 13)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pdr_core.evaluation import style
from pdr_core.evaluation.course_plots import CourseTrack, looks
from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

ANGLES = ("Roll [°]", "Pitch [°]", "Yaw [°]")
ANGLE_ERRORS = ("Roll off by [°]", "Pitch off by [°]", "Yaw off by [°]")
VELOCITIES = ("East [m/s]", "North [m/s]", "Up [m/s]")


class MotionTrack(NamedTuple):
    """Where a foot was, how it was turned and how fast it was."""

    name: str
    time_s: Floats  # (n,) since the start of the walk
    position_m: Floats  # (n, 3)
    euler_deg: Floats  # (n, 3) roll, pitch, yaw; they go on at 180 degrees and do not jump
    velocity_mps: Floats  # (n, 3) in the world frame

    @property
    def course(self) -> CourseTrack:
        """Where it went, from its start."""
        return CourseTrack(self.name, self.time_s, self.position_m - self.position_m[0], self.euler_deg[:, 2])


def attitudes(estimates: Sequence[MotionTrack], truth: MotionTrack) -> "Figure":
    """Return the attitude angles over time, one above the other (Gui figure 12)."""
    return _over_time(ANGLES, [track.euler_deg for track in (truth, *estimates)], estimates, truth)


def attitude_errors(estimates: Sequence[MotionTrack], truth: MotionTrack) -> "Figure":
    """Return by how much the attitude angles are off over time: methods may differ by less than a line is wide."""
    off = [track.euler_deg - true_angles_deg(truth, track.time_s) for track in estimates]
    return _over_time(ANGLE_ERRORS, [np.zeros_like(truth.euler_deg), *off], estimates, truth)


def true_angles_deg(truth: MotionTrack, time_s: Floats) -> Floats:
    """Return the angles of the truth at times (n,), (n, 3)."""
    return np.column_stack([np.interp(time_s, truth.time_s, angle) for angle in truth.euler_deg.T])


def velocities(estimates: Sequence[MotionTrack], truth: MotionTrack) -> "Figure":
    """Return the velocity over time, one axis above the other (Gui figure 13)."""
    return _over_time(VELOCITIES, [track.velocity_mps for track in (truth, *estimates)], estimates, truth)


def _over_time(
    titles: Sequence[str], values: Sequence[Floats], estimates: Sequence[MotionTrack], truth: MotionTrack
) -> "Figure":
    from plotly.subplots import make_subplots

    fig = make_subplots(rows=3, cols=1, shared_xaxes=True, vertical_spacing=0.05)
    style.dress(fig)
    coloured = looks([track.course for track in estimates], truth.course)
    for axis, title in enumerate(titles):
        for (track, colour, dash), value in zip(coloured, values, strict=True):
            style.line(
                fig, track.name, track.time_s, value[:, axis], colour,
                unit=title.split("[")[1].rstrip("]"), dash=dash, width=1.2, digits=4,
                legendgroup=track.name, showlegend=axis == 0, row=axis + 1, col=1,
            )  # fmt: skip
        fig.update_yaxes(title_text=title, row=axis + 1, col=1)
    fig.update_xaxes(title_text=style.TIME, row=3, col=1)
    return fig

"""The alignment shown as Qiu does, table 2 and figure 3: quaternions (q0, q1, q2, q3) = (w, x, y, z)."""

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pdr_core.conventions import seconds_between
from pdr_core.evaluation import style
from pdr_core.evaluation.page import page
from pdr_core.records import Floats, Stamps

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

KEY_SAMPLES = 3  # before and after, evenly over the rest
COLOURS = (style.INK, style.BLUE, style.ORANGE, style.GREEN)


class Orientations(NamedTuple):
    """n orientations of sensor and body; the world's x is the walking direction at the start."""

    stamp_ns: Stamps  # (n,)
    before_xyzw: Floats  # (n, 4) of the sensor
    after_xyzw: Floats  # (n, 4) of the body
    rest: slice  # rows


Row = tuple[int, float, float, float, float, float]  # number, time [s], q0, q1, q2, q3


def table_2(shown: Orientations) -> list[Row]:
    """Return key samples of the rest: first before the alignment, then the same ones after it."""
    rows = np.linspace(shown.rest.start, shown.rest.stop - 1, KEY_SAMPLES).round().astype(int)
    time_s = seconds_between(shown.stamp_ns[rows], int(shown.stamp_ns[0])).tolist() * 2
    quat_xyzw = np.concatenate([shown.before_xyzw[rows], shown.after_xyzw[rows]]).tolist()
    return [(i, t, w, x, y, z) for i, (t, (x, y, z, w)) in enumerate(zip(time_s, quat_xyzw, strict=True), 1)]


def figure_3(shown: Orientations) -> "Figure":
    """Return the quaternions over time, the sensor's dotted, the rest shaded."""
    time_s = seconds_between(shown.stamp_ns, int(shown.stamp_ns[0]))
    edges_s = time_s[[shown.rest.start, shown.rest.stop - 1]]
    fig = style.figure(style.TIME, "Quaternion [-]")
    style.area(fig, "Rest", edges_s[[0, 0, 1, 1, 0]], np.array([-1.0, 1.0, 1.0, -1.0, -1.0]), style.PALE_GREEN)
    for i, (column, colour) in enumerate(zip((3, 0, 1, 2), COLOURS, strict=True)):
        sensor, body = shown.before_xyzw[:, column], shown.after_xyzw[:, column]
        style.line(fig, f"q{i} sensor", time_s, sensor, colour, unit="", dash="dot", width=1, digits=4)
        style.line(fig, f"q{i} body", time_s, body, colour, unit="", width=1.5, digits=4)
    return fig


def write_mounting(path: Path, recording: str, words: str, shown: Orientations) -> None:
    """Write the page. Raise OSError where it cannot be written."""
    rows = [(number, f"{t:.2f} s", *(f"{q:.5f}" for q in quaternion)) for number, t, *quaternion in table_2(shown)]
    content = {"recording": recording, "words": words, "rows": rows, "picture": figure_3(shown).to_json()}
    path.write_text(page("mounting.html.j2", **content), encoding="utf-8")

"""The report of a body between two feet: all three tracks from above, and how far off the body is."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pdr_core.evaluation import plots, style
from pdr_core.evaluation.report import Picture, with_pictures
from pdr_core.evaluation.result import Result
from pdr_core.evaluation.score import TruthView
from pdr_core.records import Floats, NavBlock

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

LIMIT = 20_000
COLOURS = (style.GREEN, style.PURPLE)


class Way:
    """Positions, of which every k-th is kept, k doubling whenever the limit is passed."""

    def __init__(self) -> None:
        self._every = 1
        self._seen = 0
        self._kept: Floats = np.zeros((0, 3))

    def add(self, nav: NavBlock) -> None:
        """Take the next estimates."""
        first = -self._seen % self._every
        self._seen += len(nav.position_m)
        self._kept = np.concatenate([self._kept, nav.position_m[first :: self._every]])
        while len(self._kept) > LIMIT:
            self._kept, self._every = self._kept[::2], 2 * self._every

    @property
    def position_m(self) -> Floats:
        """Those that were kept, (n, 3)."""
        return self._kept


def body_plan(body_m: Floats, feet_m: Mapping[str, Floats], view: TruthView | None) -> "Figure":
    """Return the tracks (n, 3) of the body and of both feet, all in the body's world, from above."""
    fig = style.figure("x [m]", "y [m]")
    for (name, position_m), colour in zip(feet_m.items(), COLOURS, strict=True):
        style.line(fig, name, position_m[:, 0], position_m[:, 1], colour, width=1)
    if view:
        style.line(fig, "Truth", view.truth_m[:, 0], view.truth_m[:, 1], style.ORANGE, dash="dash")
    style.line(fig, "Body", body_m[:, 0], body_m[:, 1], style.BLUE)
    return style.from_above(fig)


def write_body_report(
    path: Path, result: Result, body_m: Floats, feet_m: Mapping[str, Floats], view: TruthView | None
) -> None:
    """Write the report of the body to a file. Raise OSError where it cannot be written."""
    caption = "The body midway between the feet, and each foot where its frame puts it."
    pictures = [Picture("plan", "Where the walk went", caption, body_plan(body_m, feet_m, view).to_json())]
    if view:
        caption = "Distance to the truth, midway between both feet, after it was laid onto the whole track."
        pictures.append(Picture("error", "How far off it was", caption, plots.error(view).to_json()))
    path.write_text(with_pictures(result, pictures), encoding="utf-8")

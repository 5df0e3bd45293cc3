"""The page of Zhou's walks: one HTML file that needs nothing else."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from pdr_core.evaluation import style
from pdr_core.evaluation.page import page
from pdr_core.evaluation.qiu_page import PageWords, Pictures, TitledTable
from pdr_core.evaluation.report import Picture
from pdr_core.evaluation.style import BESIDE_TRUTH
from pdr_core.records import Floats

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

WORDS = PageWords(
    "Zhou's walks, simulated",
    "Simulated walks of the four testers of Zhou's Table 4",
    "Zhou's section 5: the second lap without the gyro, over many seeds",
    "Corner error: mean distance at the eight corners and the end (Zhou eq. 23, which calls it a root mean square). "
    "RMSE: over all strides of the second lap. Distance: Zhou eq. 22.",
)
TRUTH = "Truth"


class Series(NamedTuple):
    """A line or a cloud of points; the truth is dashed, and has its name."""

    name: str
    x: Floats  # (n,)
    y: Floats  # (n,)
    points: bool = False
    steps: bool = False  # a value holds until the next


class Drawing(NamedTuple):
    """A figure."""

    title: str
    caption: str
    series: Sequence[Series]
    x_title: str
    y_title: str
    to_scale: bool = False
    levels: Sequence[str] = ()  # names of y = 0, 1, 2 ...


class Chapter(NamedTuple):
    """Figures that belong together."""

    name: str
    drawings: Sequence[Drawing]


def zhou_page(tables: Sequence[TitledTable], chapters: Sequence[Chapter], version: str, commit: str) -> str:
    """Return the page as text."""
    shown = [
        Pictures(c.name, [picture(d, f"{i}-{j}") for j, d in enumerate(c.drawings)]) for i, c in enumerate(chapters)
    ]
    return page("walks.html.j2", words=WORDS, tables=tables, walks=shown, version=version, commit=commit)


def picture(drawing: Drawing, number: str) -> Picture:
    """Return a figure as the page has it."""
    return Picture(f"zhou-{number}", drawing.title, drawing.caption, figure(drawing).to_json())


def figure(drawing: Drawing) -> "Figure":
    """Return the figure."""
    fig = style.figure(drawing.x_title, drawing.y_title)
    others = [s for s in drawing.series if s.name != TRUTH]
    for s in drawing.series:
        true = s.name == TRUTH
        colour = style.ORANGE if true else BESIDE_TRUTH[others.index(s) % len(BESIDE_TRUTH)]
        style.line(fig, s.name, s.x, s.y, colour, unit="", dash="dash" if true else "solid")
        if s.steps:
            fig.data[-1].update(line_shape="hv")
        if s.points:
            fig.data[-1].update(mode="markers", marker={"color": colour, "size": 6})
    fig.update_layout(hovermode="closest")
    if drawing.to_scale:
        fig.update_yaxes(scaleanchor="x", scaleratio=1)
    if drawing.levels:
        fig.update_yaxes(tickmode="array", tickvals=list(range(len(drawing.levels))), ticktext=list(drawing.levels))
    return fig

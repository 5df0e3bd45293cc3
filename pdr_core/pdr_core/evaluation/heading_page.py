"""The page of compared heading constraints: one HTML file that needs nothing else."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from pdr_core.evaluation import style
from pdr_core.evaluation.detector_tables import TextTable
from pdr_core.evaluation.heading_study import HeadingStudy
from pdr_core.evaluation.heading_tables import bends, figures, means
from pdr_core.evaluation.page import page
from pdr_core.evaluation.qiu_page import PageWords, Pictures, TitledTable
from pdr_core.evaluation.report import Picture
from pdr_core.evaluation.style import BESIDE_TRUTH

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

WORDS = PageWords(
    "Heading constraints compared",
    "Heading constraints on recordings, without the magnetometer",
    "Gui's Table 3 on real walks",
    "ATE2: root mean square of the horizontal error after the track was turned and moved onto the truth as a whole. "
    "Positioning error: at the end, of the length of the walk, laid onto the truth at its start. A constraint takes "
    "straight lines to have the directions that it knows: where they have not, it turns the track.",
)


def heading_page(studies: Sequence[HeadingStudy], version: str, commit: str) -> str:
    """Return the page as text; of at least one study."""
    walks = [Pictures(s.recording, list(pictures(s, i))) for i, s in enumerate(studies)]
    return page("walks.html.j2", words=WORDS, tables=tables(studies), walks=walks, version=version, commit=commit)


def tables(studies: Sequence[HeadingStudy]) -> list[TitledTable]:
    """Return the tables that have rows."""
    titled: list[tuple[str, TextTable]] = [
        ("Each algorithm over all recordings", means(studies)),
        ("Each recording, as Gui Table 3", figures(studies)),
        ("Corridors bent by 8 to 12 degrees", bends(studies)),
    ]
    return [TitledTable(title, table.heads, table.rows) for title, table in titled if table.rows]


def pictures(study: HeadingStudy, number: int) -> Iterator[Picture]:
    """Yield the plan of one recording."""
    caption = "All variants from above, laid onto the truth as a whole; a click on a name hides it."
    yield Picture(f"plan-{number}", "Where the walk went", caption, plan(study).to_json())


def plan(study: HeadingStudy) -> "Figure":
    """Return the tracks from above, over the truth if it is known."""
    fig = style.figure("x [m]", "y [m]")
    if study.truth_m is not None:
        style.line(fig, "Truth", study.truth_m[:, 0], study.truth_m[:, 1], style.ORANGE, dash="dash")
    for i, (name, track_m) in enumerate(study.tracks_m.items()):
        style.line(fig, name, track_m[:, 0], track_m[:, 1], BESIDE_TRUTH[i % len(BESIDE_TRUTH)])
    return style.from_above(fig)

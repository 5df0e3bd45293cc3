"""The page of Qiu's walks: one HTML file that needs nothing else."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from pdr_core.evaluation import course_plots
from pdr_core.evaluation.course_plots import CourseTrack
from pdr_core.evaluation.page import page
from pdr_core.evaluation.report import Picture


class PageWords(NamedTuple):
    """What a page of simulated walks says about itself."""

    title: str
    above: str  # the heading
    heading: str
    below: str


WORDS = PageWords(
    "Qiu's walks, simulated",
    "Simulated walks with the sensor of Qiu's Table 1",
    "Qiu's Tables 3, 4 and 5 and his stairs",
    "Distance: the sum of the stride lengths. End error: horizontal, of the way from start to end.",
)


class TitledTable(NamedTuple):
    """A table of text."""

    title: str
    heads: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]


class DrawnWalk(NamedTuple):
    """One walk by every method."""

    name: str
    estimates: Sequence[CourseTrack]
    truth: CourseTrack


class Pictures(NamedTuple):
    """What the page shows of one walk."""

    name: str
    pictures: list[Picture]


def qiu_page(tables: Sequence[TitledTable], walks: Sequence[DrawnWalk], version: str, commit: str) -> str:
    """Return the page as text."""
    shown = [Pictures(walk.name, list(pictures(walk, i))) for i, walk in enumerate(walks)]
    return page("walks.html.j2", words=WORDS, tables=tables, walks=shown, version=version, commit=commit)


def pictures(walk: DrawnWalk, number: int) -> Iterator[Picture]:
    """Yield the figures of one walk; the height of one that climbs."""
    tracks = (walk.estimates, walk.truth)
    plan = course_plots.courses(*tracks).to_json()
    yield Picture(f"plan-{number}", "Where the walk went", "The tracks from above, from the same start.", plan)
    caption = "Counted on at 180 degrees, where figure 14 of the paper jumps; left turns count up."
    yield Picture(f"heading-{number}", "Heading", caption, course_plots.headings(*tracks).to_json())
    if walk.truth.position_m[-1, 2] != 0.0:
        caption = "The height of the foot, as figure 10 (d) of the paper."
        yield Picture(f"height-{number}", "Height", caption, course_plots.heights(*tracks).to_json())

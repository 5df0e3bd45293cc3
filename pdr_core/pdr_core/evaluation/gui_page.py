"""The page of Gui's walks: one HTML file that needs nothing else."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from pdr_core.evaluation import course_plots, motion_plots
from pdr_core.evaluation.course_plots import CourseTrack
from pdr_core.evaluation.motion_plots import MotionTrack
from pdr_core.evaluation.page import page
from pdr_core.evaluation.qiu_page import PageWords, Pictures, TitledTable
from pdr_core.evaluation.report import Picture

WORDS = PageWords(
    "Gui's walks, simulated",
    "Simulated walks with the motion and the sensor of Gui's Table 1",
    "Gui's Table 3, over many seeds",
    "End error: distance of the end from the start, over the length of the walk (Gui eq. 33). ATE2: root mean square "
    "of the horizontal error after the track was turned and moved onto the truth as a whole.",
)


class GuiDrawn(NamedTuple):
    """One walk of one seed: where every variant went, and how those of Table 3 moved."""

    name: str
    courses: Sequence[CourseTrack]
    motions: Sequence[MotionTrack]
    truth: MotionTrack


def gui_page(tables: Sequence[TitledTable], walks: Sequence[GuiDrawn], version: str, commit: str) -> str:
    """Return the page as text."""
    shown = [Pictures(walk.name, list(pictures(walk, i))) for i, walk in enumerate(walks)]
    return page("walks.html.j2", words=WORDS, tables=tables, walks=shown, version=version, commit=commit)


def pictures(walk: GuiDrawn, number: int) -> Iterator[Picture]:
    """Yield the figures of one walk."""
    tracks = (walk.motions, walk.truth)
    plan = course_plots.courses(walk.courses, walk.truth.course).to_json()
    caption = (
        "The tracks from above, from the same start, as figures 10 and 14 of the paper; a click on a name hides it."
    )
    yield Picture(f"plan-{number}", "Where the walk went", caption, plan)
    caption = "In the world frame, as figures 12 and 15 of the paper."
    yield Picture(f"attitude-{number}", "Attitude", caption, motion_plots.attitudes(*tracks).to_json())
    caption = "In the world frame, as figures 13 and 16 of the paper."
    yield Picture(f"velocity-{number}", "Velocity", caption, motion_plots.velocities(*tracks).to_json())

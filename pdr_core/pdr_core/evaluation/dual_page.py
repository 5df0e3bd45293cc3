"""The page of the walks with both feet: one HTML file that needs nothing else."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from pdr_core.evaluation import dual_plots
from pdr_core.evaluation.dual_plots import Curve
from pdr_core.evaluation.page import page
from pdr_core.evaluation.qiu_page import PageWords, Pictures, TitledTable
from pdr_core.evaluation.report import Picture

WORDS = PageWords(
    "Both feet, simulated",
    "Simulated walks with a sensor on each foot",
    "Heading errors of both feet, and what one foot tells the other (paper 004)",
    "End error: horizontal, of both feet. Lateral: across a straight walk, left is positive; each track begins where "
    "its foot stood.",
)


class DrawnFeet(NamedTuple):
    """One walk over its repetitions."""

    name: str
    straight: bool
    tracks: Sequence[Curve]  # means over the repetitions
    ends: Sequence[Curve]
    drifts: Sequence[Curve]  # means over the repetitions


def dual_page(tables: Sequence[TitledTable], walks: Sequence[DrawnFeet], version: str, commit: str) -> str:
    """Return the page as text."""
    shown = [Pictures(walk.name, list(pictures(walk, i))) for i, walk in enumerate(walks)]
    return page("walks.html.j2", words=WORDS, tables=tables, walks=shown, version=version, commit=commit)


def pictures(walk: DrawnFeet, number: int) -> Iterator[Picture]:
    """Yield the figures of one walk."""
    plan = dual_plots.tracks(walk.tracks, to_scale=not walk.straight).to_json()
    caption = "Means over the repetitions, as figure 3 of the paper: each foot alone, and both together."
    yield Picture(f"plan-{number}", "Where the walk went", caption, plan)
    caption = "By how much the last steps are off, as figure 4 of the paper."
    yield Picture(f"ends-{number}", "Where it ended", caption, dual_plots.ends(walk.ends).to_json())
    caption = "Estimated minus true direction of the strides, means over the repetitions; the walking direction is the"
    caption += " mean of both feet (eq. 6)."
    yield Picture(f"drift-{number}", "Heading errors", caption, dual_plots.drifts(walk.drifts).to_json())

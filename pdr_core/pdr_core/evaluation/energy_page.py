"""The page of energy against accuracy: one HTML file that needs nothing else."""

from collections.abc import Sequence
from typing import NamedTuple

from pdr_core.evaluation.energy_plots import EnergyPoint, energy_curve
from pdr_core.evaluation.page import page
from pdr_core.evaluation.qiu_page import PageWords, Pictures, TitledTable
from pdr_core.evaluation.report import Picture

WORDS = PageWords(
    "Energy and accuracy",
    "Walks whose gyro is switched in their second half",
    "What a gyro that is off costs (Zhou section 4)",
    "On: share of the time of the second half in which the gyro is powered, settled or not. End: error of the end of "
    "the walk, in % of its whole length. Distance: error of the strides of the second half, in % of theirs.",
)
CAPTION = "Small: each walk. Large: the mean of a scheme. A click on a name hides it."


class EnergyGroup(NamedTuple):
    """Walks that are compared."""

    name: str
    walks: Sequence[EnergyPoint]
    means: Sequence[EnergyPoint]


def energy_page(tables: Sequence[TitledTable], groups: Sequence[EnergyGroup], version: str, commit: str) -> str:
    """Return the page as text."""
    shown = [Pictures(group.name, [curve(group, i)]) for i, group in enumerate(groups)]
    return page("walks.html.j2", words=WORDS, tables=tables, walks=shown, version=version, commit=commit)


def curve(group: EnergyGroup, number: int) -> Picture:
    """Return the curve of a group."""
    return Picture(
        f"energy-{number}", "Energy against accuracy", CAPTION, energy_curve(group.walks, group.means).to_json()
    )

"""Methods of orientation on recordings: what `pdr compare --orientations` runs, prints and writes."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from pdr_bringup_scripts.bench_tables import console
from pdr_bringup_scripts.compare_tables import WIDTH, rich_table
from pdr_bringup_scripts.comparing import Seen, chosen
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.bench.mocap_gait import study
from pdr_core.bench.orientations import ORIENTATIONS
from pdr_core.bench.trial import Walk
from pdr_core.evaluation.orientation_page import orientation_page
from pdr_core.evaluation.orientation_study import OrientationStudy
from pdr_core.evaluation.orientation_tables import as_json, figures, gait, left_out
from pdr_core.params import Params

FILES = "orientations.html, orientations.json"


@dataclass(frozen=True)
class OrientationJob:
    """Which methods are compared."""

    params: Params
    methods: Sequence[str]

    def __call__(self, walk: Walk, seen: Seen) -> OrientationStudy:
        """Study one sensor."""
        return study(walk, self.params, self.methods, seen)


def chosen_methods(text: str) -> list[str]:
    """Return the methods of a list with commas; Problem if one does not exist."""
    return chosen(text, list(ORIENTATIONS), "--orientations")


def show(studies: Sequence[OrientationStudy], terminal: Terminal) -> None:
    """Print the tables, and which methods cannot run on which recordings."""
    out = console(WIDTH)
    out.print(rich_table("Methods of orientation, each with its track", figures(studies)))
    if (against := gait(studies)).rows:
        out.print(rich_table("Strides and foot pitch against motion capture", against))
    for sentence in left_out(studies):
        terminal.say(sentence)


def write_page(out: Path, studies: Sequence[OrientationStudy], terminal: Terminal) -> None:
    """Write the page and the figures into a folder that exists."""
    texts = (orientation_page(studies, VERSION, commit()), as_json(studies) + "\n")
    for name, text in zip(FILES.split(", "), texts, strict=True):
        (out / name).write_text(text, encoding="utf-8")
    terminal.say(f"Written to {out}: {FILES}")

"""Methods of orientation on recordings: what `pdr compare --orientations` runs, prints and writes."""

from collections.abc import Sequence
from dataclasses import dataclass

from pdr_bringup_scripts.benches.suite_tables import console
from pdr_bringup_scripts.compare.compare_tables import WIDTH, rich_table
from pdr_bringup_scripts.compare.comparing import Seen, chosen
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.bench.mocap_gait import study
from pdr_core.bench.orientations import ORIENTATIONS
from pdr_core.bench.trial import Walk
from pdr_core.evaluation.orientation_page import orientation_page
from pdr_core.evaluation.orientation_study import OrientationStudy
from pdr_core.evaluation.orientation_tables import as_json, figures, gait, left_out
from pdr_core.params import Params


@dataclass(frozen=True)
class OrientationComparison:
    """Which methods are compared."""

    params: Params
    methods: Sequence[str]

    def study(self, walk: Walk, seen: Seen) -> OrientationStudy:
        """Study one sensor."""
        return study(walk, self.params, self.methods, seen)

    def show(self, studies: Sequence[OrientationStudy]) -> None:
        """Print the tables, and which methods cannot run on which recordings."""
        out = console(WIDTH)
        out.print(rich_table("Methods of orientation, each with its track", figures(studies)))
        if (against := gait(studies)).rows:
            out.print(rich_table("Strides and foot pitch against motion capture", against))
        for sentence in left_out(studies):
            Terminal().say(sentence)

    def as_json(self, studies: Sequence[OrientationStudy]) -> str:
        """Return everything as one JSON object."""
        return as_json(studies)

    def files(self, studies: Sequence[OrientationStudy]) -> dict[str, str]:
        """Return the page and the figures."""
        return {
            "orientations.html": orientation_page(studies, VERSION, commit()),
            "orientations.json": as_json(studies) + "\n",
        }


def of_orientations(params: Params, names: str) -> OrientationComparison:
    """Return the comparison of methods, a list with commas; Problem if one does not exist."""
    return OrientationComparison(params, chosen(names, list(ORIENTATIONS), "--orientations"))

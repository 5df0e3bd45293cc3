"""Heading constraints on recordings: what `pdr compare --headings` runs, prints and writes."""

from collections.abc import Sequence
from dataclasses import dataclass

from pdr_bringup_scripts.benches.suite_tables import console
from pdr_bringup_scripts.compare.compare_tables import WIDTH, rich_table
from pdr_bringup_scripts.compare.comparing import Seen, chosen
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.bench.heading_ablation import CONSTRAINTS, study
from pdr_core.bench.trial import Walk
from pdr_core.evaluation.heading_page import heading_page
from pdr_core.evaluation.heading_study import HeadingStudy
from pdr_core.evaluation.heading_tables import as_json, bends, figures, means
from pdr_core.params import Params


@dataclass(frozen=True)
class HeadingComparison:
    """Which constraints are compared."""

    params: Params
    constraints: Sequence[str]

    def study(self, walk: Walk, seen: Seen) -> HeadingStudy:
        """Study one sensor."""
        return study(walk, self.params, self.constraints, seen)

    def show(self, studies: Sequence[HeadingStudy]) -> None:
        """Print the tables."""
        out = console(WIDTH)
        out.print(rich_table("Heading constraints, as Gui Table 3 (without the magnetometer)", figures(studies)))
        if len(studies) > 1 and (over_all := means(studies)).rows:
            out.print(rich_table("Over all recordings whose path is known", over_all))
        if (bent := bends(studies)).rows:
            out.print(rich_table("Corridors bent by 8 to 12 degrees", bent))

    def as_json(self, studies: Sequence[HeadingStudy]) -> str:
        """Return everything as one JSON object."""
        return as_json(studies)

    def files(self, studies: Sequence[HeadingStudy]) -> dict[str, str]:
        """Return the page and the figures."""
        return {"headings.html": heading_page(studies, VERSION, commit()), "headings.json": as_json(studies) + "\n"}


def of_headings(params: Params, names: str) -> HeadingComparison:
    """Return the comparison of constraints, a list with commas; Problem if one does not exist."""
    return HeadingComparison(params, chosen(names, CONSTRAINTS, "--headings"))

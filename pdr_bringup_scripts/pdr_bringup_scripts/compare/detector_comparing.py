"""Stance detectors on recordings: what `pdr compare` runs, prints and writes."""

from collections.abc import Sequence
from dataclasses import dataclass

from pdr_bringup_scripts.benches.suite_tables import console
from pdr_bringup_scripts.compare.compare_tables import WIDTH, rich_table
from pdr_bringup_scripts.compare.comparing import Seen, chosen
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.bench.detectors import DETECTORS, study
from pdr_core.bench.trial import Walk
from pdr_core.evaluation.detector_page import detector_page
from pdr_core.evaluation.detector_study import DetectorStudy
from pdr_core.evaluation.detector_tables import as_csv, as_json, figures, summaries, worth
from pdr_core.params import Params
from pdr_core.pipeline.stance_phases import TIME_GATES


@dataclass(frozen=True)
class DetectorComparison:
    """Which detectors are compared, and whether figures alone are wanted or pictures too."""

    params: Params
    detectors: Sequence[str]
    gates: Sequence[str]
    deep: bool

    def study(self, walk: Walk, seen: Seen) -> DetectorStudy:
        """Study one sensor."""
        return study(walk, self.params, self.detectors, self.gates, self.deep, seen)

    def show(self, studies: Sequence[DetectorStudy]) -> None:
        """Print the tables."""
        out = console(WIDTH)
        out.print(rich_table("Stance detectors (closure: from the first position to the last)", figures(studies)))
        if len(studies) > 1 and (over_all := summaries(studies)).rows:
            out.print(rich_table("Over all recordings: ATE2 where the path is known, mean closure of loops", over_all))
        if (parts := worth(studies)).rows:
            out.print(rich_table("What each part of the method is worth", parts))

    def as_json(self, studies: Sequence[DetectorStudy]) -> str:
        """Return everything as one JSON object."""
        return as_json(studies)

    def files(self, studies: Sequence[DetectorStudy]) -> dict[str, str]:
        """Return the page and the figures."""
        page = detector_page(studies, VERSION, commit())
        return {"compare.html": page, "compare.csv": as_csv(studies), "compare.json": as_json(studies) + "\n"}


def of_detectors(params: Params, detectors: str, gates: str, deep: bool) -> DetectorComparison:
    """Return the comparison of detectors and time gates, lists with commas; Problem if one does not exist."""
    names = chosen(detectors, DETECTORS, "--detectors"), chosen(gates, TIME_GATES, "--time-gates")
    return DetectorComparison(params, *names, deep)

"""Keeps of a run with two feet what the result, the report and the files of the body need, in bounded memory."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path

from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_bringup_scripts.run.feet_together import FeetTogether
from pdr_bringup_scripts.run.track_book import TrackBook
from pdr_core.evaluation.body_page import Way, write_body_report
from pdr_core.evaluation.body_truth import truth_between
from pdr_core.evaluation.external import External
from pdr_core.evaluation.result import CAUSAL, Result
from pdr_core.params import Params, params_as_mapping
from pdr_core.pipeline import FootOutput
from pdr_core.recording import Sensor, Session
from pdr_core.records import Floats, NavBlock, Notice

FILES = "trajectory.tum, result.json, report.html"  # strides are those of feet


class BodyBook:
    """Takes every output once; `out` is where the files go, None: nowhere."""

    def __init__(self, session: Session, feet: Sequence[Sensor], out: Path | None, stack: ExitStack) -> None:
        self._session = session
        self.track = TrackBook(truth_between(feet[0].truth, feet[1].truth), out, stack)
        self._way = Way()
        self._ways = {foot.name: Way() for foot in feet}
        self._together = FeetTogether([foot.name for foot in feet])
        self._out = out

    def keep_foot(self, foot: str, output: FootOutput) -> None:
        """Take the next estimates of a foot."""
        self._ways[foot].add(output.nav)
        self._together.keep(foot, output)

    def keep(self, nav: NavBlock) -> None:
        """Take the next estimates of the body."""
        self.track.keep(nav)
        self._way.add(nav)

    def close(
        self,
        pipeline: str,
        params: Params,
        feet: Mapping[str, Result],
        seconds: float,
        notices: list[Notice],
        placed_m: Callable[[str, Floats], Floats],
        external: External | None = None,
    ) -> Result:
        """Return the result and write the files; of strides and distance the feet's mean counts, where both are."""
        strides, distance_m = self._together.totals(feet)
        result = Result(
            recording=str(self._session.path),
            format=self._session.format,
            samples=self.track.rows,
            duration_s=self.track.duration_s,
            pipeline=pipeline,
            **CAUSAL._asdict(),
            strides=strides,
            distance_m=distance_m,
            end_position_m=self.track.scorer.end_position_m,
            closure_2d_m=self.track.scorer.closure_2d_m,
            closure_3d_m=self.track.scorer.closure_3d_m,
            gait=None,
            seconds=seconds,
            notices=[*notices, *self._together.notices],
            config=params_as_mapping(params),
            truth=self.track.scorer.score([], self.track.scorer.start_position_m),
            version=VERSION,
            commit=commit(),
            external=external,
        )
        if self._out:
            (self._out / "result.json").write_text(result.to_json() + "\n")
            feet_m = {foot: placed_m(foot, way.position_m) for foot, way in self._ways.items()}
            view = self.track.scorer.view([], self.track.scorer.start_position_m)
            write_body_report(self._out / "report.html", result, self._way.position_m, feet_m, view)
        return result

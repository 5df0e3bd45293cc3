"""Keeps of a run what its result, its report and its files need, in bounded memory."""

from contextlib import ExitStack
from pathlib import Path

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_bringup_scripts.run.track_book import TrackBook
from pdr_core.evaluation.external import External
from pdr_core.evaluation.gait_totals import GaitTotals, gait_totals
from pdr_core.evaluation.report import write_report
from pdr_core.evaluation.result import CAUSAL, Hindsight, Result
from pdr_core.evaluation.saving import Saving
from pdr_core.evaluation.score import start_of_steps_m
from pdr_core.evaluation.trace import Trace
from pdr_core.evaluation.words import nothing_usable
from pdr_core.params import Params, params_as_mapping
from pdr_core.pipeline import BodySteps, FootGait, FootOutput
from pdr_core.recording import Sensor, Session
from pdr_core.recording.strides import write_strides
from pdr_core.records import Floats, Notice, StepEvent
from pdr_core.records_gait import Stride

FILES = "trajectory.tum, strides.csv, result.json, report.html"


class Book:
    """Takes every output of a run once; `out` is where its files go, None: nowhere.

    `gait` makes strides of its steps.
    """

    def __init__(
        self,
        session: Session,
        sensor: Sensor,
        out: Path | None,
        stack: ExitStack,
        gait: FootGait | BodySteps | None = None,
    ) -> None:
        self._session = session
        self.track = TrackBook(sensor.truth, out, stack)
        self._trace = Trace()
        self._out = out
        self.steps: list[StepEvent] = []
        self._gait = gait or FootGait()
        self._strides: list[Stride] = []

    def keep(self, output: FootOutput) -> None:
        """Take the next estimates and steps."""
        self.steps += output.steps
        self._strides += self._gait.run(output)
        self.track.keep(output.nav)
        self._trace.add(output.judged, output.nav)

    @property
    def _start_position_m(self) -> Floats:
        return start_of_steps_m(self.steps, self.track.scorer.start_position_m)

    def close(
        self,
        pipeline: str,
        params: Params,
        samples: int,
        seconds: float,
        notices: list[Notice],
        hindsight: Hindsight = CAUSAL,
        saving: Saving | None = None,
        external: External | None = None,
    ) -> Result:
        """Return the result and write the files; Problem if there was no usable sample."""
        if not self.track.rows:
            raise Problem(nothing_usable(str(self._session.path), notices))
        self._strides += self._gait.finish()
        result = Result(
            recording=str(self._session.path),
            format=self._session.format,
            samples=samples,
            duration_s=self.track.duration_s,
            pipeline=pipeline,
            **hindsight._asdict(),
            strides=len(self.steps),
            distance_m=float(sum(step.length_m for step in self.steps)),
            end_position_m=self.track.scorer.end_position_m,
            closure_2d_m=self.track.scorer.closure_2d_m,
            closure_3d_m=self.track.scorer.closure_3d_m,
            gait=self._gait_totals(),
            seconds=seconds,
            notices=[*self._session.notices, *notices, *self._gait.notices],
            config=params_as_mapping(params),
            truth=self.track.scorer.score(self.steps, self._start_position_m),
            version=VERSION,
            commit=commit(),
            saving=saving,
            external=external,
        )
        if self._out:
            self._write_files(self._out, result)
        return result

    def _gait_totals(self) -> GaitTotals | None:
        """Return the totals of a foot's strides; None of a body's steps, or where there are none."""
        if isinstance(self._gait, BodySteps) or not self._strides:
            return None
        return gait_totals(self._strides, self._gait.mounting)

    def _write_files(self, out: Path, result: Result) -> None:
        write_strides(out / "strides.csv", self._strides)
        (out / "result.json").write_text(result.to_json() + "\n")
        view = self.track.scorer.view(self.steps, self._start_position_m)
        write_report(out / "report.html", result, self._trace, self._strides, view)

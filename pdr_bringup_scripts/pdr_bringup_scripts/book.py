"""Keeps of a run what its result, its report and its files need, in bounded memory."""

from contextlib import ExitStack
from pathlib import Path
from typing import TextIO

import numpy as np

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.external import External
from pdr_core.evaluation.gait_totals import GaitTotals, gait_totals
from pdr_core.evaluation.report import write_report
from pdr_core.evaluation.result import CAUSAL, Hindsight, Result
from pdr_core.evaluation.saving import Saving
from pdr_core.evaluation.score import Scorer, start_of_steps_m
from pdr_core.evaluation.trace import Trace
from pdr_core.evaluation.words import nothing_usable
from pdr_core.params import Params, params_as_mapping
from pdr_core.pipeline import BodySteps, FootGait, FootOutput
from pdr_core.recording import Sensor, Session
from pdr_core.recording.strides import write_strides
from pdr_core.recording.tum import Trajectory, append_tum, write_tum_header
from pdr_core.records import Floats, Notice, StepEvent, length
from pdr_core.records_gait import Stride

FILES = "trajectory.tum, strides.csv, result.json, report.html"


def make_folder(path: Path) -> None:
    """Create a folder, or say why that cannot be done."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except FileExistsError as error:
        raise Problem(f"cannot write to {path}: it is a file, and a folder is needed") from error
    except OSError as error:
        raise Problem(f"cannot write to {path}: {error.strerror}") from error


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
        self._scorer = Scorer(sensor.truth)
        self._trace = Trace()
        self._out = out
        self._trajectory: TextIO | None = None
        self.duration_s = 0.0  # of the estimate; where the clock jumps back, nobody knows how much time passed
        self._last_ns: int | None = None
        self.steps: list[StepEvent] = []
        self._gait = gait or FootGait()
        self._strides: list[Stride] = []
        if out:
            make_folder(out)
            self._trajectory = stack.enter_context((out / "trajectory.tum").open("w"))
            write_tum_header(self._trajectory)

    def keep(self, output: FootOutput) -> None:
        """Take the next estimates and steps."""
        nav = output.nav
        self.steps += output.steps
        self._strides += self._gait.run(output)
        if not length(nav):
            return
        steps_ns = np.diff(nav.stamp_ns, prepend=nav.stamp_ns[0] if self._last_ns is None else self._last_ns)
        self.duration_s += float(np.clip(steps_ns, 0, None).sum()) / NANOSECONDS
        self._last_ns = int(nav.stamp_ns[-1])
        self._scorer.add(nav)
        self._trace.add(output.judged, nav)
        if self._trajectory:
            append_tum(self._trajectory, Trajectory(nav.stamp_ns, nav.position_m, nav.quat_xyzw))

    @property
    def _start_position_m(self) -> Floats:
        return start_of_steps_m(self.steps, self._scorer.start_position_m)

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
        if self._last_ns is None:
            raise Problem(nothing_usable(str(self._session.path), notices))
        self._strides += self._gait.finish()
        result = Result(
            recording=str(self._session.path),
            format=self._session.format,
            samples=samples,
            duration_s=self.duration_s,
            pipeline=pipeline,
            **hindsight._asdict(),
            strides=len(self.steps),
            distance_m=float(sum(step.length_m for step in self.steps)),
            end_position_m=self._scorer.end_position_m,
            closure_2d_m=self._scorer.closure_2d_m,
            closure_3d_m=self._scorer.closure_3d_m,
            gait=self._gait_totals(),
            seconds=seconds,
            notices=[*self._session.notices, *notices, *self._gait.notices],
            config=params_as_mapping(params),
            truth=self._scorer.score(self.steps, self._start_position_m),
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
        view = self._scorer.view(self.steps, self._start_position_m)
        write_report(out / "report.html", result, self._trace, self._strides, view)

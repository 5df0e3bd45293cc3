"""Estimates recordings offline, piece by piece, in bounded memory."""

import time
from contextlib import ExitStack
from pathlib import Path

import numpy as np

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.provenance import VERSION, commit
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.report import write_report
from pdr_core.evaluation.result import Result, SensorsResult
from pdr_core.evaluation.score import Scorer
from pdr_core.evaluation.trace import Trace
from pdr_core.params import Params, params_as_mapping
from pdr_core.pipeline import FootInertial, FootOutput
from pdr_core.recording import Sensor, Session
from pdr_core.recording.strides import write_strides
from pdr_core.recording.tum import Trajectory, append_tum, write_tum_header
from pdr_core.records import ImuBlock, StepEvent, length
from pdr_core.warmup import warm_up

PIPELINE = "foot_inertial"


def run_recording(
    session: Session, params: Params, sensor: str | None, out: Path | None, terminal: Terminal
) -> Result | SensorsResult:
    """Estimate one sensor of a recording, or all of them; `out` gets the files, in folders where there are several."""
    chosen = chosen_sensors(session, sensor)
    warm_up()
    if len(chosen) == 1:
        return run_sensor(session, chosen[0], params, out, terminal)
    results = {s.name: run_sensor(session, s, params, out / s.name if out else None, terminal) for s in chosen}
    together = SensorsResult(str(session.path), session.format, results)
    if out:
        (out / "result.json").write_text(together.to_json() + "\n")
    return together


def chosen_sensors(session: Session, name: str | None) -> list[Sensor]:
    """Return the sensor that is asked for, or all."""
    if name is None:
        return list(session.sensors.values())
    if name not in session.sensors:
        raise Problem(f"{session.path} has no sensor {name!r}; choose from {', '.join(session.sensors)}")
    return [session.sensors[name]]


def run_sensor(session: Session, sensor: Sensor, params: Params, out: Path | None, terminal: Terminal) -> Result:
    """Estimate one sensor and write its files."""
    book = Book(session, sensor, params)
    with ExitStack() as stack:
        if out:
            make_folder(out)
            book.write_trajectory_to(stack, out / "trajectory.tum")
        show = stack.enter_context(terminal.progress(f"Estimating {sensor.name}"))
        for piece in sensor.pieces():
            book.take(piece)
            show(f"{book.duration_s:.0f} s of the recording, {len(book.steps)} strides")
        book.finish()
    result = book.result()
    if out:
        book.write_files(out, result)
    return result


def make_folder(path: Path) -> None:
    """Create a folder, or say why that cannot be done."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Problem(f"cannot write to {path}: {error.strerror}") from error


class Book:
    """Feeds a pipeline and keeps what the result, the report and the files need."""

    def __init__(self, session: Session, sensor: Sensor, params: Params) -> None:
        self._session = session
        self._params = params
        self._pipeline = FootInertial(params)
        self._scorer = Scorer(sensor.truth)
        self._trace = Trace()
        self._trajectory = None
        self._samples = 0
        self._stamps_ns: list[int] = []
        self._seconds = 0.0
        self.steps: list[StepEvent] = []

    def write_trajectory_to(self, stack: ExitStack, path: Path) -> None:
        """Write every estimate to a TUM file from now on."""
        self._trajectory = stack.enter_context(path.open("w"))
        write_tum_header(self._trajectory)

    def take(self, piece: ImuBlock) -> None:
        """Estimate the next piece."""
        self._samples += length(piece)
        begin = time.perf_counter()
        output = self._pipeline.run(piece)
        self._seconds += time.perf_counter() - begin
        self._keep(output)

    def finish(self) -> None:
        """Estimate what still waits."""
        self._keep(self._pipeline.finish())

    @property
    def duration_s(self) -> float:
        """Time [s] from the first to the last estimate."""
        return (self._stamps_ns[-1] - self._stamps_ns[0]) * 1e-9 if self._stamps_ns else 0.0

    def _keep(self, output: FootOutput) -> None:
        nav = output.nav
        if length(nav):
            self._stamps_ns = [*self._stamps_ns[:1], int(nav.stamp_ns[0]), int(nav.stamp_ns[-1])]
        self._scorer.add(nav)
        self._trace.add(output.judged, nav)
        self.steps += output.steps
        if self._trajectory:
            append_tum(self._trajectory, Trajectory(nav.stamp_ns, nav.position_m, nav.quat_xyzw))

    @property
    def _start_position_m(self) -> np.ndarray:
        first = self.steps[0] if self.steps else None
        return first.position_m - first.displacement_m if first else self._scorer.start_position_m

    def result(self) -> Result:
        """Return what the run gave."""
        if not self._stamps_ns:
            raise Problem(f"{self._session.path} holds no usable sample")
        return Result(
            recording=str(self._session.path),
            format=self._session.format,
            samples=self._samples,
            duration_s=self.duration_s,
            pipeline=PIPELINE,
            strides=len(self.steps),
            distance_m=float(sum(step.length_m for step in self.steps)),
            end_position_m=self._scorer.end_position_m,
            closure_2d_m=self._scorer.closure_2d_m,
            closure_3d_m=self._scorer.closure_3d_m,
            seconds=self._seconds,
            notices=[*self._session.notices, *self._pipeline.notices],
            config=params_as_mapping(self._params),
            truth=self._scorer.score(self.steps, self._start_position_m),
            version=VERSION,
            commit=commit(),
        )

    def write_files(self, out: Path, result: Result) -> None:
        """Write strides, result and report."""
        write_strides(out / "strides.csv", self.steps)
        (out / "result.json").write_text(result.to_json() + "\n")
        view = self._scorer.view(self.steps, self._start_position_m)
        write_report(out / "report.html", result, self._trace, self.steps, view)

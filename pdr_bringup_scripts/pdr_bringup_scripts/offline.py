"""Estimates recordings offline, piece by piece, in bounded memory."""

import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import TypeVar

from pdr_bringup_scripts.book import Book
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.result import CAUSAL, Hindsight, Result, SensorsResult
from pdr_core.params import Params
from pdr_core.pipeline import FootInertial, SmoothedFoot, stance_phases
from pdr_core.recording import Sensor, Session
from pdr_core.records import Floats, length
from pdr_core.warmup import warm_up

T = TypeVar("T")
PIPELINE = "foot_inertial"


def run_recording(
    session: Session,
    params: Params,
    sensor: str | None,
    out: Path | None,
    terminal: Terminal,
    hindsight: Hindsight = CAUSAL,
) -> Result | SensorsResult:
    """Estimate one sensor of a recording, or all of them; `out` gets the files, in folders where there are several."""
    chosen = chosen_sensors(session, sensor)
    check_output(out, session)
    warm_up(params, hindsight.smoothed)
    run = run_sensor_smoothed if hindsight.smoothed else run_sensor
    if len(chosen) == 1:
        return run(session, chosen[0], params, out, terminal, hindsight.two_passes)
    results = {
        s.name: run(session, s, params, out / s.name if out else None, terminal, hindsight.two_passes) for s in chosen
    }
    together = SensorsResult(str(session.path), session.format, results)
    if out:
        (out / "result.json").write_text(together.to_json() + "\n")
    return together


def check_output(out: Path | None, session: Session) -> None:
    """Problem if the folder for the files is the recording."""
    if out and out.resolve() == session.path.resolve():
        raise Problem(f"{out} is the recording itself: choose another folder by --out")


def chosen_sensors(session: Session, name: str | None) -> list[Sensor]:
    """Return the sensor that is asked for, or all."""
    if name is None:
        return list(session.sensors.values())
    if name not in session.sensors:
        raise Problem(f"{session.path} has no sensor {name!r}; choose from {', '.join(session.sensors)}")
    return [session.sensors[name]]


def only_sensor(session: Session, name: str) -> Sensor:
    """Return the sensor of that name, or the only one of a recording."""
    sensors = chosen_sensors(session, name or None)
    if len(sensors) > 1:
        raise Problem(f"{session.path} has several sensors; choose one by --sensor: {', '.join(session.sensors)}")
    return sensors[0]


def has_magnetometer(sensor: Sensor) -> bool:
    """Tell whether any sample has a magnetic field; read up to there."""
    return any((piece.field_sd_tesla >= 0.0).any() for piece in sensor.pieces())


class Watch:
    """Adds up the time that the estimation alone takes."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self, work: Callable[..., T], *arguments: object) -> T:
        """Return what the work gives."""
        begin = time.perf_counter()
        result = work(*arguments)
        self.seconds += time.perf_counter() - begin
        return result


def run_sensor(
    session: Session, sensor: Sensor, params: Params, out: Path | None, terminal: Terminal, two_passes: bool = False
) -> Result:
    """Estimate one sensor and write its files; `two_passes`: the time gate knows the whole recording."""
    watch, samples = Watch(), 0
    pipeline = FootInertial(params, phases_s=first_pass(sensor, params, watch) if two_passes else None)
    with ExitStack() as stack:
        book = Book(session, sensor, out, stack)
        show = stack.enter_context(terminal.progress(f"Estimating {sensor.name}"))
        for piece in sensor.pieces():
            book.keep(watch(pipeline.run, piece))
            samples += length(piece)
            show(f"{book.duration_s:.0f} s of the recording, {len(book.steps)} strides")
        book.keep(pipeline.finish())
        return book.close(PIPELINE, params, samples, watch.seconds, pipeline.notices, Hindsight(two_passes=two_passes))


def first_pass(sensor: Sensor, params: Params, watch: Watch) -> Floats:
    """Return how long the stances of the whole recording last, (n,) [s]; what this takes includes the reading."""
    return watch(stance_phases, sensor.pieces(), params)


def run_sensor_smoothed(
    session: Session, sensor: Sensor, params: Params, out: Path | None, terminal: Terminal, two_passes: bool = False
) -> Result:
    """Estimate one sensor by its whole recording and write its files; `two_passes`: the time gate knows it too."""
    watch, samples = Watch(), 0
    pipeline = SmoothedFoot(params, first_pass(sensor, params, watch) if two_passes else None)
    with ExitStack() as stack:
        book = Book(session, sensor, out, stack)
        with terminal.progress(f"Estimating {sensor.name}") as show:
            for piece in sensor.pieces():
                watch(pipeline.run, piece)
                samples += length(piece)
                show(f"{samples} samples, {len(pipeline.steps)} strides")
        show = stack.enter_context(terminal.progress(f"Smoothing {sensor.name}"))
        outputs = pipeline.finish(lambda share: show(f"{share:.0%}"))
        while output := watch(next, outputs, None):
            book.keep(output)
        return book.close(PIPELINE, params, samples, watch.seconds, pipeline.notices, Hindsight(True, two_passes))

"""Estimates recordings offline, piece by piece, in bounded memory."""

import time
from contextlib import ExitStack
from pathlib import Path

from pdr_bringup_scripts.book import Book
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.result import Result, SensorsResult
from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.recording import Sensor, Session
from pdr_core.records import length
from pdr_core.warmup import warm_up

PIPELINE = "foot_inertial"


def run_recording(
    session: Session, params: Params, sensor: str | None, out: Path | None, terminal: Terminal
) -> Result | SensorsResult:
    """Estimate one sensor of a recording, or all of them; `out` gets the files, in folders where there are several."""
    chosen = chosen_sensors(session, sensor)
    check_output(out, session)
    warm_up(params)
    if len(chosen) == 1:
        return run_sensor(session, chosen[0], params, out, terminal)
    results = {s.name: run_sensor(session, s, params, out / s.name if out else None, terminal) for s in chosen}
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


def run_sensor(session: Session, sensor: Sensor, params: Params, out: Path | None, terminal: Terminal) -> Result:
    """Estimate one sensor and write its files."""
    pipeline, samples, seconds = FootInertial(params), 0, 0.0
    with ExitStack() as stack:
        book = Book(session, sensor, out, stack)
        show = stack.enter_context(terminal.progress(f"Estimating {sensor.name}"))
        for piece in sensor.pieces():
            begin = time.perf_counter()
            output = pipeline.run(piece)
            seconds += time.perf_counter() - begin
            samples += length(piece)
            book.keep(output)
            show(f"{book.duration_s:.0f} s of the recording, {len(book.steps)} strides")
        book.keep(pipeline.finish())
        return book.close(PIPELINE, params, samples, seconds, pipeline.notices)

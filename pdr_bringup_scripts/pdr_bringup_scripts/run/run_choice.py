"""Which pipeline estimates a recording: the one place where `pdr run` chooses, by its options and the sensors."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.both import run_both
from pdr_bringup_scripts.run.external_run import run_external
from pdr_bringup_scripts.run.offline import run_adaptive, run_chest, run_foot, run_smoothed
from pdr_bringup_scripts.run.run_options import RunOptions
from pdr_bringup_scripts.run.which_sensors import chosen_sensors, feet_of, only_sensor
from pdr_core.evaluation.result import CHEST, Result, SensorsResult
from pdr_core.params import Params
from pdr_core.recording import Sensor, Session


def estimated(session: Session, params: Params, options: RunOptions) -> Result | SensorsResult:
    """Estimate two feet together where there are two, and other sensors each for itself; write the files."""
    feet = [] if options.each_alone else feet_of(session, options.feet)
    if not feet:
        return each_estimated(session, params, options)
    check_output(options.out, session)
    return written(run_both(session, feet, params, options), options.out)


def each_estimated(session: Session, params: Params, options: RunOptions) -> Result | SensorsResult:
    """Estimate every sensor for itself, or the one that is asked for; several get folders of their own."""
    wanted = options.sensor
    sensors = [only_sensor(session, wanted)] if options.one_alone else chosen_sensors(session, wanted)
    run = pipeline_of_one(options)
    check_output(options.out, session)
    if len(sensors) == 1:
        return run(session, sensors[0], params, options)
    folders = {sensor.name: options.out / sensor.name if options.out else None for sensor in sensors}
    results = {s.name: run(session, s, params, replace(options, out=folders[s.name])) for s in sensors}
    return written(SensorsResult(str(session.path), session.format, results), options.out)


def pipeline_of_one(options: RunOptions) -> Callable[[Session, Sensor, Params, RunOptions], Result]:
    """Return what estimates one sensor."""
    if options.beside:
        return run_external
    if options.pipeline == CHEST:
        return run_chest
    if options.adaptive:
        return run_adaptive
    return run_smoothed if options.smooth else run_foot


def check_output(out: Path | None, session: Session) -> None:
    """Problem if the folder for the files is the recording."""
    if out and out.resolve() == session.path.resolve():
        raise Problem(f"{out} is the recording itself: choose another folder by --out")


def written(together: SensorsResult, out: Path | None) -> SensorsResult:
    """Write the result of several sensors beside their folders."""
    if out:
        (out / "result.json").write_text(together.to_json() + "\n")
    return together

"""Estimates a recording beside somebody else's odometry in the same bag: compared with it, or aided by it."""

from collections.abc import Sequence
from contextlib import ExitStack

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.book import Book
from pdr_bringup_scripts.run.known_points import arrivals_of, write_on_map
from pdr_bringup_scripts.run.offline import Watch
from pdr_bringup_scripts.run.run_options import RunOptions
from pdr_bringup_scripts.run.turns import Beside, in_turn
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.external import External
from pdr_core.evaluation.result import Result
from pdr_core.params import Params
from pdr_core.pipeline import AidedFoot, ComparedFoot
from pdr_core.recording import Arrivals, Sensor, Session
from pdr_core.records import length
from pdr_core.warmup import warm_up

AIDED, COMPARED = "aided_foot", "compared_foot"


def run_external(session: Session, sensor: Sensor, params: Params, options: RunOptions) -> Result:
    """Estimate a foot beside a topic or known points; `external.mode` says what fixes are for.

    Problem if the recording has no topics.
    """
    aids, come = params.external.mode == "aid", come_beside(session, [sensor], options)
    warm_up(params, both=aids)
    watch, pipeline = Watch(), AidedFoot(params) if aids else ComparedFoot(params)
    with ExitStack() as stack:
        book, samples = Book(session, sensor, options.out, stack), 0
        with Terminal().progress(f"Estimating {sensor.name}") as show:
            for _, piece in in_turn([sensor], Beside(come, pipeline.fixes)):
                book.keep(watch(pipeline.run, piece) if piece else pipeline.finish())
                samples += length(piece) if piece else 0
                show(f"{book.track.duration_s:.0f} s of the recording, {len(book.steps)} strides")
        external = External(options.external, aids, pipeline.comparison)
        name = AIDED if aids else COMPARED
        result = book.close(name, params, samples, watch.seconds, pipeline.notices, external=external)
    if options.out and external.comparison.frame:
        write_on_map(options.out, external.comparison.frame)
    return result


def come_beside(session: Session, sensors: Sequence[Sensor], options: RunOptions) -> Arrivals:
    """Return what comes beside the samples; Problem if it is a topic, and the recording has none."""
    if options.at:
        return arrivals_of(options.at, sensors)
    if session.arrivals is None:
        raise Problem(f"{session.path} has no topics: --external needs a bag that holds both")
    return session.arrivals([sensor.name for sensor in sensors], options.external)

"""Estimates one sensor of a recording offline, piece by piece, in bounded memory: a function for each pipeline."""

import time
from collections.abc import Callable
from contextlib import ExitStack
from typing import TypeVar

from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.book import Book
from pdr_bringup_scripts.run.run_options import RunOptions
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.result import CHEST, Result
from pdr_core.evaluation.saving import Saving
from pdr_core.params import Params
from pdr_core.pipeline import (
    BodySteps,
    ChestCard,
    ConstrainedFoot,
    FootAdaptive,
    FootInertial,
    SmoothedFoot,
    stance_phases,
)
from pdr_core.pipeline.constrained_foot import constrains
from pdr_core.recording import Sensor, Session
from pdr_core.records import Floats, length
from pdr_core.warmup import warm_up

T = TypeVar("T")
PIPELINE, ADAPTIVE = "foot_inertial", "foot_adaptive"


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


def run_foot(session: Session, sensor: Sensor, params: Params, options: RunOptions) -> Result:
    """Estimate a foot as it walks."""
    warm_up(params)
    watch = Watch()
    pipeline = ConstrainedFoot(params, phases(sensor, params, options, watch))
    with ExitStack() as stack:
        book = Book(session, sensor, options.out, stack)
        samples = estimate(pipeline, sensor, book, watch)
        return book.close(PIPELINE, params, samples, watch.seconds, pipeline.notices, options.hindsight)


def run_adaptive(session: Session, sensor: Sensor, params: Params, options: RunOptions) -> Result:
    """Estimate a foot as if its gyro had been switched."""
    warm_up(params)
    watch, pipeline = Watch(), FootAdaptive(params)
    with ExitStack() as stack:
        book = Book(session, sensor, options.out, stack)
        samples = estimate(pipeline, sensor, book, watch)
        saving = Saving(pipeline.energy, pipeline.commands)
        return book.close(ADAPTIVE, params, samples, watch.seconds, pipeline.notices, saving=saving)


def run_chest(session: Session, sensor: Sensor, params: Params, options: RunOptions) -> Result:
    """Estimate a card on the chest."""
    ChestCard(params).warm_up()
    watch, pipeline = Watch(), ChestCard(params)
    with ExitStack() as stack:
        book = Book(session, sensor, options.out, stack, BodySteps())
        samples = estimate(pipeline, sensor, book, watch)
        return book.close(CHEST, params, samples, watch.seconds, pipeline.notices)


def run_smoothed(session: Session, sensor: Sensor, params: Params, options: RunOptions) -> Result:
    """Estimate a foot by its whole recording; Problem if a heading constraint would turn it while it goes on."""
    if constrains(params):
        text = "--smooth knows nothing of what a heading constraint tells the filter: leave out --smooth or --heading"
        raise Problem(f"{text}, or set heading.constraint: none in the parameter file")
    warm_up(params, smooth=True)
    watch, samples = Watch(), 0
    pipeline = SmoothedFoot(params, phases(sensor, params, options, watch))
    with ExitStack() as stack:
        book = Book(session, sensor, options.out, stack)
        with Terminal().progress(f"Estimating {sensor.name}") as show:
            for piece in sensor.pieces():
                watch(pipeline.run, piece)
                samples += length(piece)
                show(f"{samples} samples, {len(pipeline.steps)} strides")
        show = stack.enter_context(Terminal().progress(f"Smoothing {sensor.name}"))
        outputs = pipeline.finish(lambda share: show(f"{share:.0%}"))
        while output := watch(next, outputs, None):
            book.keep(output)
        return book.close(PIPELINE, params, samples, watch.seconds, pipeline.notices, options.hindsight)


def estimate(pipeline: FootInertial | FootAdaptive | ChestCard, sensor: Sensor, book: Book, watch: Watch) -> int:
    """Let the book keep what a pipeline makes of a sensor; return the number of samples."""
    samples = 0
    with Terminal().progress(f"Estimating {sensor.name}") as show:
        for piece in sensor.pieces():
            book.keep(watch(pipeline.run, piece))
            samples += length(piece)
            show(f"{book.track.duration_s:.0f} s of the recording, {len(book.steps)} strides")
        book.keep(pipeline.finish())
    return samples


def phases(sensor: Sensor, params: Params, options: RunOptions, watch: Watch) -> Floats | None:
    """Return how long the stances last, (n,) [s], by a first pass with its reading; None if the time gate learns it."""
    return watch(stance_phases, sensor.pieces(), params) if options.hindsight.two_passes else None

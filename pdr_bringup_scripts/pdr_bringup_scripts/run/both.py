"""Estimates two feet of a recording together: the files of each foot, and those of the body between them.

Beside somebody else's odometry or known points the body is compared with them, or both feet are aided by them.
"""

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path

from pdr_bringup_scripts.run.body_book import BodyBook
from pdr_bringup_scripts.run.book import Book
from pdr_bringup_scripts.run.external_run import come_beside
from pdr_bringup_scripts.run.known_points import write_on_map
from pdr_bringup_scripts.run.offline import Watch
from pdr_bringup_scripts.run.run_options import RunOptions
from pdr_bringup_scripts.run.turns import Beside, in_turn
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.external import External
from pdr_core.evaluation.result import SensorsResult
from pdr_core.params import Params, changed
from pdr_core.pipeline import AidedFeet, BothFeet, BothOutput, ComparedFeet
from pdr_core.pipeline.both_feet import BODY
from pdr_core.recording import Sensor, Session
from pdr_core.records import length
from pdr_core.warmup import warm_up

PIPELINES = {BothFeet: "both_feet", ComparedFeet: "compared_feet", AidedFeet: "aided_feet"}


def run_both(session: Session, feet: Sequence[Sensor], params: Params, options: RunOptions) -> SensorsResult:
    """Estimate a left and a right foot; `options.out` gets a folder for each and one for the body."""
    out, names = options.out, [foot.name for foot in feet]
    asking = changed(params, "filter", heading_feedback=True)
    warm_up(asking, both=True)
    heard = hearing(asking, names) if options.beside else None
    both, watch, samples = heard or BothFeet(asking, names), Watch(), dict.fromkeys(names, 0)
    turns = in_turn(feet, Beside(come_beside(session, feet, options), heard.fixes) if heard else None)
    with ExitStack() as stack:
        books = {foot.name: Book(session, foot, out / foot.name if out else None, stack) for foot in feet}
        body = BodyBook(session, feet, out / BODY if out else None, stack)
        show = stack.enter_context(Terminal().progress("Estimating both feet"))
        for foot, piece in turns:
            samples[foot] += length(piece) if piece else 0
            keep(watch(both.run, foot, piece) if piece else watch(both.end, foot), books, body)
            show(f"{body.track.duration_s:.0f} s of the recording")
        keep(watch(both.finish), books, body)
        name, notices, seconds = PIPELINES[type(both)], both.notices, watch.seconds
        results = {n: book.close(name, asking, samples[n], seconds, notices[n]) for n, book in books.items()}
        external = External(options.external, isinstance(both, AidedFeet), heard.comparison) if heard else None
        of_body = body.close(name, asking, results, seconds, notices[BODY], both.placed_m, external)
    if out and heard:
        lay_on_map(out, names, heard)
    return SensorsResult(str(session.path), session.format, results, of_body)


def hearing(params: Params, feet: Sequence[str]) -> AidedFeet | ComparedFeet:
    """Return who hears what comes beside: aided by it, or compared with it, as `external.mode` says."""
    return AidedFeet(params, feet) if params.external.mode == "aid" else ComparedFeet(params, feet)


def keep(output: BothOutput, books: Mapping[str, Book], body: BodyBook) -> None:
    """Give each book what is its."""
    for foot, one in output.feet:
        books[foot].keep(one)
        body.keep_foot(foot, one)
    body.keep(output.body)


def lay_on_map(out: Path, feet: Sequence[str], heard: AidedFeet | ComparedFeet) -> None:
    """Write the trajectories of the body and of both feet once more, in their frame, if it is known."""
    frames = {BODY: heard.comparison.frame} | {foot: heard.frame_of(foot) for foot in feet}
    for name, frame in frames.items():
        if frame:
            write_on_map(out / name, frame)

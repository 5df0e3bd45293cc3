"""Estimates two feet of a recording together: the files of each foot, and those of the body between them."""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path

from pdr_bringup_scripts.body_book import BodyBook
from pdr_bringup_scripts.book import Book
from pdr_bringup_scripts.offline import Watch
from pdr_bringup_scripts.terminal import Terminal
from pdr_core.evaluation.result import SensorsResult
from pdr_core.params import Params, changed
from pdr_core.pipeline import BothFeet, BothOutput
from pdr_core.recording import Sensor, Session
from pdr_core.records import ImuBlock, length
from pdr_core.warmup import warm_up

PIPELINE = "both_feet"
PIECE = 4096  # samples: as far as one foot runs ahead of the other


def run_both(session: Session, feet: Sequence[Sensor], params: Params, out: Path | None) -> SensorsResult:
    """Estimate a left and a right foot; `out` gets a folder for each and one for the body."""
    asking = changed(params, "filter", heading_feedback=True)
    warm_up(asking)
    watch, both = Watch(), BothFeet(asking, [foot.name for foot in feet])
    samples = dict.fromkeys((foot.name for foot in feet), 0)
    with ExitStack() as stack:
        books = {foot.name: Book(session, foot, out / foot.name if out else None, stack) for foot in feet}
        body = BodyBook(session, feet, out / "body" if out else None, stack)
        show = stack.enter_context(Terminal().progress("Estimating both feet"))
        for foot, piece in in_turn(feet):
            samples[foot] += length(piece) if piece else 0
            keep(watch(both.run, foot, piece) if piece else watch(both.end, foot), books, body)
            show(f"{body.track.duration_s:.0f} s of the recording")
        keep(watch(both.finish), books, body)
        notices = both.notices
        results = {
            name: book.close(PIPELINE, asking, samples[name], watch.seconds, notices[name])
            for name, book in books.items()
        }
        of_body = body.close(PIPELINE, asking, results, watch.seconds, notices["body"], both.placed_m)
    return SensorsResult(str(session.path), session.format, results, of_body)


def keep(output: BothOutput, books: Mapping[str, Book], body: BodyBook) -> None:
    """Give each book what is its."""
    for foot, one in output.feet:
        books[foot].keep(one)
        body.keep_foot(foot, one)
    body.keep(output.body)


def in_turn(feet: Sequence[Sensor]) -> Iterator[tuple[str, ImuBlock | None]]:
    """Yield pieces of the foot that is behind, by the time since its own first sample; None: it has no more."""
    readers = {foot.name: foot.pieces(PIECE) for foot in feet}
    first_ns: dict[str, int] = {}
    reached_ns: dict[str, float] = dict.fromkeys(readers, -math.inf)
    while readers:
        foot = min(readers, key=lambda name: reached_ns[name])
        piece = next(readers[foot], None)
        yield foot, piece
        if piece is None:
            del readers[foot]
        else:
            reached_ns[foot] = int(piece.stamp_ns[-1]) - first_ns.setdefault(foot, int(piece.stamp_ns[0]))

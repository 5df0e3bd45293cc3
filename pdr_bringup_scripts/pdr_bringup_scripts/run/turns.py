"""The samples of one sensor or of two feet in turn, and somebody else's fixes where they stand between them."""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from pdr_core.recording import Arrivals, Sensor
from pdr_core.records import ImuBlock, Stamps, length, part
from pdr_core.records_external import FixBlock

PIECE = 4096  # samples: as far as one foot runs ahead of the other


class Beside(NamedTuple):
    """What comes beside the samples, and who is told."""

    come: Arrivals
    tell: Callable[[FixBlock], object]


def in_turn(sensors: Sequence[Sensor], beside: Beside | None = None) -> Iterator[tuple[str, ImuBlock | None]]:
    """Yield pieces of the sensor that is behind; None: it has no more.

    Behind is the one that has passed fewer fixes, and of two the one with less time since its own first sample. Fixes
    are told between two pieces, as soon as every sensor has passed them.
    """
    after = beside.come.after_samples if beside else np.zeros((0, len(sensors)), np.int64)
    by_name = {sensor.name: (sensor, after[:, column]) for column, sensor in enumerate(sensors)}
    streams = {name: cut(sensor, counts) for name, (sensor, counts) in by_name.items()}
    passed = {name: (passed_by(counts, 0), -math.inf) for name, (_, counts) in by_name.items()}
    told = 0
    while streams:
        reached = min(fixes for fixes, _ in passed.values())
        if beside and reached > told:
            beside.tell(part(beside.come.fixes, told, reached))
            told = reached
        name = min(streams, key=passed.__getitem__)
        piece, passed[name] = next(streams[name], (None, (len(after), math.inf)))
        yield name, piece
        if piece is None:
            del streams[name]


def cut(sensor: Sensor, counts: Stamps) -> Iterator[tuple[ImuBlock, tuple[int, float]]]:
    """Yield pieces that end where fixes stand, each with how many it has passed and the time to its end [ns].

    Before each fix stand so many samples, `counts` (n,), ascending.
    """
    done, first_ns = 0, None
    for piece in sensor.pieces(PIECE):
        begin, end = done, done + length(piece)
        first_ns = int(piece.stamp_ns[0]) if first_ns is None else first_ns
        for stop in sorted({*counts[(counts > begin) & (counts < end)].tolist(), end}):
            some = part(piece, done - begin, stop - begin)
            done = stop
            yield some, (passed_by(counts, done), float(some.stamp_ns[-1] - first_ns))


def passed_by(counts: Stamps, samples: int) -> int:
    """Return how many fixes stand before the next sample."""
    return int(np.searchsorted(counts, samples, side="right"))

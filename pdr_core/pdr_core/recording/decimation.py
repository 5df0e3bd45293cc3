"""Recordings and streams at a lower rate; how the samples are filtered is in `maths/thinning.py`."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.maths.thinning import LONGEST, reached, thinned
from pdr_core.maths.thinning import kept_of as kept_of
from pdr_core.recording.session import Sensor
from pdr_core.records import NO_SAMPLES, ImuBlock, joined, length, part


class Decimation:
    """Every k-th sample of a stream, from the first one on, however the stream is cut."""

    def __init__(self, keep_every: int) -> None:
        self._keep_every = keep_every
        self._samples = NO_SAMPLES
        self._next = 0  # index of the next one to keep

    def run(self, block: ImuBlock) -> ImuBlock:
        """Return the samples that are kept of these and earlier ones, as far as what they need is there."""
        self._samples = joined([self._samples, block])
        return self._thinned(length(self._samples) - reached(self._keep_every))

    def finish(self) -> ImuBlock:
        """Return those that still wait for later ones."""
        return self._thinned(length(self._samples))

    def _thinned(self, stop: int) -> ImuBlock:
        kept = thinned(self._samples, self._next, max(stop, self._next), self._keep_every)
        after = self._next + length(kept) * self._keep_every
        first = min(max(0, after - reached(self._keep_every)), length(self._samples))
        self._samples, self._next = part(self._samples, first), after - first
        return kept


class ThinnedStream:
    """A stream that is taken sample by sample, at a rate that may be lowered at any of them."""

    def __init__(self, pieces: Iterator[ImuBlock]) -> None:
        self._pieces = pieces
        self._samples = NO_SAMPLES
        self._next = 0
        self._look_ahead(0)

    @property
    def next(self) -> ImuBlock | None:
        """The sample that `take` returns next, as it was measured; None at the end."""
        there = self._next < length(self._samples)
        return part(self._samples, self._next, self._next + 1) if there else None

    def take(self, keep_every: int) -> ImuBlock:
        """Return the next sample, filtered for one of so many that is kept, and go on to the one after it."""
        self._look_ahead(reached(keep_every))
        sample = thinned(self._samples, self._next, self._next + 1, keep_every)
        self._next += keep_every
        self._look_ahead(0)
        return sample

    def _look_ahead(self, samples: int) -> None:
        """Read on until so many samples after the next one are there, or the stream ends; keep the last ones."""
        while length(self._samples) <= self._next + samples and (piece := next(self._pieces, None)) is not None:
            first = min(max(0, self._next - LONGEST), length(self._samples))
            self._samples, self._next = joined([part(self._samples, first), piece]), self._next - first


def rate_of_hz(sensor: Sensor) -> float:
    """Return the usual rate of a sensor; 0 where it has no two samples in a row."""
    steps_ns = np.diff(next(sensor.pieces(), NO_SAMPLES).stamp_ns)
    steps_ns = steps_ns[steps_ns > 0]
    return NANOSECONDS / float(np.median(steps_ns)) if len(steps_ns) else 0.0


def decimated(sensor: Sensor, keep_every: int) -> Sensor:
    """Return the sensor as if it had measured at a lower rate; its truth stays as it is."""

    def read(max_samples: int) -> Iterator[ImuBlock]:
        decimation = Decimation(keep_every)
        for piece in sensor.pieces(max_samples):
            yield from nonempty(decimation.run(piece))
        yield from nonempty(decimation.finish())

    return replace(sensor, read=read)


def nonempty(block: ImuBlock) -> Iterator[ImuBlock]:
    """Yield a block if it holds samples."""
    if length(block):
        yield block

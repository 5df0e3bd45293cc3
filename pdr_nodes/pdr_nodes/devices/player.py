"""Plays a source sample by sample, with a gyro that can be switched off and a rate that can be lowered."""

from collections.abc import Iterator

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.records import ImuBlock, length, part
from pdr_nodes.devices.source import Source


class Player:
    """One sample ahead of what has been taken, so that a change of power or rate holds from a known stamp on."""

    def __init__(self, source: Source, settling_s: float) -> None:
        self._samples = samples(source)
        self._settling_ns = round(settling_s * NANOSECONDS)
        self._keep_every = 1
        self._gyro_on = True
        self._settled_ns = NO_STAMP
        self.taken = 0
        self.interval_s = 0.0
        self.next: ImuBlock | None = next(self._samples, None)

    @property
    def next_ns(self) -> int:
        """Stamp of the sample that `take` returns next."""
        if self.next is None:
            raise EOFError("the device has no more samples")
        return int(self.next.stamp_ns[0])

    def take(self) -> ImuBlock:
        """Return the next sample as the device gives it now."""
        sample, self.taken = self.next, self.taken + 1
        if sample is None:
            raise EOFError("the device has no more samples")
        for _ in range(self._keep_every):
            self.next = next(self._samples, None)
        if self.next is not None and self.interval_s == 0.0:
            self.interval_s = (self.next_ns - int(sample.stamp_ns[0])) / NANOSECONDS
        measures = self._gyro_on and sample.stamp_ns[0] >= self._settled_ns
        return sample if measures else without_gyro(sample)

    def set_gyro_power(self, on: bool) -> None:
        """Switch the gyro; after being switched on it needs its settling time before it measures."""
        if on and not self._gyro_on:
            self._settled_ns = self.next_ns + self._settling_ns
        self._gyro_on = on

    def set_sample_rate(self, rate_hz: float) -> float:
        """Keep every k-th sample so that the rate is as near as possible; return the rate that this gives [Hz]."""
        native_hz = 1.0 / self.interval_s
        self._keep_every = max(1, round(native_hz / rate_hz))
        return native_hz / self._keep_every


def samples(source: Source) -> Iterator[ImuBlock]:
    """Yield the samples one by one."""
    for piece in source.pieces:
        for i in range(length(piece)):
            yield part(piece, i, i + 1)


def without_gyro(sample: ImuBlock) -> ImuBlock:
    """Return the sample of a sensor whose gyro is off."""
    return sample._replace(gyro_radps=np.zeros((1, 3)), gyro_sd_radps=np.full(1, -1.0))

"""Lets one stream catch up with another at the start: to one who joins late, topics say what they remember in turn."""

import time

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.records import NO_SAMPLES, ImuBlock, joined, length, part

START_S = 2.0


class CatchUp:
    """For `START_S` from the first sample on, holds those whose stamps are `within_ns` or more ahead of the other's."""

    def __init__(self, within_ns: int) -> None:
        self._within_ns = within_ns
        self.begin()

    def begin(self) -> None:
        """Begin anew."""
        self._held = NO_SAMPLES
        self._since_s: float | None = None
        self._other_ns = NO_STAMP

    def end(self) -> None:
        """Nothing to end."""

    def heard(self, stamp_ns: int) -> None:
        """Note how far the other stream has come."""
        self._other_ns = stamp_ns

    def run(self, samples: ImuBlock) -> ImuBlock:
        """Return the samples that need not wait, of these and earlier ones."""
        self._since_s = self._since_s or time.monotonic()
        if time.monotonic() - self._since_s > START_S:
            return joined([self.finish(), samples])
        held = joined([self._held, samples])
        ahead = np.flatnonzero(held.stamp_ns >= self._other_ns + self._within_ns)
        count = int(ahead[0]) if len(ahead) else length(held)
        self._held = part(held, count)
        return part(held, 0, count)

    def finish(self) -> ImuBlock:
        """Return those that wait."""
        held, self._held = self._held, NO_SAMPLES
        return held

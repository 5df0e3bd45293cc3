"""Leaves out what a topic says once more."""

from typing import TypeVar

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.records import Stamps, part

Block = TypeVar("Block", bound=tuple)


class Repeats:
    """A stage that is started again gets its latest input once more and passes it on once more, up to now and beyond.

    Only a new connection repeats; where the stamps jump back on an old one, a recording is played in a loop.
    """

    def __init__(self) -> None:
        self._latest_ns = NO_STAMP
        self._known_until_ns = NO_STAMP

    def expect(self) -> None:
        """Note that a new connection may say once more what is known."""
        self._known_until_ns = self._latest_ns

    def left_out(self, block: Block) -> Block:
        """Return the block without the samples that came before."""
        stamp_ns = stamps(block)
        repeated = self._repeated(stamp_ns)
        if repeated < len(stamp_ns):
            self._latest_ns = int(stamp_ns[-1])
        return part(block, repeated)

    def _repeated(self, stamp_ns: Stamps) -> int:
        """Return how many of the first samples are known; with the first that is not, the repetition is over."""
        if self._known_until_ns == NO_STAMP:
            return 0
        known_ns, beyond = self._known_until_ns, np.flatnonzero(stamp_ns >= self._known_until_ns)
        if not len(beyond):
            return len(stamp_ns)
        self._known_until_ns = NO_STAMP
        return int(beyond[0]) + int(stamp_ns[beyond[0]] == known_ns)


def stamps(block: tuple) -> Stamps:
    """Return the stamps of a block [ns]."""
    first = block[0]
    return stamps(first) if isinstance(first, tuple) else first

"""Waits until one stream has caught up with another: to one who joins late, topics say what they remember in turn."""

import time

from pdr_core.conventions import NO_STAMP
from pdr_core.records import NO_SAMPLES, ImuBlock, joined, length

PATIENCE_S = 2.0


class CatchUp:
    """Holds the first samples until the other stream's stamps are less than `within_ns` behind, or `PATIENCE_S`."""

    def __init__(self, within_ns: int) -> None:
        self._within_ns = within_ns
        self.begin()

    def begin(self) -> None:
        """Begin anew."""
        self._held = NO_SAMPLES
        self._since_s = 0.0  # when the first one came
        self._other_ns = NO_STAMP
        self._behind = True

    def end(self) -> None:
        """Nothing to end."""

    def heard(self, stamp_ns: int) -> None:
        """Note how far the other stream has come."""
        self._other_ns = stamp_ns

    def run(self, samples: ImuBlock) -> ImuBlock:
        """Return the samples that need not wait, of these and earlier ones."""
        if not self._behind:
            return samples
        self._since_s = self._since_s if length(self._held) else time.monotonic()
        self._held = joined([self._held, samples])
        self._behind = self._is_behind()
        return NO_SAMPLES if self._behind else self.finish()

    def finish(self) -> ImuBlock:
        """Return those that wait."""
        held, self._held = self._held, NO_SAMPLES
        return held

    def _is_behind(self) -> bool:
        if not length(self._held):
            return True
        caught_up = self._other_ns > int(self._held.stamp_ns[-1]) - self._within_ns
        return not caught_up and time.monotonic() - self._since_s < PATIENCE_S

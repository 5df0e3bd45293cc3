"""Leaves out what a stage repeats after it was started again."""

from typing import Any

from pdr_core.conventions import NO_STAMP


class Repeats:
    """A stage that is started again gets its latest input once more and passes it on once more, up to now and beyond.

    Only a new publisher repeats; where the stamps of the same one jump back, a recording is played in a loop.
    """

    def __init__(self) -> None:
        self._latest_ns = NO_STAMP
        self._known_until_ns = NO_STAMP

    def matched(self, info: Any) -> None:
        """Note that a publisher has come or gone."""
        if info.current_count_change > 0:
            self._known_until_ns = self._latest_ns

    def has(self, stamp_ns: int) -> bool:
        """Tell whether the sample of this stamp came before."""
        known = stamp_ns <= self._known_until_ns
        if stamp_ns >= self._known_until_ns:
            self._known_until_ns = NO_STAMP
        if not known:
            self._latest_ns = stamp_ns
        return known

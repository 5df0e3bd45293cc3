"""Leaves out what a topic says once more."""

from collections.abc import Callable

from pdr_core.conventions import NO_STAMP


class Repeats:
    """A stage that is started again gets its latest input once more and passes it on once more, up to now and beyond.

    Only a new publisher repeats; where the stamps of the same one jump back, a recording is played in a loop. So it is
    asked who publishes when stamps jump back: the event that tells of a new publisher may come after its messages.
    """

    def __init__(self, publishers: Callable[[], frozenset]) -> None:
        self._publishers = publishers
        self._seen: frozenset = frozenset()
        self._latest_ns = NO_STAMP
        self._known_until_ns = NO_STAMP

    def expect(self) -> None:
        """Note that what is known may come once more."""
        self._seen = self._publishers()
        self._known_until_ns = self._latest_ns

    def has(self, stamp_ns: int) -> bool:
        """Tell whether the sample of this stamp came before; asked once for each, in order."""
        first = self._latest_ns == NO_STAMP
        back = stamp_ns <= self._latest_ns and self._known_until_ns == NO_STAMP
        if first or (back and self._publishers() - self._seen):
            self.expect()
        known = stamp_ns <= self._known_until_ns
        if stamp_ns >= self._known_until_ns:
            self._known_until_ns = NO_STAMP
        if not known:
            self._latest_ns = stamp_ns
        return known

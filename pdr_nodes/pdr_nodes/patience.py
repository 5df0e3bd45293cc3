"""Notices that something has been waited for too long."""

import time
from collections.abc import Callable


class Patience:
    """Calls `give_up` when `waits` has told of the same thing for a while, at every look; a while of 0 never ends.

    It is seen twice that it is time: where the node itself was held up, what came meanwhile is served in between.
    """

    def __init__(self, while_s: float, waits: Callable[[], object], give_up: Callable[[], None]) -> None:
        self._while_s = while_s
        self._waits = waits
        self._give_up = give_up
        self._what: object = None
        self._since_s = 0.0
        self._overdue = False

    def look(self) -> None:
        """Look at the clock."""
        what = self._waits()
        if not what or what != self._what or self._while_s == 0.0:
            self._begin(what)
        elif time.monotonic() - self._since_s > self._while_s:
            if self._overdue:
                self._begin(None)
                self._give_up()
            else:
                self._overdue = True

    def _begin(self, what: object) -> None:
        self._what, self._since_s, self._overdue = what, time.monotonic(), False

"""Notices that something has been waited for too long."""

import time
from collections.abc import Callable


class Patience:
    """Calls `give_up` when `waits` has been true for a while, at every look; a while of 0 never ends."""

    def __init__(self, while_s: float, waits: Callable[[], bool], give_up: Callable[[], None]) -> None:
        self._while_s = while_s
        self._waits = waits
        self._give_up = give_up
        self._since_s: float | None = None

    def look(self) -> None:
        """Look at the clock."""
        if not self._waits() or self._while_s == 0.0:
            self._since_s = None
        elif self._since_s is None:
            self._since_s = time.monotonic()
        elif time.monotonic() - self._since_s > self._while_s:
            self._since_s = None
            self._give_up()

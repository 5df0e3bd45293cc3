"""Notices that a stream has paused, so that what still waits for later samples can be given out."""

import time
from collections.abc import Callable


class IdleWatch:
    """Calls `finish` once when nothing has come for a while; the next sample starts the watch anew."""

    def __init__(self, after_s: float, finish: Callable[[], None]) -> None:
        self._after_s = after_s
        self._finish = finish
        self._last_s: float | None = None
        self._overdue = False

    def fed(self) -> None:
        """Note that a sample came."""
        self._last_s = time.monotonic()

    def look(self) -> None:
        """See twice whether it is time: where the node itself was held up, what waits is served in between."""
        overdue = self._last_s is not None and time.monotonic() - self._last_s > self._after_s
        if overdue and self._overdue:
            self._last_s, overdue = None, False
            self._finish()
        self._overdue = overdue

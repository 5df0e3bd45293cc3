"""Notices that a stream has ended, so that what still waits for later samples can be given out.

What is given out so counts as the end: where samples follow after all, the result is not that of the whole stream. So
where somebody is known to be there as long as samples may follow, a pause is no end before he has gone.
"""

import time
from collections.abc import Callable


class IdleWatch:
    """Calls `finish` once when nothing has come for a while; the next sample starts the watch anew."""

    def __init__(self, after_s: float, finish: Callable[[], None], may_go_on: Callable[[], bool]) -> None:
        self._after_s = after_s
        self._finish = finish
        self._may_go_on = may_go_on
        self._last_s: float | None = None
        self._overdue = False

    def fed(self) -> None:
        """Note that a sample came."""
        self._last_s = time.monotonic()

    def look(self) -> None:
        """See twice whether it is time: where the node itself was held up, what waits is served in between."""
        if self._last_s is not None and self._may_go_on():
            self._last_s = time.monotonic()
        overdue = self._last_s is not None and time.monotonic() - self._last_s > self._after_s
        if overdue and self._overdue:
            self._last_s, overdue = None, False
            self._finish()
        self._overdue = overdue

"""Plays at a steady pace."""

import time

from pdr_core.conventions import NANOSECONDS


class Pace:
    """Turns stamps into the time until a sample is due: `factor` times as fast as it was."""

    ready = True  # needs nobody but the subscribers
    notices: tuple[()] = ()

    def __init__(self, factor: float) -> None:
        self._factor = factor
        self._start: tuple[float, int] | None = None  # wall clock [s] and stamp [ns] of the first sample

    def begin(self) -> None:
        """Start with the next sample."""
        self._start = None

    def end(self) -> None:
        """Nothing to end."""

    def wait_s(self, stamp_ns: int) -> float:
        """Return the time [s] until a sample is due."""
        now_s = time.monotonic()
        self._start = self._start or (now_s, stamp_ns)
        start_s, start_ns = self._start
        return start_s + (stamp_ns - start_ns) / NANOSECONDS / self._factor - now_s

    def sent(self, stamp_ns: int) -> None:
        """Nobody waits for an answer."""

"""At most so many messages a second, told by their stamps alone."""

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.records import NavBlock, Stamps

AHEAD_NS = 20_000_000  # by so much a message may come before its turn


class RateLimit:
    """A leaky bucket: each message takes its turn, one period after the one before.

    A sensor of just that rate whose stamps scatter by several milliseconds loses nothing; of a faster one every k-th
    sample passes, at even distances once those that came before their turn are paid for.
    """

    def __init__(self, rate_hz: float) -> None:
        self._period_ns = round(NANOSECONDS / rate_hz)
        self._turn_ns = NO_STAMP
        self._latest_ns = NO_STAMP

    def allowed(self, stamp_ns: Stamps) -> list[int]:
        """Return which of the next messages may be sent."""
        return [i for i, at_ns in enumerate(stamp_ns.tolist()) if self.allows(at_ns)]

    def thinned(self, nav: NavBlock) -> NavBlock:
        """Return those of the next estimates that may be sent."""
        allowed = self.allowed(nav.stamp_ns)
        return NavBlock._make(column[allowed] for column in nav)

    def allows(self, at_ns: int) -> bool:
        """Tell whether the message of a stamp may be sent; asked once for each, in order."""
        if at_ns < self._latest_ns:  # the clock jumped back: a new stream
            self._turn_ns = at_ns
        self._latest_ns = at_ns
        if at_ns < self._turn_ns - AHEAD_NS:
            return False
        self._turn_ns = max(self._turn_ns, at_ns) + self._period_ns
        return True

"""Can the rate of the samples be true? A wrong unit of the time is a wrong rate."""

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.notices import Tally
from pdr_core.records import Level, Stamps

SAMPLES = 50
LOW_HZ = 45.0  # what will do for walking, and a clock that is not exact
ABSURD_HZ = (10.0, 5000.0)
NEEDED = "100 Hz or more are needed, 50 Hz will do for walking"
UNIT = "is the unit of the time right?"


class RateLook:
    """Looks at the stamps of the first samples, as they come."""

    def __init__(self) -> None:
        self._stamps_ns: list[int] = []
        self._over = False

    def watch(self, stamp_ns: Stamps, tally: Tally) -> None:
        """Look at the next stamps, (n,), and tell the tally of a rate that is too low or cannot be."""
        if self._over:
            return
        self._stamps_ns += stamp_ns[: SAMPLES - len(self._stamps_ns)].tolist()
        self._over = len(self._stamps_ns) == SAMPLES
        rates_hz = rates_of(np.array(self._stamps_ns, np.int64)) if self._over else ()
        if not rates_hz:
            return
        said = f"by their stamps samples come {{:.3g}} times a second: {NEEDED}"
        at_ns = self._stamps_ns[0]
        if max(rates_hz) < ABSURD_HZ[0]:
            tally.add("sample_rate", Level.ERROR, f"{said.format(max(rates_hz))}; {UNIT}", at_ns)
        elif max(rates_hz) < LOW_HZ:
            tally.add("sample_rate", Level.WARN, said.format(max(rates_hz)), at_ns)
        elif min(rates_hz) > ABSURD_HZ[1]:
            text = f"by their stamps samples come {min(rates_hz):.0f} times a second: {UNIT}"
            tally.add("sample_rate", Level.ERROR, text, at_ns)


def rates_of(stamp_ns: Stamps) -> tuple[float, ...]:
    """Return the rate [Hz] by the usual interval, which a gap leaves as it is, and by the mean one, which bursts do.

    Nothing where the clock stands or is none.
    """
    steps_ns = np.diff(stamp_ns)
    ahead_ns = steps_ns[steps_ns > 0]
    whole_ns = int(stamp_ns[-1] - stamp_ns[0])
    if not len(ahead_ns) or whole_ns <= 0:
        return ()
    return (NANOSECONDS / float(np.median(ahead_ns)), NANOSECONDS * len(steps_ns) / whole_ns)

"""Notes where a magnetometer falls silent while the inertial stream goes on."""

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS
from pdr_core.field_pairing.clock import LATEST_NS, steps_ns
from pdr_core.notices import Tally
from pdr_core.records import Flags, Level, Stamps

SILENCE_NS = NANOSECONDS
AT_ONCE = 100  # arrivals
TEXT = "no magnetic field belonged to the samples for more than 1 s, check the magnetometer and its stamps"


class Silence:
    """Counts how often samples were without a field for more than a second, times without samples left out."""

    def __init__(self, tally: Tally) -> None:
        self._tally = tally
        self._noted: list[tuple[Stamps, Flags]] = []
        self._silent = False
        self.begin_anew()

    def begin_anew(self) -> None:
        """Note that the clock has jumped."""
        self.count()
        self._last_ns: int | None = None
        self._seen_ns = -LATEST_NS - 1

    def note(self, stamp_ns: Stamps, paired: Flags) -> None:
        """Take samples that were given out, (n,), and whether they had a field."""
        self._noted.append((stamp_ns, paired))
        if len(self._noted) > AT_ONCE:
            self.count()

    def count(self) -> None:
        """Put what was noted into the tally."""
        if not self._noted:
            return
        stamp_ns, paired = (np.concatenate(column) for column in zip(*self._noted, strict=True))
        self._noted = []
        begins = steps_ns(stamp_ns, self._last_ns) > GAP_NS
        begins[0] |= self._last_ns is None
        marks_ns = np.where(paired | begins, stamp_ns, self._seen_ns)
        seen_ns = np.maximum.accumulate(np.maximum(marks_ns, self._seen_ns))
        silent = stamp_ns - seen_ns > SILENCE_NS
        falls = silent & ~np.concatenate([[self._silent], silent[:-1]])
        self._tally.add_flagged("field_silent", Level.WARN, TEXT, falls, stamp_ns)
        self._last_ns, self._seen_ns, self._silent = int(stamp_ns[-1]), int(seen_ns[-1]), bool(silent[-1])

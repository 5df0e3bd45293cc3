"""The measurements of the field that have come and are not taken yet, in the order of their stream."""

from collections import deque
from typing import NamedTuple

import numpy as np

from pdr_core.field_pairing.clock import LATEST_NS, Clock, within_reckoning
from pdr_core.notices import Tally
from pdr_core.records import Flags, Floats, ImuBlock, Level, Stamps, joined, length, part

MOST = 500_000  # so many wait only where the inertial stream has stopped
HEAP = 1000  # arrivals, or fields that nobody needs any more, that are cleared up at once
NOT_HEARD_NS = -LATEST_NS - 1


class Fields(NamedTuple):
    """m measurements of the field."""

    stamp_ns: Stamps  # (m,)
    newest_ns: Stamps  # (m,) the latest stamp so far by this clock
    clock: Stamps  # (m,) how often the clock had jumped back
    field_tesla: Floats  # (m, 3)
    field_sd_tesla: Floats  # (m,) -1: none at this stamp
    ascends: Flags  # (m,) later than all before by this clock
    free: Flags  # (m,) not taken
    late: Flags  # (m,) its sample had been given out before it came


NO_TIMES, NO_FLAGS = np.zeros(0, np.int64), np.zeros(0, np.bool_)
NO_FIELDS = Fields(NO_TIMES, NO_TIMES, NO_TIMES, np.zeros((0, 3)), np.zeros(0), NO_FLAGS, NO_FLAGS, NO_FLAGS)


class FieldStore:
    """Holds fields until their samples are decided; what a clock brings after it has jumped back waits apart."""

    def __init__(self, jump_ns: int, tally: Tally) -> None:
        self._clock, self._tally = Clock(jump_ns), tally
        self._arrived: list[Fields] = []
        self._fields = NO_FIELDS
        self._jumps: deque[tuple[int, int]] = deque()  # still ahead: the last stamp before and the first one after
        self._passed = 0  # jumps that are not ahead any more
        self._deaf_until_ns = NOT_HEARD_NS
        self.ever = False  # has there been a field

    def put(self, stamp_ns: Stamps, field_tesla: Floats, field_sd_tesla: Floats) -> None:
        """Take m measurements; one that is no number counts as none."""
        self.ever |= len(stamp_ns) > 0
        stamp_ns = within_reckoning(stamp_ns)
        there = (field_sd_tesla >= 0.0) & np.isfinite(field_tesla).all(axis=1)
        values, deviations = np.where(there[:, None], field_tesla, 0.0), np.where(there, field_sd_tesla, -1.0)
        for start, stop, jumped in self._clock.runs(stamp_ns):
            if jumped:
                self._note_jump(int(stamp_ns[start]))
            at = slice(start, stop)
            ascends, newest_ns = self._clock.mark(stamp_ns[at])
            clock, yes = np.full(stop - start, self._passed + len(self._jumps)), np.ones(stop - start, np.bool_)
            new = Fields(stamp_ns[at], newest_ns, clock, values[at], deviations[at], ascends, yes, ~yes)
            self._arrived.append(new)
        if len(self._arrived) > HEAP:
            self._arrived = [joined(self._arrived)]

    def read(self, decided_ns: int) -> None:
        """Look at what has come; what lies at or before the latest sample that was given out is late."""
        if self._arrived:
            new = joined(self._arrived) if len(self._arrived) > 1 else self._arrived[0]
            new.late[:] = (new.clock == self._passed) & (new.stamp_ns <= decided_ns)
            self._fields, self._arrived = part(joined([self._fields, new]), -MOST), []

    def follow(self, sample_ns: int) -> int:
        """Go on to the clock whose fields are nearest to a sample; return up to which one that is sure to last."""
        while self._jumps and self._distance_ns(sample_ns, 1) < self._distance_ns(sample_ns, 0):
            self._jumps.popleft()
            self._passed += 1
            self._deaf_until_ns = NOT_HEARD_NS
            self._fields = part(self._fields, int(self._fields.clock.searchsorted(self._passed)))
        before_ns, after_ns = self._jumps[0] if self._jumps else (LATEST_NS, sample_ns)
        return after_ns - 1 if after_ns > sample_ns else before_ns

    def heard_ns(self, newest_ns: int) -> int:
        """Return up to where no field is missing any more, when the inertial stream has got to a stamp."""
        if newest_ns >= self._deaf_until_ns:
            self._deaf_until_ns = NOT_HEARD_NS
        if self._jumps:
            return LATEST_NS
        known = self._clock.newest_ns is not None and self._deaf_until_ns == NOT_HEARD_NS
        return int(self._clock.newest_ns or 0) if known else NOT_HEARD_NS

    def _distance_ns(self, stamp_ns: int, ahead: int) -> int:
        """Return how far a stamp is from the fields of the present clock, or of the one that is ahead."""
        clocks, clock = self._fields.clock, self._passed + ahead
        there = self._fields.newest_ns[clocks.searchsorted(clock) : clocks.searchsorted(clock, "right")]
        right = int(there.searchsorted(stamp_ns))
        near_ns = [*there[max(right - 1, 0) : right + 1].tolist(), self._jumps[0][ahead]]
        return min(abs(field_ns - stamp_ns) for field_ns in near_ns)

    def between(self, first_ns: int, last_ns: int) -> Fields:
        """Return the fields of the present clock from a stamp to another, and some others; their flags can be set."""
        stop = int(self._fields.clock.searchsorted(self._passed, "right"))
        within = self._fields.newest_ns[:stop]
        return part(self._fields, int(within.searchsorted(first_ns)), int(within.searchsorted(last_ns, "right")))

    def forget(self, before_ns: int) -> None:
        """Let go of what is earlier, once it is much, and count what nobody has taken."""
        stop = int(self._fields.clock.searchsorted(self._passed, "right"))
        gone = int(self._fields.newest_ns[:stop].searchsorted(before_ns))
        if gone < min(HEAP, length(self._fields) // 2 + 1):
            return
        old, self._fields = part(self._fields, 0, gone), part(self._fields, gone)
        late = "magnetic field that came after its inertial sample had been given out was left out"
        self._tally.add_flagged("field_late", Level.WARN, late, old.free & old.late, old.stamp_ns)
        spare = "magnetic field that is nearest to no inertial sample was left out"
        self._tally.add_flagged("field_unpaired", Level.OK, spare, old.free & ~old.late, old.stamp_ns)

    def expect_jump(self, newest_ns: int) -> None:
        """Note that the clock of the inertial stream has jumped back from a stamp: that of the field will do so too.

        Until it does, what it says is no sign that all fields of a sample have come.
        """
        self._deaf_until_ns = NOT_HEARD_NS if self._jumps else newest_ns

    def _note_jump(self, stamp_ns: int) -> None:
        self._jumps.append((self._clock.last_ns or 0, stamp_ns))
        text = "the clock of the magnetic field jumped back, pairing goes on with the new one"
        self._tally.add("field_clock", Level.WARN, text, stamp_ns)


def with_fields(imu: ImuBlock, fields: Fields, choice: Stamps) -> ImuBlock:
    """Take the chosen fields, (n,), -1: none, and return the samples with them; others keep what they have."""
    got = (choice >= 0).nonzero()[0]
    fields.free[choice[got]] = False
    got = got[fields.field_sd_tesla[choice[got]] >= 0.0]
    if not len(got):
        return imu
    field_tesla, field_sd_tesla = imu.field_tesla.copy(), imu.field_sd_tesla.copy()
    field_tesla[got], field_sd_tesla[got] = fields.field_tesla[choice[got]], fields.field_sd_tesla[choice[got]]
    return imu._replace(field_tesla=field_tesla, field_sd_tesla=field_sd_tesla)

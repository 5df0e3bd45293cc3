"""Gives inertial samples their magnetic field, whichever of the two streams is ahead."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS
from pdr_core.field_pairing.clock import Clock, UsualInterval, steps_ns, within_reckoning
from pdr_core.field_pairing.fields import NOT_HEARD_NS, Fields, FieldStore, with_fields
from pdr_core.field_pairing.nearest import NEVER_NS, equal, nearest
from pdr_core.notices import Tally
from pdr_core.records import NO_SAMPLES, Flags, Floats, ImuBlock, Level, Notice, Stamps, joined, length, part

JUMP_WAITS = 2  # a step back by more than so many waiting times is a jump of the clock
SILENCE_NS = NANOSECONDS
SILENT = "no magnetic field belonged to the samples for more than 1 s; check the magnetometer and its stamps"


class Waiting(NamedTuple):
    """n samples that wait for their field."""

    imu: ImuBlock
    stamp_ns: Stamps  # (n,) within what can be reckoned with
    ascends: Flags  # (n,) later than all before
    reach_ns: Stamps  # (n,) a field that is further away is not theirs


NOBODY = Waiting(NO_SAMPLES, np.zeros(0, np.int64), np.zeros(0, np.bool_), np.zeros(0, np.int64))


class FieldPairing:
    """Gives each inertial sample the field that was measured nearest to it in time, by stamps alone.

    A field belongs to the sample nearest to it, if that is within half the usual interval of the samples, and a sample
    takes the nearest of its fields. It is given out as soon as no later field can be nearer, or the stream has gone on
    by `wait_ns`. So the order in which the two streams arrive changes nothing, as long as neither lags by more. Samples
    that repeat a stamp or go back take only a field of just their stamp. A stamp that goes back by more than twice
    `wait_ns` is a clock that has jumped: what waits is given out. No sample is lost or changes places.
    """

    def __init__(self, wait_ns: int) -> None:
        self._wait_ns = wait_ns
        self._tally = Tally()
        self._clock, self._interval = Clock(JUMP_WAITS * wait_ns), UsualInterval()
        self._store = FieldStore(JUMP_WAITS * wait_ns, self._tally)
        self._waiting = NOBODY
        self._decided_ns = NOT_HEARD_NS  # latest sample that was given out
        self._listened_ns: int | None = None
        self._seen_ns = NOT_HEARD_NS
        self._silent = False

    def take_field(self, stamp_ns: Stamps, field_tesla: Floats, field_sd_tesla: Floats) -> None:
        """Take m measurements, (m,), (m, 3), (m,); a deviation of -1 says that there is none at this stamp."""
        self._store.put(stamp_ns, field_tesla, field_sd_tesla)

    def run(self, imu: ImuBlock) -> ImuBlock:
        """Return the samples, of these and those that waited, whose field is decided now, in order."""
        stamp_ns, given = within_reckoning(imu.stamp_ns), []
        before_ns = self._clock.newest_ns
        for start, stop, jumped in self._clock.runs(stamp_ns):
            if jumped and before_ns is not None:
                given.append(self._given_out(before_ns, everything=True))
                self._begin_anew(before_ns)
            for first, last in self._by_clock(stamp_ns, start, stop):
                self._take(part(imu, first, last), stamp_ns[first:last])
                before_ns = int(self._clock.newest_ns or 0)
                given.append(self._given_out(before_ns))
        return joined(given) if len(given) > 1 else [*given, NO_SAMPLES][0]

    def finish(self) -> ImuBlock:
        """Return those that still wait."""
        return self._given_out(int(self._clock.newest_ns or 0), everything=True)

    @property
    def notices(self) -> list[Notice]:
        """Fields that nobody took, clocks that jumped, and silence of a magnetometer."""
        return self._tally.notices

    def _by_clock(self, stamp_ns: Stamps, start: int, stop: int) -> Iterator[tuple[int, int]]:
        """Cut the samples start:stop where the fields go on by another clock, as near as it need be."""
        self._store.read(self._decided_ns)
        size = 1
        while start < stop:
            beyond = stamp_ns[start:stop] > self._store.follow(int(stamp_ns[start]))
            count = int(beyond.argmax()) if beyond.any() else stop - start
            size = 2 * size if count == 0 else 1
            yield start, min(start + max(count, size), stop)
            start = min(start + max(count, size), stop)

    def _begin_anew(self, newest_ns: int) -> None:
        self._interval.begin_anew()
        self._decided_ns = self._seen_ns = NOT_HEARD_NS
        self._listened_ns = None
        self._store.expect_jump(newest_ns)

    def _take(self, imu: ImuBlock, stamp_ns: Stamps) -> None:
        ascends, _ = self._clock.mark(stamp_ns)
        reach_ns = np.zeros(len(stamp_ns), np.int64)
        reach_ns[ascends] = self._interval.learn(stamp_ns[ascends]) // 2
        new = Waiting(imu, stamp_ns, ascends, reach_ns)
        self._waiting = joined([self._waiting, new]) if length(self._waiting) else new

    def _given_out(self, newest_ns: int, everything: bool = False) -> ImuBlock:
        """Return the samples that are decided, or all that wait."""
        waiting = self._waiting
        if not length(waiting):
            return NO_SAMPLES
        self._store.read(self._decided_ns)
        heard_ns = self._store.heard_ns(newest_ns)
        reach_ns = max(JUMP_WAITS * self._wait_ns, int(waiting.reach_ns.max()))
        fields = self._store.between(int(waiting.stamp_ns.min()) - reach_ns, int(waiting.stamp_ns.max()) + reach_ns)
        choice, certain = self._matched(fields, newest_ns, heard_ns)
        count = len(certain) if everything or certain.all() else int(certain.argmin())
        self._waiting = part(waiting, count)
        ascending_ns = waiting.stamp_ns[:count][waiting.ascends[:count]]
        given = with_fields(part(waiting.imu, 0, count), fields, choice[:count])
        self._listen(waiting.stamp_ns[:count], choice[:count] >= 0)
        if len(ascending_ns):
            self._decided_ns = int(ascending_ns[-1])
        if not everything:
            self._store.forget(self._decided_ns - self._wait_ns)
        return given

    def _matched(self, fields: Fields, newest_ns: int, heard_ns: int) -> tuple[Stamps, Flags]:
        """Return which field each sample that waits takes, (n,), -1: none, and whether that is certain, (n,)."""
        waiting = self._waiting
        choice = np.full(length(waiting), -1)
        certain = newest_ns - waiting.stamp_ns >= self._wait_ns
        own = waiting.ascends.nonzero()[0]
        if len(own):
            free = (fields.ascends & fields.free).nonzero()[0]
            stamp_ns = waiting.stamp_ns[own]
            since_ns = NEVER_NS if self._decided_ns == NOT_HEARD_NS else int(stamp_ns[0]) - self._decided_ns
            found = nearest(stamp_ns, waiting.reach_ns[own], since_ns, fields.stamp_ns[free])
            takes = found.field >= 0
            choice[own[takes]] = free[found.field[takes]]
            certain[own] |= (heard_ns - stamp_ns >= found.settled_ns) & ~found.may_lose
        if len(own) < len(choice):
            others = np.flatnonzero(~waiting.ascends)
            left = fields.free.copy()
            left[choice[choice >= 0]] = False
            free = np.flatnonzero(left)
            index = equal(waiting.stamp_ns[others], fields.stamp_ns[free])
            choice[others[index >= 0]] = free[index[index >= 0]]
            certain[others] |= index >= 0
        return choice, certain

    def _listen(self, stamp_ns: Stamps, paired: Flags) -> None:
        """Count how often samples that are given out, (n,), were without a field for more than a second."""
        if not len(stamp_ns) or not self._store.ever:
            return
        begins = steps_ns(stamp_ns, self._listened_ns) > GAP_NS
        begins[0] |= self._listened_ns is None
        marks_ns = np.where(paired | begins, stamp_ns, NOT_HEARD_NS)
        seen_ns = np.maximum.accumulate(np.maximum(marks_ns, self._seen_ns))
        silent = stamp_ns - seen_ns > SILENCE_NS
        falls = silent & ~np.concatenate([[self._silent], silent[:-1]])
        self._tally.add_flagged("field_silent", Level.WARN, SILENT, falls, stamp_ns)
        self._listened_ns, self._seen_ns, self._silent = int(stamp_ns[-1]), int(seen_ns[-1]), bool(silent[-1])

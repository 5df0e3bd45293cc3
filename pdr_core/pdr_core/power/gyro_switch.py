"""A recording as a driver would have given it, had its gyro been switched and its rate lowered.

What the gyro measured while it is off, or has not settled yet, is taken away: its deviation of -1 says that it was not
measured. Where a command leaves it to the sensor, `maths/motion_switch.py` switches. A lower rate is filtered as a
sensor does it (`maths/thinning.py`); where that needs later samples, the switch looks ahead, as a sensor that gives out
its samples a moment later. The live driver obeys in the same way.
"""

from bisect import insort
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.maths.motion_switch import MotionRule, MotionSwitch
from pdr_core.maths.thinning import LONGEST, REACH, kept_of, thinned
from pdr_core.records import NO_SAMPLES, Flags, ImuBlock, Stamps, joined, length, part
from pdr_core.records_power import DriverAnswer, ModeCommand, Outcome, PowerState

PIECE_NS = 50_000_000  # as far as the samples go between two chances to give a command
PIECE_SAMPLES = 256  # at most, where stamps stand still
RATE_SAMPLES = 20  # that tell the sensor's own rate


class Change(NamedTuple):
    """What is to hold from the first sample at or after a stamp on."""

    at_ns: int
    gyro: bool
    on_motion: bool
    keep_every: int


class GyroSwitch:
    """Samples in; pieces of them out, each as the commands that were given before it have it."""

    def __init__(self, rule: MotionRule) -> None:
        self._rule = rule
        self._motion: MotionSwitch | None = None  # the sensor switches by itself
        self._samples = NO_SAMPLES
        self._next = 0  # index of the next sample to give out
        self._changes: list[Change] = []  # still to come, the earliest first
        self._gyro, self._keep_every, self._settled_ns = True, 1, NO_STAMP
        self._last_ns = NO_STAMP  # the last sample given out
        self.states: list[PowerState] = []  # what holds from which sample on

    def run(self, raw: ImuBlock) -> Iterator[ImuBlock]:
        """Yield what can be given out of these samples and those before; commands may be given in between."""
        self._samples = joined([self._samples, raw])
        while (stop := self._piece_end()) is not None and stop + self._reach <= length(self._samples):
            yield self._given_out(stop)

    def finish(self) -> Iterator[ImuBlock]:
        """Yield the rest: there will be no later samples."""
        while self._next < length(self._samples):
            stop = self._piece_end()
            yield self._given_out(length(self._samples) if stop is None else stop)

    def ask(self, command: ModeCommand) -> DriverAnswer:
        """Obey from the first sample on that has not been given out, or from the stamp that the command names."""
        stamps = self._samples.stamp_ns
        next_ns = int(stamps[min(self._next, len(stamps) - 1)]) if len(stamps) else command.not_before_ns
        at_ns = max(command.not_before_ns, next_ns)
        keep_every = kept_of(self.full_rate_hz, command.rate_hz) if self.full_rate_hz else 1
        insort(
            self._changes, Change(at_ns, command.gyro, command.on_motion, keep_every), key=lambda change: change.at_ns
        )
        return DriverAnswer(
            command.number, command.stamp_ns, Outcome.ACKNOWLEDGED, at_ns, self._rule.settle_ns / NANOSECONDS
        )

    @property
    def full_rate_hz(self) -> float:
        """The sensor's own rate, by the last samples given out; 0: not known yet."""
        steps_ns = np.diff(self._samples.stamp_ns[max(0, self._next - RATE_SAMPLES) : self._next])
        steps_ns = steps_ns[steps_ns > 0]
        return NANOSECONDS / float(np.median(steps_ns)) if len(steps_ns) else 0.0

    @property
    def _reach(self) -> int:
        """How many later samples the lower rate may need: of the one that holds, and of those still to come."""
        most = max([self._keep_every, *(change.keep_every for change in self._changes)])
        return min(REACH * most, LONGEST) if most > 1 else 0

    def _piece_end(self) -> int | None:
        """Return the index behind the piece, or None where it is not complete; a jump of the clock ends one too."""
        stamps = self._samples.stamp_ns[self._next : self._next + PIECE_SAMPLES]
        away = np.abs(stamps - stamps[:1]) >= PIECE_NS
        if away.any():
            return self._next + int(away.argmax())
        return self._next + PIECE_SAMPLES if len(stamps) == PIECE_SAMPLES else None

    def _given_out(self, stop: int) -> ImuBlock:
        """Return the samples up to an index as the driver gives them."""
        pieces = [NO_SAMPLES]
        while self._next < stop:
            self._change()
            run = part(self._samples, self._next, stop).stamp_ns
            end = self._next + until(run, self._changes[0].at_ns) if self._changes else stop
            pieces.append(self._as_given(thinned(self._samples, self._next, end, self._keep_every)))
            self._next += length(pieces[-1]) * self._keep_every
            self._last_ns = int(pieces[-1].stamp_ns[-1])
        self._forget()
        return joined(pieces)

    def _change(self) -> None:
        """Let what is due at the next sample hold."""
        now_ns = int(self._samples.stamp_ns[self._next])
        if now_ns < self._last_ns:
            self._turn_back(now_ns)
        while self._changes and self._changes[0].at_ns <= now_ns:
            change = self._changes.pop(0)
            self._keep_every = change.keep_every
            self._motion = MotionSwitch(self._rule, self._gyro) if change.on_motion else None
            if not change.on_motion:
                self._power(now_ns, change.gyro, change.at_ns)

    def _power(self, now_ns: int, gyro: bool, at_ns: int) -> None:
        """Let the gyro be on or off from a sample on, by what was asked for from a stamp on."""
        if gyro and not self._gyro:
            self._settled_ns = at_ns + self._rule.settle_ns
        self._gyro = gyro
        self.states.append(PowerState(now_ns, gyro, self.full_rate_hz / self._keep_every))

    def _turn_back(self, now_ns: int) -> None:
        """Follow a clock that has jumped back: what was to come with the old one comes now."""
        self._changes = [change._replace(at_ns=now_ns) for change in self._changes]
        self._settled_ns = min(self._settled_ns, now_ns + self._rule.settle_ns)

    def _as_given(self, samples: ImuBlock) -> ImuBlock:
        """Return samples without the rates that the gyro does not measure."""
        measured = self._measured(samples)
        return samples._replace(
            gyro_radps=np.where(measured[:, None], samples.gyro_radps, 0.0),
            gyro_sd_radps=np.where(measured, samples.gyro_sd_radps, -1.0),
        )

    def _measured(self, samples: ImuBlock) -> Flags:
        """Return where the gyro measures, (n,)."""
        if self._motion is None:
            return (samples.stamp_ns >= self._settled_ns) & self._gyro
        was_on = self._gyro
        powered, measured = self._motion.run(samples.stamp_ns, samples.accel_mps2)
        for i in np.flatnonzero(np.diff(powered.astype(np.int8), prepend=was_on)).tolist():
            self._power(int(samples.stamp_ns[i]), bool(powered[i]), int(samples.stamp_ns[i]))
        return measured & (samples.stamp_ns >= self._settled_ns)

    def _forget(self) -> None:
        """Keep of the samples given out as many as the filter of a lower rate may need."""
        first = min(max(0, self._next - LONGEST), length(self._samples))
        self._samples, self._next = part(self._samples, first), self._next - first


def until(stamp_ns: Stamps, at_ns: int) -> int:
    """Return how many samples come before the first at or after a stamp, at least one."""
    reached = stamp_ns >= at_ns
    return max(1, int(reached.argmax())) if reached.any() else len(stamp_ns)

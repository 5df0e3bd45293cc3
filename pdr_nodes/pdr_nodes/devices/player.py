"""Plays a source sample by sample, with a gyro that can be switched off and a rate that can be lowered."""

from bisect import insort
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP, nanoseconds
from pdr_core.maths.motion_switch import MotionRule, MotionSwitch
from pdr_core.recording.decimation import ThinnedStream, kept_of
from pdr_core.records import ImuBlock
from pdr_nodes.devices.source import Source


class Change(NamedTuple):
    """What is to happen with the first sample at or after a stamp."""

    at_ns: int
    happen: Callable[[int], None]


class Player:
    """Looks ahead of what has been taken, so that a change of power or rate holds from a known stamp on."""

    def __init__(self, source: Source, settling_s: float) -> None:
        self._samples = ThinnedStream(source.pieces)
        self.settling_s = settling_s
        self._changes: list[Change] = []  # still to come, the earliest first
        self._keep_every = 1
        self._gyro_on = True
        self._motion: MotionSwitch | None = None  # the sensor switches by itself
        self._settled_ns = NO_STAMP
        self.taken = 0
        self.interval_s = 0.0

    @property
    def next(self) -> ImuBlock | None:
        """The sample that `take` returns next, as it was measured; None at the end."""
        return self._samples.next

    @property
    def next_ns(self) -> int:
        """Stamp of the sample that `take` returns next."""
        if self.next is None:
            raise EOFError("the device has no more samples")
        return int(self.next.stamp_ns[0])

    def take(self) -> ImuBlock:
        """Return the next sample as the device gives it now."""
        now_ns, self.taken = self.next_ns, self.taken + 1
        while self._changes and self._changes[0].at_ns <= now_ns:
            change = self._changes.pop(0)
            change.happen(change.at_ns)
        sample = self._samples.take(self._keep_every)
        if self.next is not None and self.interval_s == 0.0:
            self.interval_s = (self.next_ns - now_ns) / NANOSECONDS
        return sample if self._measures(sample) else without_gyro(sample)

    def set_gyro_power(self, on: bool, not_before_ns: int = NO_STAMP) -> int:
        """Switch the gyro; after being switched on it needs its settling time. Return the stamp [ns] it holds from."""

        def switch(at_ns: int) -> None:
            self._motion = None
            if on and not self._gyro_on:
                self._settled_ns = at_ns + nanoseconds(self.settling_s)
            self._gyro_on = on

        return self._plan(switch, not_before_ns)

    def set_gyro_on_motion(self, rule: MotionRule, not_before_ns: int = NO_STAMP) -> int:
        """Let the sensor switch its gyro by itself. Return the stamp [ns] it holds from."""

        def leave(_at_ns: int) -> None:
            self._motion = MotionSwitch(rule, self._gyro_on)

        return self._plan(leave, not_before_ns)

    def set_sample_rate(self, rate_hz: float, not_before_ns: int = NO_STAMP) -> tuple[float, int]:
        """Keep every k-th sample, filtered, as near to the rate as possible.

        Return the rate that this gives [Hz] and the stamp that it holds from [ns].
        """
        native_hz = 1.0 / self.interval_s
        keep_every = kept_of(native_hz, rate_hz)

        def thin(_at_ns: int) -> None:
            self._keep_every = keep_every

        return native_hz / keep_every, self._plan(thin, not_before_ns)

    def _measures(self, sample: ImuBlock) -> bool:
        """Return whether the gyro's rate can be trusted now."""
        settled = int(sample.stamp_ns[0]) >= self._settled_ns
        if self._motion is None:
            return self._gyro_on and settled
        (powered,), (measured,) = self._motion.run(sample.stamp_ns, sample.accel_mps2)
        if powered and not self._gyro_on:
            self._settled_ns = int(sample.stamp_ns[0]) + self._motion.rule.settle_ns
            settled = False
        self._gyro_on = bool(powered)
        return bool(measured) and settled

    def _plan(self, happen: Callable[[int], None], not_before_ns: int) -> int:
        """Let something happen from a stamp on, but not in the past; what was asked for first happens first."""
        at_ns = max(not_before_ns, self.next_ns)
        insort(self._changes, Change(at_ns, happen), key=lambda change: change.at_ns)
        return at_ns


def without_gyro(sample: ImuBlock) -> ImuBlock:
    """Return the sample of a sensor whose gyro is off."""
    return sample._replace(gyro_radps=np.zeros((1, 3)), gyro_sd_radps=np.full(1, -1.0))

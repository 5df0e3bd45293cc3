"""Decides what navigates, and when the gyro is on (Zhou section 4, Tables 1-3). The table itself is in `rules.py`.

Everything is decided by stamps: the same records and answers give the same commands. Nothing waits for a driver: a
command holds for the manager when the driver acknowledges it, and until then records go on being judged.
"""

import math
from dataclasses import replace

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.notices import Tally
from pdr_core.params import PowerParams
from pdr_core.power.duty import gyro_wanted
from pdr_core.power.memory import Memory
from pdr_core.power.rules import GYRO_ON, next_mode
from pdr_core.records import Level, Notice
from pdr_core.records_power import DriverAnswer, Mode, ModeCommand, Outcome, Walk

UNANSWERED = DriverAnswer(0, 0, Outcome.TIMED_OUT, NO_STAMP, 0.0)


class ModeManager:
    """Records of a walk and answers of the driver in, commands out."""

    def __init__(self, params: PowerParams) -> None:
        self._params = params
        self._memory = Memory(params)
        self._tally = Tally()
        self._open: ModeCommand | None = None  # not answered yet
        self._last: ModeCommand | None = None
        self.mode = Mode.INITIALISING

    def run(self, walk: Walk) -> list[ModeCommand]:
        """Return the commands that follow from a record: none, or one."""
        self._follow_clock(walk.stamp_ns)
        self._memory.see(walk)
        if self._last is None:
            return self._enter(Mode.INITIALISING, "the walk begins")
        if self._unanswered(walk.stamp_ns):
            return self._fail(UNANSWERED)
        if self.mode is Mode.FAULT:
            return self._retry(walk.stamp_ns)
        if rule := next_mode(self.mode, self._memory):
            return self._enter(rule.then, rule.why, rule.failed)
        return self._partial_duty()

    def answer(self, answer: DriverAnswer) -> list[ModeCommand]:
        """Take the driver's answer to the newest command; those to older ones come too late to matter.

        A driver that dies after it has acknowledged says so by another answer to the same command.
        """
        command, acknowledged = self._last, answer.outcome is Outcome.ACKNOWLEDGED
        if command is None or answer.number != command.number or (acknowledged and not self._open):
            return []
        self._open = None
        if not acknowledged:
            return self._fail(answer)
        self._acknowledge(command, answer)
        if self.mode is not Mode.FAULT:
            return []
        self._memory.forget_calibration()  # so the next try to switch lies L0 away
        return self._enter(Mode.INITIALISING, "the driver answers again")

    @property
    def command(self) -> ModeCommand | None:
        """The newest command; None before the first record."""
        return self._last

    @property
    def notices(self) -> list[Notice]:
        """What was wrong with the driver so far."""
        return self._tally.notices

    def _enter(self, mode: Mode, why: str, failed: bool = False) -> list[ModeCommand]:
        if failed:
            self._memory.forget_calibration()
        calibration_is_over = self.mode is Mode.INITIALISING and mode in (Mode.DEAD_RECKONING, Mode.SWINGS)
        self.mode = mode
        self._memory.begin(mode in GYRO_ON, keeps_examination=not calibration_is_over)
        return self._ask(mode in GYRO_ON or mode is Mode.SWINGS, why, failed)

    def _partial_duty(self) -> list[ModeCommand]:
        """Switch the gyro within dead reckoning."""
        wanted = gyro_wanted(self._params, self._memory.strides)
        if self.mode is not Mode.DEAD_RECKONING or self._last is None or wanted is self._last.gyro:
            return []
        return self._ask(wanted, "its strides of partial duty" if wanted else "the other strides of partial duty")

    def _ask(self, gyro: bool, why: str, failed: bool = False) -> list[ModeCommand]:
        stamp_ns = self._memory.walk.stamp_ns if self._memory.walk else NO_STAMP
        number = self._last.number + 1 if self._last else 1
        rate_hz = self._params.filter_rate_hz if gyro else self._params.reckoning_rate_hz
        on_motion = self.mode is Mode.SWINGS
        self._last = self._open = ModeCommand(
            number, stamp_ns, self.mode, why, gyro, rate_hz, stamp_ns, on_motion, failed
        )
        return [self._last]

    def _acknowledge(self, command: ModeCommand, answer: DriverAnswer) -> None:
        """Note from when on the rates can be trusted; a gyro that was on already has settled."""
        if not command.gyro:
            self._memory.settled_ns = NO_STAMP
        elif self._memory.settled_ns == NO_STAMP:
            said_s = answer.settling_s if math.isfinite(answer.settling_s) else 0.0
            self._memory.settled_ns = answer.effective_ns + nanoseconds(max(said_s, self._params.settle_s))

    def _fail(self, answer: DriverAnswer) -> list[ModeCommand]:
        """Want the gyro on, whatever went wrong, and let the filter navigate."""
        text = fault_text(self._last, answer)
        stamp_ns = self._memory.walk.stamp_ns if self._memory.walk else answer.stamp_ns
        self._tally.add(f"driver_{answer.outcome.name.lower()}", Level.WARN, text, stamp_ns)
        if self.mode is Mode.FAULT:
            self._open = None
            return []
        return self._enter(Mode.FAULT, text)

    def _retry(self, stamp_ns: int) -> list[ModeCommand]:
        since_ns = stamp_ns - self._last.stamp_ns if self._last else 0
        if self._open or since_ns < nanoseconds(self._params.retry_s):
            return []
        return self._ask(True, "the driver is asked again to keep the gyro on")

    def _unanswered(self, stamp_ns: int) -> bool:
        waited_ns = stamp_ns - self._open.stamp_ns if self._open else 0
        return waited_ns >= nanoseconds(self._params.answer_timeout_s)

    def _follow_clock(self, stamp_ns: int) -> None:
        """Where the clock has jumped back, count what is waited for from now on."""
        before = self._memory.walk
        if before and stamp_ns < before.stamp_ns and self._last:
            self._last = replace(self._last, stamp_ns=stamp_ns)
            self._open = self._last if self._open else None


def fault_text(command: ModeCommand | None, answer: DriverAnswer) -> str:
    """Return what is wrong with a driver that was asked to switch the gyro, and what is done about it."""
    why = answer.text or answer.outcome.value
    if answer.outcome is Outcome.DIED:
        return f"the driver has failed: {why}; the gyro is wanted on"
    if command and command.on_motion:
        return f"the sensor cannot switch the gyro by itself: {why}; it stays on"
    return f"the gyro cannot be switched {'on' if command is None or command.gyro else 'off'}: {why}; it stays on"

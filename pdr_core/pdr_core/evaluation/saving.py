"""What a run with a switched gyro has cost, and what its modes were, for a machine and for a person."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from itertools import zip_longest
from typing import Any, NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.words import share
from pdr_core.records import Floats
from pdr_core.records_power import DriverAnswer, Energy, Mode, ModeCommand, Outcome

SHARES = ("gyro_on_share", "sensor_mah_per_h", "node_mah_per_h", "sensor_saved_share", "node_saved_share")
STILL_LEARNING = " It was needed to the end: it sleeps once power.calibration_m of a gait are measured, outside turns."


class CallRow(NamedTuple):
    """A command and what the driver has said to it, in words."""

    when: str
    what: str
    answer: str  # empty: no driver was asked, or it has not answered
    why: str


@dataclass(frozen=True)
class Saving:
    """The charge of a run, its timeline of modes, and what a driver has answered to each, where one was asked."""

    energy: Energy
    commands: Sequence[ModeCommand]
    answers: Sequence[DriverAnswer | None] = ()  # one of each command, or none at all

    @property
    def times_s(self) -> Floats:
        """When the commands were given, (n,), since the first; where the clock jumps back, no time passes."""
        stamps = np.array([command.stamp_ns for command in self.commands], np.int64)
        return np.concatenate([np.zeros(min(len(stamps), 1)), np.diff(stamps).clip(0).cumsum() / NANOSECONDS])

    def to_mapping(self) -> dict[str, Any]:
        """Return it in plain types; the timeline counts from its first command, in seconds."""
        shares = {name: getattr(self.energy, name) for name in SHARES}
        modes = [
            {"t_s": t, "mode": c.mode.name.lower(), "gyro": c.gyro, "why": c.why}
            | ({"answer": answer.outcome.name.lower()} if answer else {})
            for t, c, answer in self._told()
        ]
        return asdict(self.energy) | shares | {"modes": modes}

    def in_words(self) -> str:
        """Return one sentence, and another where the gyro never slept."""
        e = self.energy
        on, saved = share(100.0 * e.gyro_on_share), share(100.0 * e.sensor_saved_share)
        drew = f"the sensor ({e.part}) drew {e.sensor_mah_per_h:.2f} mAh an hour"
        told = f"The gyro was on for {on} of the time; {drew}, {saved} less than with the gyro always on."
        return told + (STILL_LEARNING if {command.mode for command in self.commands} == {Mode.INITIALISING} else "")

    def rows(self) -> list[CallRow]:
        """Return the timeline as a table."""
        return [
            CallRow(
                f"{t:.2f} s",
                f"gyro {wish_words(command)}, {command.rate_hz:g} Hz",
                answer_words(command, answer) if answer else "",
                f"{command.mode.name.lower().replace('_', ' ')}: {command.why}",
            )
            for t, command, answer in self._told()
        ]

    def _told(self) -> Iterator[tuple[float, ModeCommand, DriverAnswer | None]]:
        times_s = self.times_s.tolist()
        return ((t, *told) for t, told in zip(times_s, zip_longest(self.commands, self.answers), strict=True))


def wish_words(command: ModeCommand) -> str:
    """Return what the gyro is to do."""
    return "on in swings" if command.on_motion else "on" if command.gyro else "off"


def answer_words(command: ModeCommand, answer: DriverAnswer) -> str:
    """Return what a driver has said to a command."""
    if answer.outcome is Outcome.ACKNOWLEDGED:
        return f"acknowledged, holds {(answer.effective_ns - command.stamp_ns) / NANOSECONDS:.2f} s later"
    return f"{answer.outcome.value}: {answer.text}" if answer.text else answer.outcome.value

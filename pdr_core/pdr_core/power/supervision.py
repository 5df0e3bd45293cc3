"""The mode manager with its eyes on a driver that is somewhere else: what the node `mode_manager` hosts.

Beside the answers of the driver it looks at the samples: a driver that was started again has another gyro than the one
that was switched. Whoever calls the driver says when it is lost altogether.
"""

from pdr_core.conventions import NO_STAMP
from pdr_core.notices import Tally
from pdr_core.params import PowerParams
from pdr_core.power.driver_watch import DriverWatch
from pdr_core.power.mode_manager import ModeManager
from pdr_core.power.timeline import PowerTimeline
from pdr_core.records import Level, Notice
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import (
    DriverAnswer,
    Mode,
    ModeCommand,
    ModeReport,
    Outcome,
    PowerState,
    RateAnswer,
    Sensed,
    Walk,
)

WALKS = (Behaviour.WALKING, Behaviour.RUNNING)


class Supervision:
    """Records of a walk and words of the driver in, commands and a report out."""

    def __init__(self, params: PowerParams) -> None:
        self._part = params.part
        self._manager = ModeManager(params)
        self._watch = DriverWatch(params)
        self._timeline = PowerTimeline()
        self._tally = Tally()
        self._answer: DriverAnswer | None = None  # to the newest command
        self._power = PowerState(NO_STAMP, True, 0.0)  # by the driver's last words
        self._by_itself = False  # the sensor switches the gyro
        self._magnetometer = False
        self._news: list[ModeReport] = []

    def walk(self, walk: Walk, sensed: Sensed) -> list[ModeCommand]:
        """Take what is seen of the walk."""
        since_ns, self._timeline.last_ns = self._timeline.last_ns, walk.stamp_ns
        self._magnetometer = self._magnetometer or sensed.magnetometer
        if not self._timeline.states and sensed.rate_hz > 0.0:
            self._holds(PowerState(walk.stamp_ns, self._power.gyro_on, self._power.rate_hz or sensed.rate_hz))
        if self._by_itself and sensed.gyro is not self._power.gyro_on and since_ns >= self._power.stamp_ns:
            self._holds(PowerState(since_ns, sensed.gyro, self._power.rate_hz))  # so it has switched
        commands = self._new(self._manager.run(walk))
        fault = self._watch.run(walk.stamp_ns, sensed, walk.behaviour in WALKS)
        return [*commands, *self.lost(fault)] if fault else commands

    def answered(self, command: ModeCommand, answer: DriverAnswer) -> list[ModeCommand]:
        """Take what the driver says to a command, late or in time."""
        if answer.outcome is Outcome.ACKNOWLEDGED:
            self._holds(PowerState(answer.effective_ns, command.gyro, self._power.rate_hz))
            self._by_itself = command.on_motion
        if self._manager.command == command:
            self._answer = answer
            self._watch.answered(command, answer)
            self._news.append(self.report)
        return self._new(self._manager.answer(answer))

    def rated(self, answer: RateAnswer) -> None:
        """Take what the driver says of its rate: without a lower one only charge is lost."""
        if answer.rate_hz > 0.0:
            self._holds(PowerState(answer.effective_ns, self._power.gyro_on, answer.rate_hz))
        else:
            self._tally.add(
                "rate_not_set", Level.WARN, f"the sensor keeps its rate: {answer.text}", self._timeline.last_ns
            )

    def lost(self, why: str) -> list[ModeCommand]:
        """Note that the driver is gone, or another one: whatever it has said does not hold any more."""
        command = self._manager.command
        if command is None:
            return []
        self._holds(PowerState(self._timeline.last_ns, True, self._full_rate_hz))
        self._by_itself = False
        died = DriverAnswer(command.number, self._timeline.last_ns, Outcome.DIED, NO_STAMP, 0.0, why)
        return self.answered(command, died)

    @property
    def mode(self) -> Mode:
        """What navigates."""
        return self._manager.mode

    @property
    def report(self) -> ModeReport:
        """What there is to say now."""
        energy = self._timeline.energy(self._part, self._magnetometer, self._full_rate_hz)
        power = self._power
        stamp_ns = self._timeline.last_ns
        return ModeReport(stamp_ns, self._manager.command, self._answer, power.gyro_on, power.rate_hz, energy)

    def news(self) -> list[ModeReport]:
        """Return what there was to say since the last time: of every command, and of every answer to one."""
        news, self._news = self._news, []
        return news

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return [*self._manager.notices, *self._tally.notices]

    @property
    def _full_rate_hz(self) -> float:
        return max((state.rate_hz for state in self._timeline.states), default=0.0)

    def _holds(self, power: PowerState) -> None:
        self._power = power
        if power.rate_hz > 0.0:
            self._timeline.states.append(power)

    def _new(self, commands: list[ModeCommand]) -> list[ModeCommand]:
        """Note commands, which the manager gives one at a time."""
        if commands:
            self._answer = None
            self._news.append(self.report)
        return commands

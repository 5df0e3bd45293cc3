"""One foot that saves energy: the filter while the gyro is on, dead reckoning by strides while it is off.

A recording runs as if its gyro had been switched: a stand-in for the driver takes the rates away and lowers the rate of
the samples, as the mode manager commands (Zhou section 4).
"""

from collections.abc import Iterator

from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.pipeline.adaptive_foot import AdaptiveFoot
from pdr_core.pipeline.foot_inertial import FootOutput, together
from pdr_core.power import GyroSwitch, ModeManager, PowerTimeline
from pdr_core.power.motion_rule import motion_rule
from pdr_core.records import ImuBlock, Notice, StanceBlock, joined, length
from pdr_core.records_power import Energy, ModeCommand, PowerState
from pdr_core.stance import StanceDetection

WANTED = {"gyro_off"}  # notices of the intake that say what the manager wants


class FootAdaptive:
    """Raw samples in; estimates, steps, the timeline of modes and the charge out."""

    def __init__(self, params: Params) -> None:
        self._driver = GyroSwitch(motion_rule(params.power))
        self._intake = Ingestion(params.intake)
        self._stance = StanceDetection(params.stance, params.place, params.detectors)
        self._foot = AdaptiveFoot(params)
        self._manager = ModeManager(params.power)
        self._part = params.power.part
        self._first_ns: int | None = None
        self._last_ns = 0
        self._magnetometer = False
        self.commands: list[ModeCommand] = []  # the timeline of modes

    def run(self, raw: ImuBlock) -> FootOutput:
        """Take the next samples, any number of them."""
        return together(output for piece in self._driver.run(raw) for output in self._given(piece))

    def finish(self) -> FootOutput:
        """Give out what still waits for later samples: there will be none."""
        outputs = [output for piece in self._driver.finish() for output in self._given(piece)]
        judged = joined([self._stance.run(self._intake.finish()), self._stance.finish()])
        return together([*outputs, *self._judged(judged), self._foot.finish()])

    def _given(self, given: ImuBlock) -> Iterator[FootOutput]:
        """Take samples as the driver gives them."""
        if length(given):
            self._first_ns = int(given.stamp_ns[0]) if self._first_ns is None else self._first_ns
            self._last_ns = int(given.stamp_ns[-1])
        return self._judged(self._stance.run(self._intake.run(given)))

    def _judged(self, judged: StanceBlock) -> Iterator[FootOutput]:
        """Let the manager decide after every piece, before the next ones."""
        for moved in self._foot.run(judged):
            self._magnetometer = self._magnetometer or moved.sensed.magnetometer
            self._obey(self._manager.run(moved.walk))
            yield moved.output

    def _obey(self, commands: list[ModeCommand]) -> None:
        while commands:
            self.commands += commands
            if any(command.model_failed for command in commands):
                self._foot.forget_length()
            commands = [more for command in commands for more in self._manager.answer(self._driver.ask(command))]

    @property
    def powered(self) -> list[PowerState]:
        """When the gyro was powered, and at which rate: what holds from which stamp on."""
        return self._driver.states

    @property
    def energy(self) -> Energy:
        """What the walk has cost so far."""
        begin = [] if self._first_ns is None else [PowerState(self._first_ns, True, self._driver.full_rate_hz)]
        timeline = PowerTimeline([*begin, *self._driver.states], self._last_ns)
        return timeline.energy(self._part, self._magnetometer, self._driver.full_rate_hz)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        intake = [notice for notice in self._intake.notices if notice.kind not in WANTED]
        return intake + self._foot.notices + self._manager.notices

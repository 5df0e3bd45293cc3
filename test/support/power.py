"""A walk as the mode manager sees it, and drivers that obey, refuse, sleep or die."""

from dataclasses import dataclass, field

from pdr_core.conventions import NANOSECONDS
from pdr_core.params import PowerParams
from pdr_core.power import ModeManager
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import DriverAnswer, MeasuredStride, ModeCommand, Outcome, Walk

STRIDE_M, STRIDE_S, MODEL_SD_M = 1.25, 1.0, 0.04
TICK_NS = NANOSECONDS // 10
GAITS = (Behaviour.WALKING, Behaviour.RUNNING)


def obedient(command):
    """Obey at once; the gyro needs 50 ms."""
    return answered(command, Outcome.ACKNOWLEDGED)


def answered(command, outcome):
    return DriverAnswer(command.number, command.stamp_ns, outcome, command.not_before_ns, 0.05)


@dataclass
class Rehearsal:
    """Walks a person past a manager, a record every 0.1 s; strides are measured while the gyro has settled."""

    params: PowerParams = field(default_factory=PowerParams)
    driver: object = obedient  # command -> answer, or None
    now_ns: int = 0
    gyro: bool = True
    settled_ns: int = 0
    model_m: float = STRIDE_M
    model_ready: bool = True
    rest_tested: bool = True
    commands: list[ModeCommand] = field(default_factory=list)

    def __post_init__(self):
        self.manager = ModeManager(self.params)
        self._stride_ns = self.now_ns

    @property
    def mode(self):
        return self.manager.mode

    def go(self, seconds, behaviour=Behaviour.WALKING, turning=False, stride_m=STRIDE_M):
        """Let time pass; return the commands of that time."""
        first = len(self.commands)
        for _ in range(round(seconds * NANOSECONDS / TICK_NS)):
            self.now_ns += TICK_NS
            self._tell(behaviour, turning, stride_m)
        return self.commands[first:]

    def _tell(self, behaviour, turning, stride_m):
        strides, reckoned = (), 0
        if behaviour in GAITS and self.now_ns - self._stride_ns >= STRIDE_S * NANOSECONDS:
            whole = self.gyro and self._stride_ns >= self.settled_ns
            if whole:
                strides = (MeasuredStride(self._stride_ns, self.now_ns, stride_m, self.model_m, MODEL_SD_M),)
            reckoned, self._stride_ns = int(not whole), self.now_ns
        elif behaviour not in GAITS:
            self._stride_ns = self.now_ns
        walk = Walk(self.now_ns, behaviour, self.rest_tested, self.model_ready, turning, strides, reckoned)
        self.obey(self.manager.run(walk))

    def obey(self, commands):
        while commands:
            self.commands += commands
            answers = [answer for answer in map(self.driver, commands) if answer]
            commands = [again for answer in answers for again in self.take(answer)]

    def take(self, answer):
        """Let the driver's answer come."""
        command = next(c for c in self.commands if c.number == answer.number)
        if answer.outcome is Outcome.ACKNOWLEDGED:
            if command.gyro and not self.gyro:
                self.settled_ns = answer.effective_ns + round(answer.settling_s * NANOSECONDS)
            self.gyro = command.gyro
        return self.manager.answer(answer)


def modes(commands):
    """Return the modes that commands lead through, in words."""
    return [c.mode.name for c in commands]

"""Asks the driver to switch its gyro and to change its rate, and waits for nothing."""

import time
from collections import deque
from collections.abc import Callable
from functools import partial

from rclpy.client import Client
from rclpy.task import Future

from pdr_core.conventions import NO_STAMP
from pdr_core.records_power import DriverAnswer, ModeCommand, Outcome, RateAnswer
from pdr_msgs.srv import SetGyroPower, SetSampleRate
from pdr_nodes.convert_mode import gyro_answer, rate_answer
from pdr_nodes.managed import ManagedNode
from pdr_nodes.patience import Patience

LOOK_S = 0.05
AGAIN_S = 0.25  # a driver that has not found us within 0.1 s loses its answer in its middleware (rmw_fastrtps 8.4)
TIMES = 3  # that a driver is called which has never answered; one that is only slow must not be swamped
UNANSWERED = 16  # calls that a late answer is still taken of
NOBODY = "nobody offers {}: does the driver run, and is it in this namespace?"


class DriverCalls:
    """The newest command is called once the service is there; what is not answered in time by the wall clock is lost.

    An answer that comes later is given on all the same: whoever asked knows by its number what to make of it.
    """

    def __init__(
        self,
        node: ManagedNode,
        timeout_s: float,
        answered: Callable[[ModeCommand, DriverAnswer], None],
        rated: Callable[[RateAnswer], None],
    ) -> None:
        self._gyro = node.client(SetGyroPower, "set_gyro_power")
        self._rate = node.client(SetSampleRate, "set_sample_rate")
        self._answered, self._rated = answered, rated
        self._open: ModeCommand | None = None  # not answered yet
        self._last: ModeCommand | None = None  # asked for
        self._times = 0  # that it has been called
        self._called_s = 0.0
        self._answers = False  # the driver has answered, since it is there
        self._heard = 0  # the newest command that was answered
        self._calls: deque[tuple[Client, Future]] = deque()
        self._patience = Patience(timeout_s, lambda: self._open and self._open.number, self._give_up)
        node.every(LOOK_S, self._look)
        node.part(self)

    def begin(self) -> None:
        """Ask from now on."""
        self._open, self._last, self._answers = None, None, False

    def end(self) -> None:
        """Leave no gyro off, or to its sensor, that nobody looks after."""
        if self._last and (self._last.on_motion or not self._last.gyro) and self.offered:
            self._gyro.call_async(SetGyroPower.Request(powered=True))
        self._open, self._last = None, None

    @property
    def offered(self) -> bool:
        """Somebody offers to switch the gyro."""
        return self._gyro.service_is_ready()

    @property
    def nobody(self) -> str:
        """What to say where nobody does."""
        return NOBODY.format(self._gyro.srv_name)

    def ask(self, command: ModeCommand) -> None:
        """Ask for what a command wants; what was asked for before does not matter any more."""
        self._open, self._last, self._times = command, command, 0
        self._look()

    def _look(self) -> None:
        self._answers = self._answers and self.offered
        if self._open and self._is_due and self.offered:
            self._times, self._called_s = self._times + 1, time.monotonic()
            self._call(self._open)
        self._patience.look()

    @property
    def _is_due(self) -> bool:
        """A first call is, and another one where the answer to it may have been lost."""
        overdue = not self._answers and time.monotonic() - self._called_s > AGAIN_S
        return self._times == 0 or (overdue and self._times < TIMES)

    def _call(self, command: ModeCommand) -> None:
        """Ask for power and rate from the next sample on; nobody can ask for the past."""
        power = SetGyroPower.Request(powered=command.gyro, on_motion=command.on_motion)
        self._send(self._gyro, power, partial(self._gyro_answered, command))
        if self._rate.service_is_ready():
            self._send(self._rate, SetSampleRate.Request(rate=command.rate_hz), partial(self._rate_answered, command))
        else:
            self._rated(RateAnswer(0.0, NO_STAMP, NOBODY.format(self._rate.srv_name)))

    def _send(self, client: Client, request: object, done: Callable[[Future], None]) -> None:
        future = client.call_async(request)
        future.add_done_callback(done)
        self._calls.append((client, future))
        if len(self._calls) > UNANSWERED:
            of, oldest = self._calls.popleft()
            of.remove_pending_request(oldest)

    def _gyro_answered(self, command: ModeCommand, future: Future) -> None:
        self._answers = True
        if command.number <= self._heard:  # called twice, or nothing to go by any more
            return
        self._heard = command.number
        if self._open == command:
            self._open = None
        self._answered(command, gyro_answer(command, future.result()))

    def _rate_answered(self, command: ModeCommand, future: Future) -> None:
        self._rated(rate_answer(command, future.result()))

    def _give_up(self) -> None:
        """Nobody has answered."""
        command, self._open = self._open, None
        if command:
            text = "" if self._times else self.nobody
            none = DriverAnswer(command.number, command.stamp_ns, Outcome.TIMED_OUT, NO_STAMP, 0.0, text)
            self._answered(command, none)

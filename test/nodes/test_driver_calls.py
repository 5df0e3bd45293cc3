"""Calls of a driver whose middleware loses an answer: what is missing is asked for again, and counts once."""

from types import SimpleNamespace

import pytest
from rclpy.task import Future

from pdr_core.records_power import Outcome
from pdr_msgs.srv import SetGyroPower, SetSampleRate
from pdr_nodes import driver_calls, patience
from pdr_nodes.driver_calls import AGAIN_S, TIMES, DriverCalls
from support.switched import command

TIMEOUT_S = 10.0


class Service:
    """A client whose answers are in the hands of the test."""

    srv_name = "asked"

    def __init__(self):
        self.there, self.futures = True, []

    def service_is_ready(self):
        return self.there

    def call_async(self, _request):
        self.futures.append(Future())
        return self.futures[-1]

    def remove_pending_request(self, future):
        """Nothing to forget."""


class Rig:
    """The calls with both services, by a clock of its own."""

    def __init__(self, monkeypatch):
        self.now_s = 0.0
        for module in (driver_calls, patience):
            monkeypatch.setattr(module, "time", SimpleNamespace(monotonic=lambda: self.now_s))
        self.services = {SetGyroPower: Service(), SetSampleRate: Service()}
        self.gyro, self.rate = self.services.values()
        self.answered, self.rated = [], []
        node = SimpleNamespace(
            client=lambda kind, _name: self.services[kind], every=self._every, part=lambda _part: None
        )
        self.calls = DriverCalls(node, TIMEOUT_S, lambda *what: self.answered.append(what), self.rated.append)

    def _every(self, _period_s, look):
        self._look = look

    def go(self, seconds):
        """Let time pass."""
        for _ in range(round(seconds / driver_calls.LOOK_S)):
            self.now_s += driver_calls.LOOK_S
            self._look()

    def answer(self, number):
        """Answer a call of the gyro."""
        self.gyro.futures[number].set_result(SetGyroPower.Response(success=True))

    @property
    def outcomes(self):
        return [(asked.number, answer.outcome) for asked, answer in self.answered]


@pytest.fixture
def rig(monkeypatch):
    return Rig(monkeypatch)


def test_a_driver_whose_first_answer_is_lost_is_called_again_and_its_answer_counts_once(rig):
    rig.calls.ask(command(1, True))
    assert len(rig.gyro.futures) == 1
    rig.go(AGAIN_S + 0.1)
    assert len(rig.gyro.futures) == len(rig.rate.futures) == 2
    rig.answer(1)
    rig.answer(0)  # it was only late
    assert rig.outcomes == [(1, Outcome.ACKNOWLEDGED)]
    rig.go(2 * TIMEOUT_S)
    assert (len(rig.gyro.futures), len(rig.outcomes)) == (2, 1)


def test_a_driver_that_is_only_slow_is_not_swamped(rig):
    rig.calls.ask(command(1, True))
    rig.go(2 * TIMEOUT_S)
    assert len(rig.gyro.futures) == TIMES
    rig.answer(0)
    rig.calls.ask(command(2, True))
    rig.go(2 * TIMEOUT_S)
    assert len(rig.gyro.futures) == TIMES + 1
    assert rig.outcomes == [(1, Outcome.TIMED_OUT), (1, Outcome.ACKNOWLEDGED), (2, Outcome.TIMED_OUT)]


def test_a_driver_that_is_back_has_to_find_us_once_more(rig):
    rig.calls.ask(command(1, True))
    rig.answer(0)
    rig.gyro.there = False
    rig.calls.ask(command(2, False))
    rig.go(AGAIN_S)
    rig.gyro.there = True
    rig.go(2.5 * AGAIN_S)
    assert len(rig.gyro.futures) == 1 + TIMES

"""A driver that is absent, slow, refuses or dies: the gyro stays or goes on, the walk goes on, the fault has a name."""

from collections import deque

import pytest

from pdr_core.conventions import NANOSECONDS
from pdr_core.params import Params
from pdr_core.records_power import DriverAnswer, Mode, Outcome
from support.power import Rehearsal, answered, modes, obedient

POWER = Params().power


def silent(_command):
    """Answer nothing."""


def kinds(person):
    return {notice.kind for notice in person.manager.notices}


def test_an_absent_driver_leaves_the_gyro_on_and_is_asked_again():
    person = Rehearsal(POWER, driver=silent)
    commands = person.go(60.0)
    assert person.mode is Mode.FAULT
    assert all(command.gyro for command in commands)
    assert kinds(person) == {"driver_timed_out"}
    assert 60.0 / (POWER.retry_s + POWER.answer_timeout_s) < len(commands) < 60.0 / POWER.retry_s + 3


def test_a_driver_that_refuses_to_switch_off_keeps_the_filter_navigating():
    def refusing(command):
        return answered(command, Outcome.ACKNOWLEDGED if command.gyro else Outcome.REFUSED)

    person = Rehearsal(POWER, driver=refusing)
    commands = person.go(45.0)
    assert modes(commands)[:4] == ["INITIALISING", "DEAD_RECKONING", "FAULT", "INITIALISING"]
    assert person.gyro
    assert kinds(person) == {"driver_refused"}
    assert "cannot be switched off" in person.manager.notices[0].text
    asked_off = [c for c in person.go(200.0) if not c.gyro]
    assert 1 <= len(asked_off) <= 200.0 / 40.0  # L0 lies between two tries


def test_a_driver_that_does_not_wake_the_gyro_is_asked_until_it_does():
    person = Rehearsal(POWER)
    person.go(45.0)
    person.driver = lambda command: answered(command, Outcome.REFUSED)
    commands = person.go(80.0)
    assert modes(commands)[:2] == ["EXAMINING", "FAULT"]
    assert all(c.gyro for c in commands)
    person.driver = obedient
    person.go(POWER.retry_s + 0.1)
    assert (person.mode, person.gyro) == (Mode.INITIALISING, True)


def test_a_slow_driver_blocks_nothing_and_its_late_answers_are_left_out():
    late = deque()
    person = Rehearsal(POWER, driver=lambda command: late.append(command))
    for _ in range(120):
        person.go(1.0)
        while late and person.now_ns - late[0].stamp_ns >= 5 * NANOSECONDS:
            person.obey(person.take(answered(late.popleft(), Outcome.ACKNOWLEDGED)))
    assert person.gyro
    assert person.mode in (Mode.FAULT, Mode.INITIALISING)
    assert kinds(person) == {"driver_timed_out"}


def test_a_driver_that_dies_after_it_has_acknowledged_is_a_fault_and_comes_back():
    person = Rehearsal(POWER)
    person.go(45.0)
    assert not person.gyro
    last = person.commands[-1]
    person.driver = silent
    person.obey(person.manager.answer(answered(last, Outcome.DIED)))
    assert person.mode is Mode.FAULT
    assert person.commands[-1].gyro
    person.go(20.0)
    person.driver = obedient
    person.go(POWER.retry_s + POWER.answer_timeout_s + 0.2)
    assert (person.mode, person.gyro) == (Mode.INITIALISING, True)
    person.go(45.0)
    assert person.mode is Mode.DEAD_RECKONING


def test_strides_count_only_once_the_driver_has_acknowledged_and_the_gyro_has_settled():
    person = Rehearsal(POWER)
    person.driver = lambda command: DriverAnswer(
        command.number, command.stamp_ns, Outcome.ACKNOWLEDGED, command.not_before_ns, 10.0 if command.gyro else 0.0
    )
    person.go(49.0)
    assert person.mode is Mode.INITIALISING
    person.go(6.0)
    assert person.mode is Mode.DEAD_RECKONING


@pytest.mark.parametrize("settling_s", [float("nan"), float("inf"), -1.0])
def test_a_settling_time_that_is_none_is_that_of_the_parameters(settling_s):
    person = Rehearsal(POWER)
    person.driver = lambda command: DriverAnswer(
        command.number, command.stamp_ns, Outcome.ACKNOWLEDGED, command.not_before_ns, settling_s
    )
    person.settled_ns = 0
    person.take = person.manager.answer
    person.go(45.0)
    assert person.mode is Mode.DEAD_RECKONING


def test_answers_to_nothing_do_nothing():
    person = Rehearsal(POWER)
    person.go(1.0)
    for outcome in Outcome:
        stray = DriverAnswer(77, person.now_ns, outcome, person.now_ns, 0.05)
        assert person.manager.answer(stray) == []
    assert person.manager.answer(answered(person.commands[-1], Outcome.ACKNOWLEDGED)) == []
    assert person.mode is Mode.INITIALISING
    assert person.manager.notices == []

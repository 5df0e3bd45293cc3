"""A driver is watched by its samples, and what it has said is counted."""

from dataclasses import replace

import pytest

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.params import Params, changed
from pdr_core.power import DriverWatch, PowerTimeline, Supervision
from pdr_core.power.driver_watch import ON_AGAIN, SLEEPS_ON, STARTED_AGAIN, STILL_OFF
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import DriverAnswer, MeasuredStride, Mode, Outcome, PowerState, RateAnswer, Sensed, Walk
from support.power import answered
from support.switched import command

POWER = changed(Params(), "power", calibration_m=10.0).power
WITH, WITHOUT = Sensed(True, False, 200.0), Sensed(False, False, 50.0)
TENTH_NS = NANOSECONDS // 10


def told(watch, seconds, sensed, begin_s=0.0, walks=True):
    """Return what the watch says while samples come."""
    stamps = [round((begin_s + 0.1 * i) * NANOSECONDS) for i in range(round(10 * seconds))]
    return [fault for fault in (watch.run(stamp_ns, sensed, walks) for stamp_ns in stamps) if fault]


@pytest.mark.parametrize(
    ("gyro", "sensed", "fault"), [(False, WITH, ON_AGAIN), (True, WITHOUT, STILL_OFF), (False, WITHOUT, None)]
)
def test_samples_that_contradict_the_driver_are_told_once(gyro, sensed, fault):
    watch = DriverWatch(POWER)
    watch.answered(command(1, gyro), answered(command(1, gyro), Outcome.ACKNOWLEDGED))
    assert told(watch, 60.0, sensed) == ([fault] if fault else [])


def test_a_gyro_has_time_to_obey_and_to_settle():
    watch = DriverWatch(POWER)
    watch.answered(command(1, False), answered(command(1, False), Outcome.ACKNOWLEDGED))
    assert told(watch, 0.9, WITH) == []
    watch.answered(command(2, True), answered(command(2, True), Outcome.ACKNOWLEDGED))
    assert told(watch, 3.0, WITHOUT, begin_s=1.0) == []


@pytest.mark.parametrize(("walks", "sensed", "fault"), [(True, WITHOUT, SLEEPS_ON), (False, WITHOUT, None)])
def test_a_gyro_that_its_sensor_switches_may_sleep_but_not_through_a_walk(walks, sensed, fault):
    watch, left = DriverWatch(POWER), command(1, True, on_motion=True)
    assert told(watch, 5.0, WITH) == []
    watch.answered(left, answered(left, Outcome.ACKNOWLEDGED))
    assert told(watch, 20.0, WITH, begin_s=5.0) == []
    assert told(watch, POWER.retry_s - 0.2, sensed, begin_s=25.0, walks=walks) == []
    assert told(watch, 60.0, sensed, begin_s=25.0 + POWER.retry_s, walks=walks) == ([fault] if fault else [])


def test_stamps_that_jump_back_are_another_driver():
    watch = DriverWatch(POWER)
    assert told(watch, 5.0, WITH, begin_s=100.0) == []
    assert told(watch, 5.0, WITH) == [STARTED_AGAIN]


def test_who_was_never_heard_contradicts_nothing():
    watch = DriverWatch(POWER)
    watch.answered(command(1, False), replace(answered(command(1, False), Outcome.TIMED_OUT), effective_ns=NO_STAMP))
    assert told(watch, 20.0, WITH) == []


class Walker:
    """Walks before a supervision; the driver's gyro is as it was asked, unless it was started again.

    Where its sensor is to switch it, the gyro sleeps in every second that is even.
    """

    def __init__(self, params=POWER):
        self.supervision, self.gyro, self.now_ns = Supervision(params), True, 0
        self.asked = []

    def go(self, seconds):
        for _ in range(round(10 * seconds)):
            self.now_ns += TENTH_NS
            if self.asked and self.asked[-1].on_motion:
                self.gyro = (self.now_ns - 1) // NANOSECONDS % 2 == 1
            strides = ()
            if self.now_ns % NANOSECONDS == 0 and self.gyro:
                strides = (MeasuredStride(self.now_ns - NANOSECONDS, self.now_ns, 1.25, 1.25, 0.04),)
            walk = Walk(self.now_ns, Behaviour.WALKING, True, True, False, strides, int(not self.gyro))
            self.obey(self.supervision.walk(walk, WITH if self.gyro else WITHOUT))

    def obey(self, commands):
        for asked in commands:
            self.asked.append(asked)
            self.gyro = asked.gyro
            self.supervision.rated(RateAnswer(200.0 if asked.gyro else 50.0, self.now_ns))
            answer = DriverAnswer(asked.number, self.now_ns, Outcome.ACKNOWLEDGED, self.now_ns, 0.05)
            self.obey(self.supervision.answered(asked, answer))


@pytest.fixture
def walker():
    walker = Walker()
    walker.go(20.0)
    assert not walker.gyro
    return walker


def test_the_report_counts_what_the_driver_has_acknowledged(walker):
    report = walker.supervision.report
    assert (report.gyro_powered, report.rate_hz) == (False, 50.0)
    assert report.command == walker.asked[-1]
    assert report.answer.outcome is Outcome.ACKNOWLEDGED
    assert report.energy.duration_s == pytest.approx(20.0, abs=0.2)
    off_s = (walker.now_ns - walker.asked[-1].stamp_ns) / NANOSECONDS
    assert report.energy.gyro_on_s == pytest.approx(report.energy.duration_s - off_s, abs=0.01)


def test_a_driver_that_was_started_again_is_asked_on_and_the_walk_goes_on(walker):
    walker.gyro = True
    walker.go(5.0)
    assert [c.mode for c in walker.asked[-2:]] == [Mode.FAULT, Mode.INITIALISING]
    assert ON_AGAIN in walker.asked[-2].why
    assert {notice.kind for notice in walker.supervision.notices} == {"driver_died"}
    walker.go(20.0)
    assert walker.supervision.mode is Mode.DEAD_RECKONING


def test_a_driver_that_is_lost_is_counted_with_its_gyro_on(walker):
    before = walker.supervision.report.energy
    walker.supervision.lost("it is gone")
    walker.supervision._timeline.last_ns += 10 * NANOSECONDS
    after = walker.supervision.report
    assert after.gyro_powered
    assert after.energy.gyro_on_s == pytest.approx(before.gyro_on_s + 10.0)
    assert after.command.gyro
    assert "it is gone" in after.command.why


def test_a_gyro_that_its_sensor_switches_is_counted_by_its_samples():
    walker = Walker(changed(Params(), "power", calibration_m=10.0, duty="swing").power)
    walker.go(20.0)
    before, begin_ns = walker.supervision.report.energy, walker.now_ns
    assert walker.supervision.mode is Mode.SWINGS
    walker.go(60.0)
    after = walker.supervision.report.energy
    assert walker.asked[-1].stamp_ns < begin_ns
    assert after.gyro_on_s - before.gyro_on_s == pytest.approx(30.0, abs=0.2)
    assert after.switch_ons - before.switch_ons == 30
    assert not walker.supervision.notices
    walker.supervision.lost("it is gone")
    assert walker.supervision.report.gyro_powered


def test_what_was_counted_before_is_what_is_counted_at_once():
    states = [PowerState(s * NANOSECONDS, s % 2 == 0, 100.0) for s in range(10)]
    asked, at_once = PowerTimeline(), PowerTimeline(states, 12 * NANOSECONDS)
    for state in states:
        asked.states.append(state)
        asked.last_ns = state.stamp_ns + 3 * NANOSECONDS
        asked.energy("mpu9250", state.stamp_ns < 5 * NANOSECONDS, 100.0)
    energy = asked.energy("mpu9250", False, 100.0)
    assert energy == at_once.energy("mpu9250", False, 100.0)
    assert (energy.duration_s, energy.gyro_on_s, energy.switch_ons) == (12.0, 5.0, 4)


def test_a_rate_that_is_not_taken_is_no_fault(walker):
    walker.supervision.rated(RateAnswer(0.0, NO_STAMP, "it has one rate only"))
    (notice,) = walker.supervision.notices
    assert notice.kind == "rate_not_set"
    assert walker.supervision.mode is Mode.DEAD_RECKONING


def test_nobody_is_lost_before_the_walk_begins():
    assert Supervision(POWER).lost("gone") == []

"""What the mode manager says, and what of it a recording gives back."""

import math
from types import SimpleNamespace

import pytest
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Imu

from pdr_bringup_scripts.live.listener import bag_writer
from pdr_bringup_scripts.live.switched_recording import decided, held
from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.records import Level, Notice
from pdr_core.records_power import Charge, DriverAnswer, Energy, Mode, ModeCommand, ModeReport, Outcome, RateAnswer
from pdr_msgs.srv import SetGyroPower, SetSampleRate
from pdr_nodes.convert import time_message
from pdr_nodes.convert_mode import gyro_answer, mode_message, mode_report, rate_answer

ENERGY = Energy("mpu9250", 100.0, 25.0, 3, 1e-4, Charge(0.04, 0.06), Charge(0.1, 0.12))
S = NANOSECONDS


def command(number, second, mode=Mode.DEAD_RECKONING, gyro=False):
    return ModeCommand(number, second * S, mode, "so be it", gyro, 50.0, second * S)


def answer(number, second, outcome=Outcome.ACKNOWLEDGED):
    effective_ns = second * S + 7 if outcome is Outcome.ACKNOWLEDGED else NO_STAMP
    return DriverAnswer(number, second * S, outcome, effective_ns, 0.05, "" if effective_ns > 0 else "why not")


@pytest.mark.parametrize("outcome", Outcome)
def test_a_report_goes_through_its_message_and_back(outcome):
    report = ModeReport(9 * S, command(4, 9), answer(4, 9, outcome), True, 200.0, ENERGY)
    assert mode_report(mode_message(report)) == report


@pytest.mark.parametrize(("mode", "failed"), [(Mode.SWINGS, False), (Mode.INITIALISING, True)])
def test_what_is_left_to_the_sensor_and_what_has_failed_goes_through(mode, failed):
    asked = ModeCommand(4, 9 * S, mode, "so be it", True, 50.0, 9 * S, mode is Mode.SWINGS, failed)
    report = ModeReport(9 * S, asked, None, True, 200.0, ENERGY)
    assert mode_report(mode_message(report)) == report


def test_before_the_first_command_the_gyro_is_wanted_on():
    message = mode_message(ModeReport(0, None, None, True, 0.0, ENERGY))
    assert (message.gyro_requested, message.command, message.answer) == (True, 0, message.ANSWER_PENDING)
    assert mode_report(message).command is None


@pytest.mark.parametrize("settling_s", [math.nan, math.inf])
def test_a_driver_that_tells_no_stamp_and_no_number_is_understood(settling_s):
    said = gyro_answer(command(2, 5), SetGyroPower.Response(success=True, settling_time=settling_s))
    assert said == DriverAnswer(2, 5 * S, Outcome.ACKNOWLEDGED, 5 * S, 0.0, "")


@pytest.mark.parametrize("rate_hz", [0.0, -1.0, math.nan, math.inf])
def test_a_rate_that_is_none_is_a_refusal(rate_hz):
    response = SetSampleRate.Response(success=True, rate=rate_hz)
    assert rate_answer(command(2, 5), response).rate_hz == 0.0
    assert rate_answer(command(2, 5), SetSampleRate.Response(success=True, rate=50.0)) == RateAnswer(
        50.0, 5 * S, "the driver says 50 Hz"
    )


def read_back(folder, reports, last_sample_s):
    """Return what a recording gives back of reports, which came at these seconds of the wall clock."""
    with bag_writer(folder / "bag") as bag:
        bag.write("/imu/data_raw", "sensor_msgs/msg/Imu", last_sample_s * S, serialize_message(Imu()))
        for came_s, report in reports:
            cdr = serialize_message(mode_message(report))
            bag.write("/mode", "pdr_msgs/msg/NavigationMode", came_s * S, cdr)
    return decided(folder / "bag", "")


def reports_of(*told):
    return [(came, ModeReport(came * S, c, a, False, 50.0, ENERGY)) for came, c, a in told]


def test_that_the_driver_is_gone_after_its_last_sample_is_no_part_of_the_walk(tmp_path):
    walk = [(1, command(1, 1), None), (2, command(1, 1), answer(1, 1)), (30, command(1, 1), answer(1, 1))]
    gone = [(33, command(1, 1), answer(1, 30, Outcome.DIED)), (33, command(2, 30, Mode.FAULT, gyro=True), None)]
    back = read_back(tmp_path, reports_of(*walk, *gone), 30)
    assert [(c.number, a.outcome) for c, a in zip(back.saving.commands, back.saving.answers, strict=True)] == [
        (1, Outcome.ACKNOWLEDGED)
    ]
    assert not back.concerns(Notice(Level.WARN, "driver_died", "", 1, 33 * S))
    assert back.concerns(Notice(Level.WARN, "driver_timed_out", "", 1, 20 * S))


def test_a_driver_that_is_gone_on_the_way_is_part_of_it(tmp_path):
    walk = [(1, command(1, 1), answer(1, 1, Outcome.DIED)), (2, command(2, 2, Mode.FAULT, gyro=True), None)]
    back = read_back(tmp_path, reports_of(*walk), 30)
    assert [c.mode for c in back.saving.commands] == [Mode.DEAD_RECKONING, Mode.FAULT]
    assert back.concerns(Notice(Level.WARN, "driver_died", "", 1, 33 * S))


def paired(verdicts, estimates):
    """Return the stamps that are paired, in seconds."""
    of = [SimpleNamespace(imu=SimpleNamespace(header=SimpleNamespace(stamp=time_message(s * S)))) for s in verdicts]
    to = [SimpleNamespace(header=SimpleNamespace(stamp=time_message(s * S))) for s in estimates]
    return [(v.imu.header.stamp.sec, e.header.stamp.sec) for v, e in held(iter(of), iter(to))]


def test_an_estimate_gets_the_verdict_that_held_at_its_stamp():
    assert paired([1, 3, 5, 7], [1, 2, 4, 7, 8]) == [(1, 1), (1, 2), (3, 4), (7, 7), (7, 8)]


def test_where_the_clock_jumps_back_verdicts_and_estimates_jump_together():
    assert paired([1, 3, 9, 12, 2, 4], [1, 4, 2, 5]) == [(1, 1), (3, 4), (2, 2), (4, 5)]

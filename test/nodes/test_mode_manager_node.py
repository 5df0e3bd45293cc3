"""The mode manager's node before drivers that obey, refuse, sleep, die, come back or are not there."""

import pytest

from pdr_msgs.msg import NavigationMode as Says
from support.manager_rig import BEGIN_NS, Rig, fake_driver

PATIENCE_S = 20.0


@pytest.fixture
def rig(request):
    with Rig(f"modes_{request.node.name.split('[')[0][5:40]}") as rig:
        yield rig


@pytest.fixture
def patient(request):
    """One that gives a driver time: the walk goes five times as fast as real, however busy the machine is."""
    with Rig(f"modes_{request.node.name.split('[')[0][5:40]}", PATIENCE_S) as rig:
        yield rig


def reckons(said):
    return said.mode == Says.MODE_GAIT_DR and said.answer == Says.ANSWER_ACKNOWLEDGED


def left_to_the_sensor(said):
    return said.mode == Says.MODE_SWINGS and said.answer == Says.ANSWER_ACKNOWLEDGED


def faulty(said):
    return said.mode == Says.MODE_FAULT


def asked(log):
    """What the driver was asked so far; on a busy machine its first answer may be lost, and it is asked once more."""
    words = [word for word in log.read_text().split() if word in ("on", "off", "swings")]
    again = next((i for i, word in enumerate(words) if word != "on"), len(words)) - 1
    return words[max(again, 0) :]


def test_an_obedient_driver_is_asked_on_first_and_off_after_l0(patient, tmp_path):
    rig = patient
    with fake_driver(rig, "obeys", tmp_path / "driver.log") as log:
        rig.until(lambda: rig.said and "no_driver" not in rig.kinds(-1), "that the manager knows of the driver")
        first = len(rig.said)  # a driver that has not started yet is named, and rightly
        rig.walk_until(lambda said: reckons(said) and said.sample_rate == 50.0, "dead reckoning")
        assert asked(log) == ["on", "off"]
        assert (rig.last.gyro_requested, rig.last.gyro_powered) == (False, False)
        rig.walk(10.0)
        assert rig.last.gyro_on < rig.last.duration
        assert 0.0 < rig.last.sensor_charge < rig.last.sensor_charge_always_on
        assert rig.kinds(first) <= {"no_input_walk"}


def test_without_a_driver_the_gyro_is_wanted_on_and_the_fault_is_named(rig):
    rig.walk_until(faulty, "a fault")
    assert rig.last.gyro_requested
    rig.walk(10.0)
    assert faulty(rig.last)
    rig.until(lambda: {"driver_timed_out", "no_driver"} <= rig.kinds(), "both notices")


def test_a_driver_that_refuses_keeps_its_gyro_on(patient, tmp_path):
    rig = patient
    with fake_driver(rig, "refuses", tmp_path / "driver.log") as log:
        fault = rig.walk_until(faulty, "a fault")
        assert fault.gyro_requested
        refused = next(said for said in rig.modes if said.answer == Says.ANSWER_REFUSED)
        assert (refused.gyro_requested, refused.answer_text) == (False, "not today")
        assert "cannot be switched off: not today" in fault.reason
        rig.walk_until(lambda said: said.mode == Says.MODE_INITIALISING and said.gyro_powered, "the way back")
        assert asked(log)[-1] == "on"
        rig.until(lambda: "driver_refused" in rig.kinds(), "a notice")


def test_a_driver_that_sleeps_holds_nobody_up(rig, tmp_path):
    with fake_driver(rig, "sleeps", tmp_path / "driver.log") as log:
        rig.walk_until(faulty, "a fault", 90.0)
        before = len(rig.modes)
        rig.walk(30.0)
        assert rig.last.gyro_requested
        assert len(rig.modes) - before >= 4  # it goes on speaking
        assert rig.longest_s < 1.0
        assert set(asked(log)) == {"on"}
        assert "driver_timed_out" in rig.kinds()


def test_a_driver_that_dies_in_mid_call_is_named_and_taken_back(patient, tmp_path):
    rig = patient
    with fake_driver(rig, "dies", tmp_path / "driver.log") as log:
        rig.walk_until(faulty, "a fault")
        assert asked(log) == ["on", "off"]
        assert rig.last.gyro_requested
    with fake_driver(rig, "obeys", tmp_path / "again.log") as log:
        rig.walk_until(lambda said: said.mode == Says.MODE_INITIALISING, "the way back")
        assert asked(log)[0] == "on"
        rig.walk_until(reckons, "dead reckoning once more")
    rig.until(lambda: "driver_timed_out" in rig.kinds(), "a notice")


def test_a_driver_that_was_started_again_is_known_by_its_gyro_and_by_its_clock(patient, tmp_path):
    rig = patient
    with fake_driver(rig, "obeys", tmp_path / "driver.log") as log:
        rig.walk_until(reckons, "dead reckoning")
        rig.now_ns = BEGIN_NS - 10**12
        before = len(rig.modes)
        rig.walk_until(lambda said: said.gyro_powered, "the gyro on")
        assert any("started again" in said.reason for said in rig.modes[before:])
        rig.walk_until(lambda _: len(asked(log)) > 2, "that the driver hears of it")
        assert asked(log)[2] == "on"
        rig.walk_until(reckons, "dead reckoning with the new clock")
        rig.until(lambda: "driver_died" in rig.kinds(), "a notice")


def test_where_nothing_is_heard_any_more_the_gyro_is_wanted_on_by_the_wall_clock(patient, tmp_path):
    rig = patient
    with fake_driver(rig, "obeys", tmp_path / "driver.log") as log:
        rig.walk_until(reckons, "dead reckoning")
        rig.until(lambda: asked(log)[-1] == "on", "the gyro on")
        rig.until(lambda: rig.last.gyro_powered, "its acknowledgement")
        rig.until(lambda: "no_input_walk" in rig.kinds(), "a notice")
    assert any("nothing was heard" in said.reason for said in rig.modes)


def test_a_manager_that_is_deactivated_leaves_no_gyro_off(patient, tmp_path):
    rig = patient
    with fake_driver(rig, "obeys", tmp_path / "driver.log") as log:
        rig.walk_until(reckons, "dead reckoning")
        rig.node.trigger_deactivate()
        rig.until(lambda: asked(log) == ["on", "off", "on"], "the gyro on")
        rig.node.trigger_activate()
        rig.gyro_on = True
        rig.walk_until(lambda said: said.mode == Says.MODE_INITIALISING, "calibration anew", 20.0)


def test_a_sensor_that_switches_its_gyro_is_left_to_it_until_the_manager_ends(tmp_path):
    with Rig("modes_swings", PATIENCE_S, "swing") as rig, fake_driver(rig, "obeys", tmp_path / "driver.log") as log:
        rig.walk_until(left_to_the_sensor, "swings")
        assert (asked(log), rig.last.gyro_requested) == (["on", "swings"], True)
        rig.node.trigger_deactivate()
        rig.until(lambda: asked(log) == ["on", "swings", "on"], "the gyro on")


def test_a_gyro_that_wakes_by_itself_is_counted_and_one_that_does_not_is_named(tmp_path):
    with Rig("modes_wakes", PATIENCE_S, "swing") as rig, fake_driver(rig, "obeys", tmp_path / "driver.log") as log:
        rig.walk_until(left_to_the_sensor, "swings")
        for gyro in [False, True] * 6:
            rig.gyro_on = gyro
            rig.walk(1.0)
        assert (rig.last.mode, asked(log)) == (Says.MODE_SWINGS, ["on", "swings"])
        assert 2.0 < rig.last.duration - rig.last.gyro_on < 7.0
        rig.gyro_on = False
        assert "sleeps on although the foot walks" in rig.walk_until(faulty, "a fault").reason
        rig.until(lambda: asked(log)[-1] == "on", "the gyro on")
        rig.until(lambda: "driver_died" in rig.kinds(), "a notice")


def test_a_sensor_that_cannot_switch_its_gyro_keeps_it_on(tmp_path):
    with Rig("modes_cannot", PATIENCE_S, "swing") as rig, fake_driver(rig, "cannot", tmp_path / "driver.log") as log:
        fault = rig.walk_until(faulty, "a fault")
        assert "the sensor cannot switch the gyro by itself: not today; it stays on" in fault.reason
        rig.walk_until(lambda said: said.mode == Says.MODE_INITIALISING and said.gyro_powered, "the way back")
        assert (asked(log)[:3], asked(log).count("swings")) == (["on", "swings", "on"], 1)
        rig.until(lambda: "driver_refused" in rig.kinds(), "a notice")


def test_a_call_that_is_open_when_the_samples_end_is_given_up_by_the_wall_clock():
    with Rig("modes_open", answer_timeout_s=0.5) as rig:
        rig.walk(0.2)
        rig.until(lambda: rig.modes and faulty(rig.last), "a fault without a sample")
        assert Says.ANSWER_PENDING in [said.answer for said in rig.modes]
        (given_up,) = [said for said in rig.modes if said.answer == Says.ANSWER_TIMED_OUT][:1]
    assert "nobody offers set_gyro_power" in given_up.answer_text

"""Zhou's Tables 1-3, row by row, and what is added to them."""

import pytest

from pdr_core.conventions import NANOSECONDS
from pdr_core.params import Params, changed
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import Mode
from support.power import MODEL_SD_M, STRIDE_M, Rehearsal, modes

STANDING, SWING, RUNNING = Behaviour.STANDING, Behaviour.SWING, Behaviour.RUNNING
CALIBRATION_S = 42.0  # 40 strides of 1.25 m are L0 = 50 m


def power(**values):
    return changed(Params(), "power", **values).power


def calibrated(**values):
    """Return a person whose model is calibrated: dead reckoning has begun."""
    person = Rehearsal(power(**values))
    person.go(CALIBRATION_S)
    assert person.mode is Mode.DEAD_RECKONING
    return person


def test_the_filter_walks_l0_with_the_gyro_on_before_dead_reckoning_takes_over():
    person = Rehearsal(power())
    commands = person.go(39.0)
    assert modes(commands) == ["INITIALISING"]
    assert commands[0].gyro
    (off,) = person.go(3.0)
    assert (off.mode, off.gyro) == (Mode.DEAD_RECKONING, False)
    assert off.rate_hz == power().reckoning_rate_hz < commands[0].rate_hz


def test_l0_is_a_distance_not_a_number_of_strides():
    person = Rehearsal(power())
    person.go(39.0, stride_m=0.6)
    assert person.mode is Mode.INITIALISING
    person.go(47.0, stride_m=0.6)
    assert person.mode is Mode.DEAD_RECKONING


def test_a_model_that_is_not_good_keeps_the_filter_however_far_it_walks():
    person = Rehearsal(power(), model_ready=False)
    person.go(200.0)
    assert (person.mode, person.gyro) == (Mode.INITIALISING, True)
    person.model_ready = True
    person.go(0.2)
    assert person.mode is Mode.DEAD_RECKONING


def test_every_t0_one_whole_step_is_examined():
    person = calibrated(examine_every_s=30.0)
    commands = person.go(65.0)
    assert modes(commands) == ["EXAMINING", "DEAD_RECKONING"] * 2
    on, off, on_again, _off_again = commands
    assert (on_again.stamp_ns - off.stamp_ns) / NANOSECONDS == pytest.approx(30.0, abs=1.0)
    whole_step_s = (off.stamp_ns - on.stamp_ns) / NANOSECONDS
    assert 1.0 < whole_step_s < 2.2  # the step in which it went on is not whole


@pytest.mark.parametrize(("sds", "follows"), [(2.9, Mode.DEAD_RECKONING), (3.1, Mode.INITIALISING)])
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_step_fits_within_three_deviations(sds, follows, sign):
    person = calibrated(examine_every_s=30.0)
    commands = person.go(32.0, stride_m=STRIDE_M + sign * sds * MODEL_SD_M)
    assert [commands[0].mode, commands[1].mode] == [Mode.EXAMINING, follows]


def test_a_model_that_fails_is_calibrated_over_l0_again():
    person = calibrated(examine_every_s=30.0)
    person.go(33.0, stride_m=STRIDE_M + 0.3)
    assert (person.mode, person.gyro) == (Mode.INITIALISING, True)
    person.go(37.0)
    assert person.mode is Mode.INITIALISING
    person.go(5.0)
    assert person.mode is Mode.DEAD_RECKONING


@pytest.mark.parametrize(("off_m", "examined"), [(0.0, False), (0.3, True)])
def test_strides_of_a_turn_put_an_examination_off_only_if_they_fit(off_m, examined):
    person, visited = calibrated(examine_every_s=30.0), []
    for _ in range(4):
        visited += modes(person.go(5.0, turning=True, stride_m=STRIDE_M + off_m))
        visited += modes(person.go(15.0, stride_m=STRIDE_M + off_m))
    assert ("EXAMINING" in visited) is ("INITIALISING" in visited) is examined


def test_a_new_behaviour_is_initialised_and_a_known_one_examined():
    person = calibrated()
    person.go(5.0)
    (on,) = person.go(0.1, RUNNING)
    assert (on.mode, on.gyro) == (Mode.INITIALISING, True)
    person.go(43.0, RUNNING)
    assert person.mode is Mode.DEAD_RECKONING
    commands = person.go(4.0)
    assert modes(commands) == ["EXAMINING", "DEAD_RECKONING"]


def test_a_foot_that_moves_without_walking_wakes_the_gyro_but_not_before_it_can_be_told_from_a_first_stride():
    person = calibrated(swing_s=2.0)
    assert person.go(1.9, SWING) == []
    (on,) = person.go(0.5, SWING)
    assert (on.mode, on.gyro) == (Mode.INITIALISING, True)
    (off,) = person.go(0.1)
    assert off.mode is Mode.DEAD_RECKONING


def test_the_gyro_is_off_while_the_person_stands():
    person = calibrated()
    (off,) = person.go(20.0, STANDING)
    assert (off.mode, off.gyro) == (Mode.STANDING, False)
    (again,) = person.go(0.1)
    assert (again.mode, again.gyro) == (Mode.DEAD_RECKONING, False)


def test_a_short_stand_is_none():
    person = calibrated(stand_s=2.0)
    assert person.go(1.5, STANDING) == []


def test_the_gyro_never_goes_off_before_the_first_rest_is_tested():
    person = Rehearsal(power(), rest_tested=False)
    person.manager._memory.walked_m[Behaviour.UNKNOWN] = 1e3  # as if calibrated
    assert modes(person.go(60.0, STANDING)) == ["INITIALISING"]
    person.rest_tested = True
    assert modes(person.go(1.0, STANDING)) == ["STANDING"]


def test_a_person_who_stands_before_the_model_is_good_keeps_the_gyro():
    person = Rehearsal(power())
    person.go(10.0)
    assert person.go(60.0, STANDING) == []
    assert person.gyro


def test_a_suspected_turn_wakes_the_gyro_until_strides_are_straight_again():
    person = calibrated(calm_strides=2)
    (on,) = person.go(5.0, turning=True)
    assert (on.mode, on.gyro) == (Mode.SUSPICION, True)
    assert person.go(1.4) == []
    (off,) = person.go(1.0)
    assert (off.mode, off.gyro) == (Mode.DEAD_RECKONING, False)


def test_dead_reckoning_does_not_begin_in_a_turn():
    person = Rehearsal(power())
    person.go(60.0, turning=True)
    assert person.mode is Mode.INITIALISING


def test_partial_duty_has_the_gyro_on_for_k_strides_of_n():
    person = calibrated(duty="strides", duty_on_strides=1, duty_of_strides=4, examine_every_s=1000.0)
    commands = person.go(80.0)
    assert {c.mode for c in commands} == {Mode.DEAD_RECKONING}
    on_s = sum(off.stamp_ns - on.stamp_ns for on, off in zip(commands[::2], commands[1::2], strict=False))
    assert all(c.gyro for c in commands[::2])
    assert on_s / NANOSECONDS / 80.0 == pytest.approx(0.25, abs=0.02)


def test_numbers_that_are_none_examine_nothing():
    person = calibrated(examine_every_s=30.0)
    person.go(30.0)
    person.go(5.0, stride_m=float("nan"))
    assert person.mode is Mode.EXAMINING
    person.model_m = float("nan")
    person.go(5.0)
    assert person.mode is Mode.EXAMINING
    person.model_m = STRIDE_M
    person.go(2.0)
    assert person.mode is Mode.DEAD_RECKONING


@pytest.mark.parametrize("jump_s", [-3600.0, -1.0, 5.0])
def test_a_clock_that_jumps_disturbs_no_interval_by_more_than_the_jump_forwards(jump_s):
    straight, jumping = calibrated(), calibrated()
    jumping.now_ns += round(jump_s * NANOSECONDS)
    jumping._stride_ns = jumping.now_ns
    jumping.settled_ns = min(jumping.settled_ns, jumping.now_ns)
    a, b = straight.go(90.0), jumping.go(90.0)
    assert modes(a) == modes(b)
    late_s = (b[0].stamp_ns - a[0].stamp_ns) / NANOSECONDS - jump_s
    assert late_s == pytest.approx(-max(0.0, jump_s), abs=0.11)


def test_the_same_records_give_the_same_commands():
    def told():
        person = calibrated(examine_every_s=20.0)
        person.go(50.0)
        person.go(10.0, STANDING)
        person.go(30.0, turning=True)
        return person.commands

    assert told() == told()


def test_the_table_is_complete_and_leads_nowhere_else():
    from pdr_core.power.rules import GYRO_ON, RULES

    assert set(RULES) == set(Mode)
    assert set(Mode) - GYRO_ON == {Mode.DEAD_RECKONING, Mode.STANDING, Mode.SWINGS}
    assert all(rule.then is not mode for mode, rules in RULES.items() for rule in rules)


def test_a_sensor_that_switches_by_itself_is_left_to_it_until_the_gait_is_new():
    person = Rehearsal(power(duty="swing"))
    *_, left = person.go(CALIBRATION_S)
    assert (left.mode, left.gyro, left.on_motion) == (Mode.SWINGS, True, True)
    assert left.rate_hz == power().filter_rate_hz
    assert person.go(5.0, turning=True) == person.go(10.0, STANDING) == person.go(100.0) == []
    (new,) = person.go(3.0, RUNNING)
    assert (new.mode, new.on_motion) == (Mode.INITIALISING, False)

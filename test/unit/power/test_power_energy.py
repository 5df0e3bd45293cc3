"""The charge of a walk, by hand."""

import pytest

from pdr_core.conventions import NANOSECONDS
from pdr_core.parameter import choices_of
from pdr_core.params import PowerParams
from pdr_core.power import EnergyModel
from pdr_core.power.parts import PARTS
from pdr_core.records_power import PowerState

HOUR = 3600


def energy(part, timeline, end_s, magnetometer=False, full_rate_hz=200.0):
    """Return what a sensor draws whose gyro and rate are as the timeline says: (second, gyro on, rate)."""
    model = EnergyModel(part, magnetometer, full_rate_hz)
    for second, gyro_on, rate_hz in timeline:
        model.run(PowerState(second * NANOSECONDS, gyro_on, rate_hz))
    model.pass_to(end_s * NANOSECONDS)
    return model.energy


def test_an_hour_always_on_is_the_current_of_the_data_sheet():
    drawn = energy("mpu9250", [(0, True, 200.0)], HOUR)
    assert drawn.drawn.sensor_mah == pytest.approx(3.2 + 0.45)
    assert drawn.sensor_mah_per_h == pytest.approx(3.65)
    assert drawn.sensor_saved_share == pytest.approx(0.0)
    assert drawn.node_saved_share == pytest.approx(0.0)
    assert (drawn.gyro_on_share, drawn.switch_ons, drawn.start_up_mah) == (1.0, 0, 0.0)


def test_an_hour_without_the_gyro_is_the_accelerometer_at_its_rate():
    fast = energy("mpu9250", [(0, False, 200.0)], HOUR)
    slow = energy("mpu9250", [(0, False, 25.0)], HOUR)
    assert fast.drawn.sensor_mah == pytest.approx(0.45)
    assert slow.drawn.sensor_mah == pytest.approx(0.0198)
    assert fast.sensor_saved_share == pytest.approx(1.0 - 0.45 / 3.65)
    assert slow.sensor_saved_share == pytest.approx(1.0 - 0.0198 / 3.65)
    assert slow.gyro_on_share == 0.0


def test_a_magnetometer_draws_its_current_all_the_time():
    drawn = energy("mpu9250", [(0, True, 200.0), (HOUR, False, 200.0)], 2 * HOUR, magnetometer=True)
    assert drawn.drawn.sensor_mah == pytest.approx(3.65 + 0.45 + 2 * 0.28)
    assert drawn.always_on.sensor_mah == pytest.approx(2 * (3.65 + 0.28))


def test_every_switch_on_costs_the_current_times_the_start_up_time_before_it_is_of_use():
    timeline = [(0, True, 200.0), (10, False, 50.0), (70, True, 200.0), (73, False, 50.0), (133, True, 200.0)]
    drawn = energy("l3gd20_lis3dh", timeline, 136)
    assert drawn.switch_ons == 2
    assert drawn.start_up_mah == pytest.approx(2 * 6.1 * 0.25 / 3600)
    on_s, off_s = 10 + 3 + 3, 60 + 60
    assert drawn.gyro_on_s == pytest.approx(on_s)
    assert drawn.drawn.sensor_mah == pytest.approx(((6.1 + 0.038) * on_s + (0.005 + 0.006) * off_s) / 3600)
    assert drawn.start_up_mah < 6.1 * on_s / 3600


def test_the_node_sends_less_and_saves_less():
    drawn = energy("lsm6dso", [(0, True, 200.0), (HOUR // 4, False, 50.0)], HOUR)
    packets_on, packets_off = 200.0 * 16 / 20, 50.0 * 10 / 20  # a second: stamp and six or three numbers
    busy_s = 47 * 8e-6 + 300e-6
    radio = [0.002 + n * busy_s * (9.2 - 0.002) for n in (packets_on, packets_off)]
    sensor = [0.55, 0.026]
    by_hand = 0.25 * (sensor[0] + radio[0]) + 0.75 * (sensor[1] + radio[1])
    assert drawn.drawn.node_mah == pytest.approx(by_hand)
    assert drawn.always_on.node_mah == pytest.approx(sensor[0] + radio[0])
    assert drawn.node_saved_share > 0.0
    assert drawn.node_mah_per_h == pytest.approx(by_hand)


def test_nothing_is_drawn_in_no_time_or_while_the_clock_jumps_back():
    assert energy("bmi270", [], 0).sensor_saved_share == 0.0
    drawn = energy("bmi270", [(100, True, 200.0), (0, True, 200.0)], 10)
    assert drawn.duration_s == 10.0
    assert drawn.drawn.sensor_mah == pytest.approx(0.685 * 10 / 3600)


@pytest.mark.parametrize("part", PARTS)
def test_the_gyro_is_the_most_of_every_part_and_a_lower_rate_never_costs_more(part):
    known = PARTS[part]
    assert known.sensor_ma(True, 200.0) > 2.0 * known.sensor_ma(False, 200.0)
    currents = [known.resting_ma(rate_hz) for rate_hz in (1, 5, 10, 20, 25, 40, 50, 100, 200, 400)]
    assert currents == sorted(currents)


def test_every_part_can_be_chosen():
    assert set(choices_of(PowerParams, "part")) == set(PARTS)

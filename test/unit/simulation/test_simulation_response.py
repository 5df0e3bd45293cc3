"""How the axes of a sensor answer, and the sensor of Qiu's Table 1."""

from dataclasses import replace

import numpy as np
import pytest

from pdr_core.parameter import ParameterError
from pdr_core.params import SimulationParams
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.response import Response, answer, bend, low_passed
from pdr_core.simulation.sensors import QIU_TABLE_1

WALK = SimulationParams(motion="smooth", walk="straight", walk_length_m=6.0, sample_rate_hz=100.0, sensor_model="ideal")


def shown(values, response, seed=0, full_scale=50.0, rate_hz=1000.0):
    return answer(values, rate_hz, response, full_scale, np.random.default_rng(seed))


def test_perfect_axes_show_the_truth_to_the_last_bit():
    values = np.random.default_rng(0).standard_normal((20, 3))
    np.testing.assert_array_equal(shown(values, Response()), values)


def test_axes_lean_by_small_angles_of_their_own():
    leaning = np.array([shown(np.eye(3), Response(alignment_sd_rad=0.01), seed) for seed in range(400)])
    between = leaning - np.eye(3)
    np.testing.assert_array_equal(between[:, range(3), range(3)], 0.0)
    off = ~np.eye(3, dtype=bool)
    np.testing.assert_allclose(between[:, off].std(0), 0.01, rtol=0.15)
    assert np.abs(np.corrcoef(between[:, 0, 1], between[:, 1, 0])[0, 1]) < 0.2  # a skew too, not a turn alone


def test_the_straight_line_is_nowhere_farther_away_than_the_linearity():
    share = np.linspace(-1.2, 1.2, 2401)
    inside = np.abs(share) <= 1.0
    assert np.abs(bend(share)).max() == pytest.approx(1.0)
    assert bend(0.0) == 0.0
    np.testing.assert_allclose(bend(np.array([-1.0, -0.5, 0.5, 1.0])), [-1.0, 1.0, -1.0, 1.0], atol=1e-12)
    others = [np.abs(bend(share) - slope * share)[inside].max() for slope in np.linspace(-4.0, 4.0, 81)]
    assert min(others) >= 1.0 - 1e-12  # no other straight line is nearer
    full = np.array([[50.0, 50.0, 50.0]])
    off = np.array([shown(full, Response(linearity=0.002), seed) - full for seed in range(300)])
    assert 0.095 < np.abs(off).max() <= 0.1
    assert off.min() < -0.09
    assert np.abs(off).mean() == pytest.approx(0.05, rel=0.1)


@pytest.mark.parametrize("bandwidth_hz", [10.0, 40.0])
def test_a_sine_at_the_bandwidth_is_weakened_by_3_db_and_late_by_an_eighth(bandwidth_hz):
    time_s = np.arange(4000) / 1000.0
    late_s = 1.0 / (8.0 * bandwidth_hz)
    wave = np.sin(2.0 * np.pi * bandwidth_hz * time_s)[:, None] * np.ones(3)
    expected = np.sqrt(0.5) * np.sin(2.0 * np.pi * bandwidth_hz * (time_s - late_s))
    np.testing.assert_allclose(low_passed(wave, 1000.0, bandwidth_hz)[1000:, 1], expected[1000:], atol=0.005)


def test_a_low_pass_leaves_a_constant_alone_and_does_not_know_the_future():
    values = np.random.default_rng(1).standard_normal((200, 3))
    np.testing.assert_allclose(low_passed(np.ones((5, 3)) * [1.0, -2.0, 3.0], 1000.0, 30.0)[4], [1.0, -2.0, 3.0])
    np.testing.assert_allclose(low_passed(values[:120], 1000.0, 30.0), low_passed(values, 1000.0, 30.0)[:120])


def test_switching_one_error_off_leaves_the_draw_of_the_others():
    values = np.random.default_rng(2).uniform(-40.0, 40.0, (50, 3))
    both, bent, leaning = (
        shown(values, r) for r in (Response(0.001, 0.002), Response(0.0, 0.002), Response(0.001, 0.0))
    )
    np.testing.assert_allclose(both - values, (bent - values) + (leaning - values), atol=3e-3)
    assert np.abs(bent - values).max() > 0.03
    assert np.abs(leaning - values).max() > 0.03


def test_a_sensor_with_a_low_pass_samples_what_has_been_followed_closely():
    sensor = SensorModel(gyro_response=Response(bandwidth_hz=40.0), accel_response=Response(bandwidth_hz=40.0))
    coarse, fine = (simulated_walk(replace(WALK, sample_rate_hz=r), model=sensor) for r in (100.0, 1000.0))
    np.testing.assert_allclose(coarse.imu.gyro_radps, fine.imu.gyro_radps[::10], atol=1e-12)
    np.testing.assert_array_equal(coarse.motion.position_m, fine.motion.position_m[::10])
    np.testing.assert_array_equal(coarse.imu.stamp_ns, fine.imu.stamp_ns[::10])
    true = simulated_walk(WALK).imu.gyro_radps
    late = np.abs(coarse.imu.gyro_radps - true).max()
    assert 0.1 < late < 1.5


def test_means_do_not_go_with_a_low_pass():
    with pytest.raises(ParameterError, match=r"simulation\.output = 'means'.*set it to points"):
        simulated_walk(replace(WALK, output="means", sensor_model="qiu_table_1"))


def test_table_1_of_qiu():
    s, m = QIU_TABLE_1, QIU_TABLE_1.magnetometer
    responses = (s.accel_response, s.gyro_response, m.response)
    assert np.degrees(s.gyro_range_radps) == pytest.approx(1200.0)
    assert (s.accel_range_mps2, s.accel_bias_sd_mps2) == (50.0, 0.02)
    assert np.degrees(s.gyro_bias_sd_radps) == pytest.approx(1.0)
    assert [r.bandwidth_hz for r in responses] == [30.0, 40.0, 10.0]
    assert [r.linearity for r in responses] == [0.002, 0.001, 0.002]
    np.testing.assert_allclose([np.degrees(r.alignment_sd_rad) for r in responses], 0.1)
    np.testing.assert_allclose([m.range_tesla, m.hard_iron_sd_tesla, m.noise_tesla], [75e-6, 1e-8, 5e-8])
    assert np.degrees(s.gyro_noise_density) == pytest.approx(0.05)
    assert s.accel_noise_density == 0.002

import numpy as np
import pytest

from pdr_core.intake.noise import channels, sample_noise
from pdr_core.params import IntakeParams
from pdr_core.records import inertial_block, part

P = IntakeParams(gyro_noise_density=0.001, accel_noise_density=0.01, change_noise=0.2)
REST, MS = ([0.0, 0.0, 0.0], [0.0, 9.81, 0.0]), 1_000_000


def block(*samples, period_ms=40):
    n = len(samples)
    rate, force = (np.array([s[k] for s in samples]) for k in (0, 1))
    return inertial_block(np.arange(n) * period_ms * MS, rate, force, np.zeros(n), np.zeros(n))


def noise(imu, clipped=False):
    return sample_noise(imu, np.full(len(imu.stamp_ns), clipped), part(imu, 0, 0), *channels(P))


def test_a_foot_at_rest_has_the_white_noise_of_the_sensor():
    gyro, accel, gyro_full, accel_full = noise(block(REST, REST))
    assert (gyro[1], accel[1]) == pytest.approx((0.001 / 0.2, 0.01 / 0.2))
    assert not gyro_full.any()
    assert not accel_full.any()


def test_noise_grows_with_the_change_from_sample_to_sample():
    gyro, accel, *_ = noise(block(REST, ([3.0, 0.0, 4.0], [2.0, 9.81, 0.0]), ([3.0, 0.0, 4.0], [2.0, 9.81, 0.0])))
    assert gyro[1] == pytest.approx(np.hypot(0.005, 0.2 * 5.0))
    assert accel[1] == pytest.approx(np.hypot(0.05, 0.2 * 2.0))
    assert (gyro[2], accel[2]) == pytest.approx((0.005, 0.05))


def test_an_absurd_change_hides_no_more_than_the_range():
    gyro, accel, *_ = noise(block(REST, ([1e6, 0.0, 0.0], [1e6, 0.0, 0.0])))
    assert (gyro[1], accel[1]) == pytest.approx((P.gyro_range_radps, P.accel_range_mps2), rel=1e-3)


def test_the_sample_before_the_block_counts():
    imu = block(REST, ([1.0, 0.0, 0.0], [0.0, 0.0, 0.0]))
    flags = np.zeros(1, np.bool_)
    gyro, accel, *_ = sample_noise(part(imu, 1), flags, part(imu, 0, 1), *channels(P))
    assert (gyro[0], accel[0]) == (noise(imu)[0][1], noise(imu)[1][1])


@pytest.mark.parametrize("step_ms", [100, 5000, -5000])
def test_a_gap_and_a_jump_of_the_clock_hide_the_change(step_ms):
    gyro, *_ = noise(block(REST, ([9.0, 0.0, 0.0], [0.0, 0.0, 0.0]), period_ms=step_ms))
    assert gyro[1] == pytest.approx(0.001 / np.sqrt(0.1))


def test_a_clipped_rate_is_saturated_though_it_is_within_the_range():
    gyro, accel, gyro_full, accel_full = noise(block(REST, REST), clipped=True)
    assert gyro[1] == pytest.approx(np.hypot(0.001, P.saturated_gyro_noise_density) / 0.2)
    assert accel[1] == pytest.approx(0.05)
    assert gyro_full.all()
    assert not accel_full.any()

import numpy as np
import pytest

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.intake.noise import channels, sample_noise
from pdr_core.params import IntakeParams
from pdr_core.records import ImuBlock

P = IntakeParams(gyro_noise_density=0.001, accel_noise_density=0.01, gyro_motion_noise=0.002, accel_motion_noise=0.003)


def densities(rate, force, clipped=False):
    one = np.zeros(1)
    block = ImuBlock(np.array([40_000_000]), np.array([rate]), np.array([force]), one, one)
    gyro_sd, accel_sd, gyro_full, accel_full = sample_noise(block, np.array([clipped]), 0, *channels(P))
    return gyro_sd[0] * 0.2, accel_sd[0] * 0.2, gyro_full[0], accel_full[0]


def test_a_foot_at_rest_has_the_noise_of_the_sensor():
    found = densities([0.0, 0.0, 0.0], [0.0, STANDARD_GRAVITY_MPS2, 0.0])
    assert found == (pytest.approx(0.001), pytest.approx(0.01), False, False)


def test_noise_grows_with_the_motion():
    gyro, accel, *_ = densities([3.0, 0.0, 4.0], [0.0, 0.0, 0.0])
    assert gyro == pytest.approx(np.hypot(0.001, 0.002 * 5.0))
    assert accel == pytest.approx(np.hypot(0.01, 0.003 * STANDARD_GRAVITY_MPS2))


def test_a_clipped_rate_is_saturated_though_it_is_within_the_range():
    gyro, accel, *full = densities([0.0, 0.0, 0.0], [0.0, 0.0, STANDARD_GRAVITY_MPS2], clipped=True)
    assert gyro == pytest.approx(np.hypot(0.001, P.saturated_gyro_noise_density))
    assert accel == pytest.approx(0.01)
    assert full == [True, False]

import numpy as np
import pytest

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.intake.noise import sample_noise
from pdr_core.params import IntakeParams
from pdr_core.records import ImuBlock

P = IntakeParams(gyro_noise_density=0.001, accel_noise_density=0.01, gyro_motion_noise=0.002, accel_motion_noise=0.003)


def noise(rate, force, full=False):
    one = np.zeros(1)
    block = ImuBlock(np.zeros(1, np.int64), np.array([rate]), np.array([force]), one, one)
    flags = np.array([full])
    gyro, accel = sample_noise(block, np.array([0.04]), flags, flags, P)
    return gyro[0] * 0.2, accel[0] * 0.2  # densities


def test_a_foot_at_rest_has_the_noise_of_the_sensor():
    assert noise([0.0, 0.0, 0.0], [0.0, STANDARD_GRAVITY_MPS2, 0.0]) == pytest.approx((0.001, 0.01))


def test_noise_grows_with_the_motion():
    gyro, accel = noise([3.0, 0.0, 4.0], [0.0, 0.0, 0.0])
    assert gyro == pytest.approx(np.hypot(0.001, 0.002 * 5.0))
    assert accel == pytest.approx(np.hypot(0.01, 0.003 * STANDARD_GRAVITY_MPS2))


def test_saturation_adds_a_noise_of_its_own():
    gyro, accel = noise([0.0, 0.0, 0.0], [0.0, 0.0, STANDARD_GRAVITY_MPS2], full=True)
    assert gyro == pytest.approx(np.hypot(0.001, P.saturated_gyro_noise_density))
    assert accel == pytest.approx(np.hypot(0.01, P.saturated_accel_noise_density))

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.records import inertial_block
from pdr_core.stance.glrt import statistics

G, ACCEL_SD, GYRO_SD, MS = 9.81, 0.1, 0.017, 1_000_000


def random_block(seed, n=60):
    rng = np.random.default_rng(seed)
    stamps = np.cumsum(rng.integers(1, 9, n)) * MS
    force = rng.standard_normal((n, 3)) * 3.0 + [0, 0, G]
    return inertial_block(stamps, rng.standard_normal((n, 3)), force, np.zeros(n), np.zeros(n))


def restated(imu, i, half_ns):
    window = np.abs(imu.stamp_ns - imu.stamp_ns[i]) <= half_ns
    window[max(0, i - 1) : i + 2] = True
    force, rate = imu.accel_mps2[window], imu.gyro_radps[window]
    up = force.mean(0) / np.linalg.norm(force.mean(0))
    terms = ((force - G * up) ** 2).sum(1) / ACCEL_SD**2 + (rate**2).sum(1) / GYRO_SD**2
    return terms.mean()


@given(st.integers(0, 2**32 - 1), st.integers(0, 40))
def test_the_statistic_is_equation_8_over_a_centred_window(seed, half_ms):
    imu = random_block(seed)
    expected = [restated(imu, i, half_ms * MS) for i in range(60)]
    np.testing.assert_allclose(statistics(imu, 0, 60, half_ms * MS, G, ACCEL_SD, GYRO_SD), expected, rtol=1e-12)


def test_a_part_of_the_samples_gives_the_same_bits():
    imu = random_block(1)
    whole = statistics(imu, 0, 60, 20 * MS, G, ACCEL_SD, GYRO_SD)
    np.testing.assert_array_equal(statistics(imu, 17, 41, 20 * MS, G, ACCEL_SD, GYRO_SD), whole[17:41])


def test_a_foot_at_rest_has_the_smallest_statistic_however_it_is_tilted():
    still = random_block(2)
    still.accel_mps2[:], still.gyro_radps[:] = G * np.array([0.6, 0.0, 0.8]), 0.0
    np.testing.assert_allclose(statistics(still, 0, 60, 20 * MS, G, ACCEL_SD, GYRO_SD), 0.0, atol=1e-20)


def test_weightlessness_is_not_rest_and_does_not_divide_by_zero():
    falling = random_block(3)
    falling.accel_mps2[:], falling.gyro_radps[:] = 0.0, 0.0
    found = statistics(falling, 0, 60, 20 * MS, G, ACCEL_SD, GYRO_SD)
    assert np.all(np.isfinite(found))


def test_without_a_gyro_there_is_no_stance():
    imu = random_block(4)
    imu.gyro_sd_radps[30] = -1.0
    found = statistics(imu, 0, 60, 10 * MS, G, ACCEL_SD, GYRO_SD)
    near = np.abs(imu.stamp_ns - imu.stamp_ns[30]) <= 10 * MS
    np.testing.assert_array_equal(np.isinf(found), near)

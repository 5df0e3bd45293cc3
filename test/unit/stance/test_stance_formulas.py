"""Every statistic of the family but the GLRT against its formula, restated in plain numpy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.records import inertial_block
from pdr_core.stance import (
    acceleration_magnitude,
    acceleration_moving_variance,
    angular_rate_energy,
    mbgtd,
    three_conditions,
)

G, MS, N = 9.81, 1_000_000, 40
LIMITS = (0.1, 2.0, 0.5)


def random_block(seed):
    rng = np.random.default_rng(seed)
    stamps = np.cumsum(rng.integers(1, 9, N)) * MS
    force = rng.standard_normal((N, 3)) * 3.0 + [0, 0, G]
    return inertial_block(stamps, rng.standard_normal((N, 3)), force, np.zeros(N), np.zeros(N))


def norms(rows):
    return np.linalg.norm(rows, axis=1)


def rate_energy(_here, _force, rate):
    return (rate**2).sum(1).mean()


def moving_variance(_here, force, _rate):
    return force.var(axis=0).sum() if len(force) > 1 else np.inf


def magnitude(_here, force, _rate):
    return ((norms(force) - G) ** 2).mean()


def longest_cut(_here, force, _rate):
    edges = np.linalg.norm(force[:, None] - force[None], axis=2)
    n = len(force)
    return max((edges[: a + 1, b:].mean() for a in range(n) for b in range(a + 1, n)), default=np.inf)


def conditions(here, force, rate):
    ratios = abs(np.linalg.norm(here) / G - 1.0), norms(force).var(), rate_energy(here, force, rate)
    return max(ratio / limit for ratio, limit in zip(ratios, LIMITS, strict=True))


FAMILY = {
    "angular_rate_energy": (angular_rate_energy, (), rate_energy),
    "acceleration_moving_variance": (acceleration_moving_variance, (), moving_variance),
    "acceleration_magnitude": (acceleration_magnitude, (G,), magnitude),
    "mbgtd": (mbgtd, (), longest_cut),
    "three_conditions": (three_conditions, (G, *LIMITS), conditions),
}
EACH = pytest.mark.parametrize("name", FAMILY)
NEEDS_GYRO = ("angular_rate_energy", "three_conditions")


@EACH
@given(seed=st.integers(0, 2**32 - 1), half_ms=st.integers(0, 30))
def test_the_statistic_is_its_formula_over_a_centred_window(name, seed, half_ms):
    imu = random_block(seed)
    detector, numbers, formula = FAMILY[name]
    expected = []
    for i in range(N):
        window = np.abs(imu.stamp_ns - imu.stamp_ns[i]) <= half_ms * MS
        window[max(0, i - 1) : i + 2] = True
        expected.append(formula(imu.accel_mps2[i], imu.accel_mps2[window], imu.gyro_radps[window]))
    found = detector.statistics(imu, 0, N, half_ms * MS, *numbers)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12)


@EACH
def test_a_part_of_the_samples_has_the_same_bits(name):
    imu = random_block(1)
    detector, numbers, _ = FAMILY[name]
    whole = detector.statistics(imu, 0, N, 20 * MS, *numbers)
    np.testing.assert_array_equal(detector.statistics(imu, 11, 30, 20 * MS, *numbers), whole[11:30])


@EACH
def test_only_what_needs_the_gyro_is_blind_without_it(name):
    imu = random_block(4)
    imu.gyro_sd_radps[20] = -1.0
    detector, numbers, _ = FAMILY[name]
    near = np.abs(imu.stamp_ns - imu.stamp_ns[20]) <= 10 * MS
    blind = np.isinf(detector.statistics(imu, 0, N, 10 * MS, *numbers))
    np.testing.assert_array_equal(blind, near if name in NEEDS_GYRO else np.zeros(N, bool))


@pytest.mark.parametrize("name", ["acceleration_moving_variance", "mbgtd", "three_conditions"])
def test_a_sample_between_two_gaps_shows_no_change_and_so_no_rest(name):
    imu = random_block(5)
    imu.stamp_ns[20:] += 10**9
    imu.stamp_ns[21:] += 10**9
    detector, numbers, _ = FAMILY[name]
    found = detector.statistics(imu, 0, N, 10 * MS, *numbers)
    np.testing.assert_array_equal(np.flatnonzero(np.isinf(found)), [20])


def test_free_fall_is_no_rest_as_qiu_22_would_have_it():
    falling = random_block(3)
    falling.accel_mps2[:], falling.gyro_radps[:] = 0.0, 0.0
    assert np.all(three_conditions.statistics(falling, 0, N, 10 * MS, G, *LIMITS) == 1.0 / LIMITS[0])

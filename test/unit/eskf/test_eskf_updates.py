import numpy as np
import pytest
from filter_cases import copied, injected, random_state
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pdr_core.eskf import gravity, zaru, zupt
from pdr_core.eskf.configure import settings
from pdr_core.eskf.error_state import GYRO_BIAS, VELOCITY
from pdr_core.eskf.known_yaw import YAW, given_yaw
from pdr_core.eskf.updates import level, zero_rate, zero_velocity
from pdr_core.maths.kalman import innovation
from pdr_core.params import FilterParams, PlaceParams

SEEDS = st.integers(0, 2**32 - 1)
SETTINGS = settings(FilterParams(), PlaceParams())
SD, HEIGHT_M, MS = 0.02, SETTINGS.contact_height_m, 1_000_000


def stands(state, stamp_ns=0, rate=None, sd=SD):
    """Tell a filter whose last sample was 5 ms ago that the foot stands, without turning if no rate is given."""
    state.last_ns = stamp_ns - 5 * MS
    return zero_velocity(stamp_ns, state.gyro_bias_radps if rate is None else rate, sd, SETTINGS, state)


def certain(seed, velocity, variance=1e-6):
    """Return a filter that is sure of its velocity."""
    state = random_state(np.random.default_rng(seed))
    state.P[:] = np.eye(15) * variance
    state.velocity_mps[:] = velocity
    return state


@given(SEEDS)
def test_the_jacobians_are_what_a_correction_does_to_the_residual(seed):
    rng = np.random.default_rng(seed)
    state, measured = random_state(rng), rng.standard_normal(3) * 0.01
    rolling = (0.1, -0.2, 0.0)
    for column in range(15):
        e = np.zeros(15)
        e[column] = 1e-3
        corrected = injected(state, e)
        # The residual is truth minus estimate: correcting the estimate by e lowers it by H e.
        velocity = zupt.residual(rolling, state.velocity_mps) - zupt.residual(rolling, corrected.velocity_mps)
        rate = zaru.residual(measured, state.gyro_bias_radps) - zaru.residual(measured, corrected.gyro_bias_radps)
        np.testing.assert_allclose(velocity, zupt.H @ e, atol=1e-13)
        np.testing.assert_allclose(rate, zaru.H @ e, atol=1e-13)


@given(SEEDS)
def test_what_the_jacobian_leaves_out_is_far_below_the_noise(seed):
    rng = np.random.default_rng(seed)
    state = random_state(rng)
    rate = rng.standard_normal(3) * 0.5
    known = np.repeat([0.0, 0.0, 0.01, 0.0, 0.003], 3)  # errors of a filter that walks

    def expected(s):
        return np.array(zupt.rolling_velocity(s.quat_xyzw, rate - s.gyro_bias_radps, HEIGHT_M))

    up, R = np.array([0.0, 0.0, 1.0]), np.column_stack([rotated_by(state, axis) for axis in np.eye(3)])
    w = R @ (rate - state.gyro_bias_radps)
    for column in (*range(6, 9), *range(12, 15)):
        e = np.eye(15)[column] * 1e-4
        found = (expected(injected(state, e)) - expected(injected(state, -e))) / 2e-4
        axis = np.eye(3)[column % 3]
        exact = HEIGHT_M * np.cross(np.cross(axis, w) if column < 9 else -R @ axis, up)
        np.testing.assert_allclose(found, exact, atol=1e-6)
        assert np.linalg.norm(found) * known[column] < 0.25 * SETTINGS.zero_velocity_sd_mps


def test_a_foot_that_rolls_moves_over_its_contact():
    level_foot = np.array([0.0, 0.0, 0.0, 1.0])
    forward = zupt.rolling_velocity(level_foot, (0.0, 2.0, 0.0), 0.1)
    np.testing.assert_allclose(forward, [0.2, 0.0, 0.0])  # heel up, toe down: the ankle goes forward
    np.testing.assert_allclose(zupt.rolling_velocity(level_foot, (2.0, 0.0, 0.0), 0.1), [0.0, -0.2, 0.0])
    upside_down = np.array([1.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(zupt.rolling_velocity(upside_down, (0.0, -2.0, 0.0), 0.1), forward, atol=1e-15)


@given(SEEDS)
def test_a_stance_pulls_the_velocity_to_that_of_the_contact_and_leaves_yaw_and_gyro_bias_alone(seed):
    rng = np.random.default_rng(seed)
    state = random_state(rng)
    rate = state.gyro_bias_radps + rng.standard_normal(3)
    expected = np.array(zupt.rolling_velocity(state.quat_xyzw, rate - state.gyro_bias_radps, HEIGHT_M))
    given = given_yaw(state.P[YAW], innovation(state.P, zupt.H, np.eye(3), np.zeros(3)))
    state.velocity_mps[:] = expected + np.linalg.cholesky(given.S - np.eye(3)) @ [0.5, 0.5, 0.5]
    before = copied(state)
    assert stands(state, rate=rate)
    assert np.linalg.norm(state.velocity_mps - expected) < np.linalg.norm(before.velocity_mps - expected)
    np.testing.assert_array_equal(state.gyro_bias_radps, before.gyro_bias_radps)
    block = slice(GYRO_BIAS, GYRO_BIAS + 3)
    np.testing.assert_array_equal(state.P[block, block], before.P[block, block])
    assert state.P[8, 8] == pytest.approx(before.P[8, 8], rel=1e-12)
    assert not np.array_equal(state.accel_bias_mps2, before.accel_bias_mps2)
    assert np.linalg.eigvalsh(state.P)[0] > -1e-12


@given(SEEDS)
def test_the_yaw_has_no_part_in_how_a_stance_is_weighed(seed):
    rng = np.random.default_rng(seed)
    known, lost = random_state(rng), random_state(rng)
    known.P[8], known.P[:, 8] = 0.0, 0.0
    lost.P[:] = known.P
    turned = rng.standard_normal(15)  # how all errors go with that of the yaw
    turned[8] = 1.0
    lost.P += 4.0 * np.outer(turned, turned)
    R, r = np.eye(3) * SD**2, rng.standard_normal(3)
    a = innovation(known.P, zupt.H, R, r)
    b = given_yaw(lost.P[YAW], innovation(lost.P, zupt.H, R, r))
    np.testing.assert_allclose(b.HP, a.HP, atol=1e-9)
    np.testing.assert_allclose(b.S, a.S, atol=1e-9)
    np.testing.assert_allclose(b.S @ b.S_inverse, np.eye(3), atol=1e-8)


@given(SEEDS)
def test_a_rest_shows_the_gyro_bias(seed):
    rng = np.random.default_rng(seed)
    state, true_bias = random_state(rng), rng.uniform(-0.05, 0.05, 3)
    state.P[:] += np.diag(np.repeat([0, 0, 0, 0, 0.1**2], 3))
    zero_rate(true_bias, 1e-5, state)
    np.testing.assert_allclose(state.gyro_bias_radps, true_bias, atol=1e-6)
    np.testing.assert_allclose(np.sqrt(np.diag(state.P)[12:]), 1e-5, rtol=1e-2)


def test_a_rest_also_corrects_the_yaw_that_the_bias_has_turned():
    state = random_state(np.random.default_rng(5))
    state.quat_xyzw[:], state.gyro_bias_radps[:], state.P[:] = [0, 0, 0, 1], 0.0, np.eye(15) * 1e-12
    state.P[14, 14], state.P[8, 8], state.P[8, 14], state.P[14, 8] = 1e-4, 1e-2, -1e-3, -1e-3  # yaw = -10 s * bias
    zero_rate(np.array([0.0, 0.0, 0.001]), 1e-6, state)
    assert 2 * np.arcsin(state.quat_xyzw[2]) == pytest.approx(-0.01, rel=1e-3)


def test_a_dip_in_mid_swing_hardly_counts_and_a_stance_that_goes_on_makes_the_filter_doubt():
    state = certain(6, [5.0, 0.0, 0.0])
    agreed = [stands(state, t * 5 * MS) for t in range(19)]
    assert not any(agreed)
    assert state.velocity_mps[0] > 4.9
    assert (state.contradicted, state.doubted) == (19, 0)
    agreed = [stands(state, t * 5 * MS) for t in range(19, 60)]  # the release time is 0.1 s
    assert state.doubted == 1
    assert all(agreed[2:])
    assert np.linalg.norm(state.velocity_mps) < 0.1


@pytest.mark.parametrize("speed", [0.3, 2.0, 500.0])
def test_no_speed_locks_the_filter_out(speed):
    state = certain(6, [0.0, speed, 0.0])
    agreed = [stands(state, t * 5 * MS) for t in range(80)]
    assert all(agreed[-10:])
    assert np.linalg.norm(state.velocity_mps) < 0.1


def test_agreement_ends_a_contradiction():
    state = certain(7, [5.0, 0.0, 0.0])
    assert not stands(state, 0)
    state.velocity_mps[:] = 0.0
    assert stands(state, 5 * MS)
    assert state.contradicted_s == 0.0
    assert state.doubted == 0


def test_only_time_in_stance_counts_as_a_contradiction():
    state = certain(7, [5.0, 0.0, 0.0])
    for t in range(10):
        assert not stands(state, t * 200 * MS)
    assert state.contradicted_s == pytest.approx(0.05)
    assert state.doubted == 0


def test_two_stances_in_a_row_that_contradict_make_the_filter_doubt():
    state = certain(7, [5.0, 0.0, 0.0])
    assert not stands(state, 0)
    assert state.doubted == 0
    stands(state, 600 * MS)
    assert state.doubted == 1
    assert np.linalg.norm(state.velocity_mps) < 0.1


def test_a_stance_that_counts_for_little_does_not_end_a_contradiction():
    """Where a stance begins and ends, its noise is large: the velocity may be far off and pass the gate."""
    state = certain(7, [5.0, 0.0, 0.0])
    assert not stands(state, 0)
    assert stands(state, 5 * MS, sd=1.5)
    assert state.normalised_innovation > SETTINGS.huber
    assert state.contradicted_s > 0.0


@pytest.mark.parametrize("excess", [0.5, 0.99, 4.0, 5.9])
def test_beyond_hubers_limit_a_stance_counts_less(excess):
    variance, d2 = 1e-4, excess * SETTINGS.huber
    state = certain(8, [np.sqrt(d2 * (variance + SD**2)), 0.0, 0.0], variance)
    before = state.velocity_mps[0]
    assert stands(state)
    assert state.normalised_innovation == pytest.approx(d2)
    R = SD**2 * max(1.0, excess)
    assert state.velocity_mps[0] == pytest.approx(before * R / (variance + R))
    assert (state.accepted, state.contradicted) == (1, 0)


@pytest.mark.parametrize("tilt", [[0.3, 0.0], [0.0, -0.3], [1.5, 2.0], [3.14, 0.0]])
def test_a_standing_foot_is_levelled_from_any_tilt(tilt):
    state = certain(9, [0.0, 0.0, 0.0])
    state.P[6, 6] = state.P[7, 7] = 9.0
    up = injected(state, np.array([0.0] * 6 + [-x for x in tilt] + [0.0] * 7))  # the truth is turned by -tilt
    force = np.linalg.inv(np.column_stack([rotated_by(up, axis) for axis in np.eye(3)])) @ [0.0, 0.0, 9.81]
    yaw_variance = state.P[8, 8]
    level(force + state.accel_bias_mps2, 0.005, state)
    assert rotated_by(state, force)[2] == pytest.approx(9.81, rel=1e-4)
    assert state.P[8, 8] == pytest.approx(yaw_variance)
    assert not gravity.tilt_is_lost(state.P)


def rotated_by(state, vector):
    """Return a vector in the world frame."""
    return Rotation.from_quat(state.quat_xyzw).apply(vector)


@given(SEEDS)
def test_levelling_leaves_the_gyro_bias_alone_and_what_it_has_to_do_with_the_yaw(seed):
    state = random_state(np.random.default_rng(seed))
    before = copied(state)
    level(np.array([1.0, 2.0, 9.0]), SD, state)
    bias = slice(GYRO_BIAS, GYRO_BIAS + 3)
    assert not np.array_equal(state.quat_xyzw, before.quat_xyzw)
    np.testing.assert_array_equal(state.gyro_bias_radps, before.gyro_bias_radps)
    np.testing.assert_allclose(state.P[YAW, bias], before.P[YAW, bias], rtol=1e-9, atol=1e-12)


def test_the_jacobians_pick_velocity_and_gyro_bias():
    assert np.array_equal(np.flatnonzero(zupt.H.any(0)), [VELOCITY, VELOCITY + 1, VELOCITY + 2])
    assert np.array_equal(np.flatnonzero(zaru.H.any(0)), [GYRO_BIAS, GYRO_BIAS + 1, GYRO_BIAS + 2])

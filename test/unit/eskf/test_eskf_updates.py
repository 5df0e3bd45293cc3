import numpy as np
import pytest
from filter_cases import copied, injected, random_state
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pdr_core.eskf import zaru, zupt
from pdr_core.eskf.configure import settings
from pdr_core.eskf.error_state import ATTITUDE, GYRO_BIAS, VELOCITY
from pdr_core.eskf.updates import zero_rate, zero_velocity
from pdr_core.params import FilterParams, PlaceParams

SEEDS = st.integers(0, 2**32 - 1)
SETTINGS = settings(FilterParams(), PlaceParams())
MS = 1_000_000


def foot_velocity(state):
    return Rotation.from_quat(state.quat_xyzw).inv().apply(state.velocity_mps)


@given(SEEDS)
def test_the_jacobians_are_what_a_correction_does_to_the_residual(seed):
    rng = np.random.default_rng(seed)
    state, measured = random_state(rng), rng.standard_normal(3) * 0.01
    H, R, step = zupt.jacobian(state.velocity_mps), Rotation.from_quat(state.quat_xyzw), 1e-4
    for column in range(15):
        e = np.zeros(15)
        e[column] = step
        ahead, back = injected(state, e), injected(state, -e)
        # The residual is truth minus estimate: correcting the estimate by e lowers it by H e.
        velocity = R.apply(foot_velocity(ahead) - foot_velocity(back)) / 2.0
        if column in (ATTITUDE, ATTITUDE + 1):
            velocity[:] = 0.0  # left out on purpose, see `zupt.py`
        rate = zaru.residual(measured, back.gyro_bias_radps) - zaru.residual(measured, ahead.gyro_bias_radps)
        np.testing.assert_allclose(velocity, H @ e, atol=1e-11)
        np.testing.assert_allclose(rate / 2.0, zaru.H @ e, atol=1e-13)
    np.testing.assert_allclose(zupt.residual(state.velocity_mps), -R.apply(foot_velocity(state)), atol=1e-14)


@given(SEEDS)
def test_a_stance_tells_nothing_of_the_yaw(seed):
    """Turn the whole estimate about the vertical: no residual changes, and no update narrows it."""
    rng = np.random.default_rng(seed)
    state = random_state(rng)
    state.P[12:], state.P[:, 12:] = 0.0, 0.0
    state.velocity_mps[:] = np.linalg.cholesky(state.P[3:6, 3:6]) @ [0.5, 0.5, 0.5]

    def turned(velocity):
        return np.concatenate([np.cross([0, 0, 1], velocity), [0, 0, 1], np.zeros(3)])

    def known_of_turn(s):
        direction = turned(s.velocity_mps)
        return direction @ np.linalg.solve(s.P[3:12, 3:12], direction)

    before = known_of_turn(state)
    assert zero_velocity(0, SETTINGS, state)
    assert known_of_turn(state) == pytest.approx(before, rel=1e-6)


@given(SEEDS)
def test_a_zero_velocity_pulls_the_velocity_to_zero_and_leaves_the_gyro_bias_alone(seed):
    state = random_state(np.random.default_rng(seed))
    state.velocity_mps[:] = np.linalg.cholesky(state.P[3:6, 3:6]) @ [0.5, 0.5, 0.5]
    before = copied(state)
    assert zero_velocity(0, SETTINGS, state)
    assert np.linalg.norm(state.velocity_mps) < np.linalg.norm(before.velocity_mps)
    np.testing.assert_array_equal(state.gyro_bias_radps, before.gyro_bias_radps)
    block = slice(GYRO_BIAS, GYRO_BIAS + 3)
    np.testing.assert_array_equal(state.P[block, block], before.P[block, block])
    assert np.all(np.diag(state.P)[:12] <= np.diag(before.P)[:12] * (1 + 1e-12))
    assert not np.array_equal(state.accel_bias_mps2, before.accel_bias_mps2)


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


def test_the_gate_rejects_a_short_disagreement_and_gives_way_to_a_long_one():
    state = random_state(np.random.default_rng(6))
    state.P[:] = np.eye(15) * 1e-6
    state.velocity_mps[:] = [5.0, 0.0, 0.0]
    believed = [zero_velocity(t * 5 * MS, SETTINGS, state) for t in range(21)]
    assert believed == [False] * 20 + [True]  # the release time is 0.1 s
    assert (state.rejected, state.released, state.accepted) == (20, 1, 1)
    assert state.normalised_innovation > SETTINGS.gate


def test_agreement_ends_a_row_of_rejections():
    state = random_state(np.random.default_rng(7))
    state.P[:] = np.eye(15) * 1e-6
    state.velocity_mps[:] = [5.0, 0.0, 0.0]
    assert not zero_velocity(0, SETTINGS, state)
    state.velocity_mps[:] = 0.0
    assert zero_velocity(5 * MS, SETTINGS, state)
    state.velocity_mps[:] = [5.0, 0.0, 0.0]
    assert not zero_velocity(500 * MS, SETTINGS, state)
    assert state.released == 0


def test_what_just_passes_the_gate_has_its_normalised_innovation():
    state = random_state(np.random.default_rng(8))
    state.P[:] = np.eye(15) * 1e-4
    sd = np.sqrt(1e-4 + SETTINGS.zero_velocity_sd_mps**2)
    for d2, believed in ((SETTINGS.gate * 0.999, True), (SETTINGS.gate * 1.001, False)):
        tried = copied(state)
        tried.velocity_mps[:] = [np.sqrt(d2) * sd, 0.0, 0.0]
        assert zero_velocity(0, SETTINGS, tried) is believed
        assert tried.normalised_innovation == pytest.approx(d2)


def test_a_foot_that_stands_still_shows_its_velocity_and_a_rest_its_gyro_bias():
    assert np.array_equal(np.flatnonzero(zupt.jacobian(np.zeros(3)).any(0)), [VELOCITY, VELOCITY + 1, VELOCITY + 2])
    assert np.array_equal(np.flatnonzero(zaru.H.any(0)), [GYRO_BIAS, GYRO_BIAS + 1, GYRO_BIAS + 2])

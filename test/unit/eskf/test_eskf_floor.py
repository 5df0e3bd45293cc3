"""Level ground: the height of a standing foot is tied to the floor, and nothing else is."""

import numpy as np
import pytest
from filter_cases import copied, injected, judged, moved, random_state, standing, transition
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.eskf import ZuptFilter, floor
from pdr_core.eskf.configure import settings
from pdr_core.eskf.process import carry, noise, propagate_covariance
from pdr_core.eskf.step_events import begin_next, stand
from pdr_core.eskf.updates import stand_on_floor, zero_velocity
from pdr_core.params import Params, PlaceParams, changed

SEEDS = st.integers(0, 2**32 - 1)
LEVEL = changed(Params(), "filter", level_ground=True)
SETTINGS = settings(LEVEL.filter, PlaceParams())
CALM_MPS, FLOOR_SD_M = SETTINGS.zero_velocity_sd_mps, SETTINGS.floor_sd_m
Z, LAST, FLOOR = 2, slice(15, 18), 18  # rows of the large covariance: 15 errors, end of the last stance, floor


def on_a_new_floor(state):
    """End a stance that has told nothing of the floor."""
    stand(0, state)
    begin_next(state)
    floor.settle(FLOOR_SD_M, state)
    return state


@given(SEEDS)
def test_the_covariances_of_a_foot_on_a_new_floor_are_those_of_their_errors(seed):
    state = on_a_new_floor(random_state(np.random.default_rng(seed)))
    e = np.linalg.cholesky(state.P)
    measured = e[Z] - e[Z]  # the height and that of the floor have the same error now, but for how the foot stood
    y = floor.innovation(1e-4, state)
    np.testing.assert_allclose(y.HP[0], measured @ e.T, atol=1e-12)
    np.testing.assert_allclose(y.S, [[FLOOR_SD_M**2 + 1e-4]], rtol=1e-9)
    for column in range(15):
        error = np.eye(15)[column] * 1e-3
        lower = y.residual - floor.innovation(1e-4, injected(state, error)).residual
        np.testing.assert_allclose(lower, [error[Z]], atol=1e-13)


def dense_update(P, H, R, rows):
    """Update the large covariance by the optimal gain of some rows."""
    K = np.where(rows[:, None], P @ H.T @ np.linalg.inv(H @ P @ H.T + R), 0.0)
    rest = np.eye(len(P)) - K @ H
    return rest @ P @ rest.T + K @ R @ K.T


def dense_zero_velocity(P):
    """Update it as the filter does: as if the yaw were known, and not the gyro bias nor what is remembered.

    The place moves as the displacement since the last stance does.
    """
    H, R, displaced = np.eye(19)[3:6], CALM_MPS**2 * np.eye(3), np.eye(19)
    displaced[:2, 15:17] = -np.eye(2)
    known = P - np.outer(P[:, 8], P[8]) / P[8, 8]
    K = displaced @ known @ H.T @ np.linalg.inv(H @ known @ H.T + R)
    K[12:] = 0.0
    rest = np.eye(19) - K @ H
    return rest @ P @ rest.T + K @ R @ K.T


def strode(state, P, rng):
    """Move filter and large covariance by a stride's worth of samples."""
    for _ in range(20):
        _, link = moved(state, rng.uniform(-5, 5, 3), rng.uniform(-20, 20, 3), rng.uniform(-20, 20, 3), 0.01)
        q, F = noise(0.2, 0.01, 0.01, SETTINGS.process), np.eye(19)
        F[:15, :15] = transition(link)
        P = F @ P @ F.T + np.diag([*q, 0, 0, 0, 0])
        propagate_covariance(state.P, link, q)
        carry(link, state.cross)
        carry(link, state.floor_cross)
    return P


def stood(state, P, stamp_ns):
    """Let filter and large covariance stand on the floor; return the latter and the covariance of the step."""
    H = (np.eye(19)[Z] - np.eye(19)[FLOOR])[None]
    for sd_mps in (0.3, CALM_MPS):
        state.velocity_mps[:] = 0.0
        assert zero_velocity(stamp_ns, state.gyro_bias_radps, CALM_MPS, SETTINGS, state)
        P = dense_zero_velocity(P)
        state.position_m[Z] = state.floor_m + 0.01
        R = 1.0 / (floor.information(sd_mps, FLOOR_SD_M) - state.floor_told)
        stand_on_floor(sd_mps, SETTINGS, state)
        P = dense_update(P, H, R * np.eye(1), np.arange(19) == Z)
    stand(stamp_ns, state)
    step = np.hstack([np.eye(3), np.zeros((3, 12)), -np.eye(3), np.zeros((3, 1))])
    return P, step @ P @ step.T


@pytest.mark.parametrize("seed", range(5))
def test_the_covariances_are_those_of_a_filter_that_remembers_the_floor(seed):
    rng = np.random.default_rng(seed)
    state = on_a_new_floor(random_state(rng))
    remember = np.vstack([np.eye(15), np.eye(15)[:3], np.eye(15)[Z]])
    P = remember @ state.P @ remember.T
    P[FLOOR, FLOOR] += FLOOR_SD_M**2
    for stance in range(1, 4):
        P = strode(state, P, rng)
        P, step = stood(state, P, stance * 10**9)
        np.testing.assert_allclose(state.displacement_covariance, step, rtol=1e-7, atol=1e-12)
        np.testing.assert_allclose(state.P, P[:15, :15], rtol=1e-7, atol=1e-12)
        np.testing.assert_allclose(state.floor_cross[:, 0], P[:15, FLOOR], rtol=1e-7, atol=1e-12)
        begin_next(state)
        floor.settle(FLOOR_SD_M, state)
        P[LAST], P[:, LAST] = P[:3], P[:, :3]
        P[LAST, LAST] = P[:3, :3]


@given(SEEDS)
def test_standing_on_the_floor_moves_the_height_alone(seed):
    rng = np.random.default_rng(seed)
    state = on_a_new_floor(random_state(rng))
    state.floor_cross *= 0.5
    state.position_m[Z] += 0.05
    before = copied(state)
    stand_on_floor(CALM_MPS, SETTINGS, state)
    assert abs(state.position_m[Z] - state.floor_m) < 0.05
    assert state.P[Z, Z] < before.P[Z, Z]
    for name in ("velocity_mps", "quat_xyzw", "accel_bias_mps2", "gyro_bias_radps"):
        np.testing.assert_array_equal(state[name], before[name])
    others = np.delete(np.arange(15), Z)
    np.testing.assert_array_equal(state.position_m[:2], before.position_m[:2])
    np.testing.assert_array_equal(state.P[np.ix_(others, others)], before.P[np.ix_(others, others)])


def off_the_floor(above_m, sd_m=0.05):
    """Return a foot that is so much above a floor that is exactly known."""
    state = random_state(np.random.default_rng(3))
    state.P[:] = np.eye(15) * sd_m**2
    state.floor_m = state.position_m[Z] - above_m
    return state


def test_a_stance_tells_once_what_its_calmest_sample_tells():
    often, once = off_the_floor(0.05), off_the_floor(0.05)
    for sd_mps in (0.4, 0.1, 0.1, CALM_MPS, CALM_MPS, CALM_MPS, 0.2):
        stand_on_floor(sd_mps, SETTINGS, often)
        often.position_m[Z] = 0.0  # only the covariance is compared: both feet stay where they are
        often.floor_m = -0.05
    stand_on_floor(CALM_MPS, SETTINGS, once)
    assert often.P[Z, Z] == pytest.approx(once.P[Z, Z], rel=1e-9)
    assert often.P[Z, Z] == pytest.approx(1.0 / (1.0 / 0.05**2 + floor.information(CALM_MPS, FLOOR_SD_M)))


@pytest.mark.parametrize("above_m", [0.01, -0.07, 0.079, 0.09, -0.17, 0.34])
def test_half_a_riser_parts_the_floors(above_m):
    state = off_the_floor(above_m)
    before_m, floor_m = state.position_m[Z], state.floor_m
    stand_on_floor(CALM_MPS, SETTINGS, state)
    stand(0, state)
    begin_next(state)
    floor.settle(FLOOR_SD_M, state)
    same = abs(above_m) <= SETTINGS.floor_limit_m
    assert (state.floor_m == floor_m) == same
    assert (state.position_m[Z] == before_m) != same
    assert abs(state.position_m[Z] - before_m) < SETTINGS.floor_limit_m
    assert same or state.floor_m == before_m


def test_a_foot_that_still_climbs_past_the_old_floor_comes_to_stand_on_a_new_one():
    state = off_the_floor(0.05, 0.01)
    stand_on_floor(0.5, SETTINGS, state)
    assert state.floor_told > 0.0
    assert abs(state.position_m[Z] - state.floor_m - 0.05) < 0.001
    state.position_m[Z] = state.floor_m + 0.17
    stand_on_floor(CALM_MPS, SETTINGS, state)
    stand(0, state)
    begin_next(state)
    floor.settle(FLOOR_SD_M, state)
    assert state.floor_m == state.position_m[Z]


def standing_filter():
    """Return a filter that has stood, gone through a swing, and stood again, so that it has a floor."""
    f = ZuptFilter(LEVEL.filter, PlaceParams())
    for start_ns in (0, 2 * 10**9):
        f.run(judged(standing(1.0, start_ns=start_ns), np.ones(200, bool)))
        f.run(judged(standing(1.0, start_ns=start_ns + 10**9), np.zeros(200, bool)))
    return f


def test_the_first_stance_shows_the_first_floor():
    assert standing_filter().state.floor_m == pytest.approx(0.0, abs=1e-6)


def test_a_swing_carries_the_floor_like_the_end_of_the_stance_that_showed_it():
    f = ZuptFilter(LEVEL.filter, PlaceParams())
    f.run(judged(standing(1.0), np.ones(200, bool)))
    f.run(judged(standing(1.0, start_ns=10**9), np.zeros(200, bool)))
    assert f.state.floor_m == f.state.end_position_m[0, Z]
    np.testing.assert_array_equal(f.state.floor_cross[:, 0], f.state.cross[:, Z])


def test_a_gap_forgets_the_floor_and_the_next_stance_shows_one():
    f = standing_filter()
    f.run(judged(standing(0.01, start_ns=9 * 10**9), np.zeros(2, bool)))
    assert np.isnan(f.state.floor_m)
    f.state.position_m[Z] = 0.05
    f.run(judged(standing(0.5, start_ns=9 * 10**9 + 10_000_000), np.ones(100, bool)))
    f.run(judged(standing(0.5, start_ns=9 * 10**9 + 510_000_000), np.zeros(100, bool)))
    assert f.state.floor_m == pytest.approx(0.05, abs=0.01)


def test_a_reset_forgets_the_floor():
    f = standing_filter()
    f.reset(f.handover)
    assert np.isnan(f.state.floor_m)


@pytest.mark.parametrize("climb_m", [0.0, 0.34])
def test_a_doubted_estimate_neither_flattens_a_stair_nor_leaves_the_floor(climb_m):
    f = standing_filter()
    f.state.position_m[Z] += climb_m
    f.state.velocity_mps[:] = [3.0, 0.0, 0.0]
    f.run(judged(standing(0.5, start_ns=4 * 10**9), np.ones(100, bool)))
    f.run(judged(standing(0.5, start_ns=4 * 10**9 + 500_000_000), np.zeros(100, bool)))
    assert f.state.doubted == 1
    assert f.state.floor_m == pytest.approx(climb_m, abs=0.1 if climb_m else 1e-6)
    assert f.state.end_position_m[0, Z] == pytest.approx(climb_m, abs=0.1)

from itertools import pairwise

import numpy as np
import pytest
from filter_cases import judged, moved, random_state, standing, transition
from scipy.spatial.transform import Rotation
from test_eskf_filter import JUDGED, STANCE_ENDS, WALK, fresh

from pdr_core.eskf.configure import settings
from pdr_core.eskf.process import carry, noise, propagate_covariance
from pdr_core.eskf.step_events import begin_next, roam, stand
from pdr_core.eskf.updates import correct_heading, zero_velocity
from pdr_core.params import FilterParams, PlaceParams
from pdr_core.records import joined, part

SETTINGS = settings(FilterParams(), PlaceParams())


def walked():
    f = fresh()
    nav, steps = f.run(JUDGED)
    return nav, steps + f.finish()


def test_a_walk_of_ten_strides_has_ten_steps():
    _, steps = walked()
    assert [s.index for s in steps] == list(range(1, 11))
    np.testing.assert_array_equal([s.stamp_ns for s in steps[:-1]], WALK.imu.stamp_ns[STANCE_ENDS[1:]])
    assert steps[-1].stamp_ns == WALK.imu.stamp_ns[-1]
    assert all(a.stamp_ns == b.start_ns for a, b in pairwise(steps))
    np.testing.assert_allclose([s.length_m for s in steps], 1.2, atol=0.05)


def test_the_displacements_add_up_to_the_end_position():
    nav, steps = walked()
    start = nav.position_m[STANCE_ENDS[0]]
    np.testing.assert_allclose(start + sum(s.displacement_m for s in steps), nav.position_m[-1], atol=1e-12)
    np.testing.assert_allclose(steps[-1].position_m, nav.position_m[-1])


def test_the_first_stance_is_no_step():
    f = fresh()
    assert f.run(part(JUDGED, 0, STANCE_ENDS[0] + 150))[1] == []
    assert fresh().finish() == []


def test_a_short_interruption_belongs_to_the_stance():
    stance = WALK.motion.stance.copy()
    stance[820:860] = False  # .2 s of the stance before the second swing
    broken = judged(JUDGED.imu, stance & WALK.motion.stance)
    f = fresh()
    steps = f.run(broken)[1] + f.finish()
    assert len(steps) == 10


def standing_events(*events):
    """Let the true foot do (what it is away from its place [m], turn about the vertical [rad]); return the steps."""
    f = fresh()
    f.run(judged(standing(1.0), np.ones(200, bool)))
    taken, now_ns = [], int(f.state.last_ns)
    for away_m, turn_rad in events:
        now_ns += 400_000_000
        f.state.position_m[0] += away_m
        roam(f.state)
        f.state.position_m[0] -= away_m
        f.state.quat_xyzw[:] = (Rotation.from_euler("z", turn_rad) * Rotation.from_quat(f.state.quat_xyzw)).as_quat()
        taken += f.run(judged(standing(0.5, start_ns=now_ns), np.ones(100, bool)))[1]
        now_ns = int(f.state.last_ns)
    return taken + f.finish()


def test_a_person_who_fidgets_takes_no_step():
    assert standing_events((0.03, 0.1), (0.0, -0.2), (0.04, 0.0)) == []


@pytest.mark.parametrize("step", [(0.1, 0.0), (0.0, 0.6), (0.0, -1.5)])
def test_a_step_on_the_spot_and_a_turn_on_the_spot_are_steps(step):
    fidget = (0.02, 0.05)
    steps = standing_events(fidget, step, fidget)
    assert [s.index for s in steps] == [1]
    assert steps[0].length_m < 0.05


def test_steps_do_not_depend_on_how_the_stream_is_cut():
    f, g = fresh(), fresh()
    whole = f.run(JUDGED)
    pieces = [g.run(part(JUDGED, i, i + 37)) for i in range(0, len(JUDGED.stance), 37)]
    steps = [step for piece in pieces for step in piece[1]]
    for a, b in zip(whole[0], joined([p[0] for p in pieces]), strict=True):
        np.testing.assert_array_equal(a, b)
    assert [repr(s) for s in steps] == [repr(s) for s in whole[1]]


def dense_update(P, H, R, rows):
    """Update like the filter: the gain of the error rows alone, none for gyro bias and for the remembered position.

    The gain is that of a known yaw, and the place moves as the displacement since the remembered one does.
    """
    displaced = np.eye(18)
    displaced[:2, 15:17] = -np.eye(2)
    given_yaw = P - np.outer(P[:, 8], P[8]) / P[8, 8]
    K = np.where(rows[:, None], displaced @ given_yaw @ H.T @ np.linalg.inv(H @ given_yaw @ H.T + R), 0.0)
    rest = np.eye(len(P)) - K @ H
    return rest @ P @ rest.T + K @ R @ K.T


@pytest.mark.parametrize("seed", range(5))
def test_the_covariance_of_a_displacement_is_that_of_a_filter_with_a_cloned_state(seed):
    rng = np.random.default_rng(seed)
    state = random_state(rng)
    stand(0, state)
    begin_next(state)
    P = np.block([[state.P, state.P[:, :3]], [state.P[:3], state.P[:3, :3]]])  # 15 errors and the cloned position
    H, R = np.eye(18)[3:6], SETTINGS.zero_velocity_sd_mps**2 * np.eye(3)
    rows = np.arange(18) < 12
    for k in range(60):
        _, link = moved(state, rng.uniform(-5, 5, 3), rng.uniform(-20, 20, 3), rng.uniform(-20, 20, 3), 0.01)
        q = noise(0.2, 0.01, 0.01, SETTINGS.process)
        F = np.eye(18)
        F[:15, :15] = transition(link)
        P = F @ P @ F.T + np.diag([*q, 0, 0, 0])
        propagate_covariance(state.P, link, q)
        carry(link, state.cross)
        if k % 20 >= 10:
            state.velocity_mps[:] = 0.0
            assert zero_velocity(k, state.gyro_bias_radps, SETTINGS.zero_velocity_sd_mps, SETTINGS, state)
            P = dense_update(P, H, R, rows)
        if k % 20 == 5:
            correct_heading(0.01, 0.05, state)
            P = P - np.outer(P[:, 8], P[8]) / (P[8, 8] + 0.05**2)
    stand(10**9, state)
    difference = np.hstack([np.eye(3), np.zeros((3, 12)), -np.eye(3)])
    np.testing.assert_allclose(state.displacement_covariance, difference @ P @ difference.T, rtol=1e-7, atol=1e-12)
    np.testing.assert_allclose(state.P, P[:15, :15], rtol=1e-7, atol=1e-12)


def test_a_heading_turns_the_last_stance_end_along_with_the_foot():
    state = random_state(np.random.default_rng(2))
    stand(0, state)
    begin_next(state)
    at_the_end = state.end_position_m[0].copy()
    state.P[6:9] *= 3.0  # the yaw has drifted since, and all that goes with it
    state.P[:, 6:9] *= 3.0
    state.cross[6:9] *= 3.0
    before, gain = state.position_m.copy(), state.P[:, 8] / (state.P[8, 8] + 0.1**2)
    gain_of_end = state.cross[8, :3] / (state.P[8, 8] + 0.1**2)
    correct_heading(0.02, 0.1, state)
    np.testing.assert_allclose(state.position_m - before, -0.02 * gain[:3], atol=1e-12)
    np.testing.assert_allclose(state.end_position_m[0] - at_the_end, -0.02 * gain_of_end, atol=1e-12)


def test_a_stance_leaves_the_track_before_it_alone():
    """What a stance tells of a turn must not swing a far foot round the start of the walk."""
    state = random_state(np.random.default_rng(4))
    state.P[:] = np.diag(np.repeat([1e-4, 1e-6, 1e-6, 1e-6, 1e-8], 3))
    state.P[0, 8] = state.P[8, 0] = -0.9 * 1e-2 * 1e-3  # of a walk along y: the position goes with the yaw
    state.P[3, 8] = state.P[8, 3] = -0.9 * 1e-3 * 1e-3  # and so does the velocity of a swing
    state.P[0, 3] = state.P[3, 0] = 0.99 * 1e-2 * 1e-3  # both by more than the yaw alone
    stand(0, state)
    begin_next(state)
    before = state.position_m.copy()
    state.velocity_mps[:] = [0.001, 0.0, 0.0]
    zero_velocity(1, state.gyro_bias_radps, SETTINGS.zero_velocity_sd_mps, SETTINGS, state)
    np.testing.assert_allclose(state.position_m, before, atol=1e-12)


def test_a_displacement_is_known_better_than_the_difference_of_two_positions():
    nav, steps = walked()
    last, position = steps[-1].displacement_covariance_m2[1, 1], nav.pose_covariance[-1, 1, 1]
    assert last < 0.1 * position  # the difference of the last two positions, taken as independent, would be 1.8 of it


def test_the_heading_deviation_is_that_across_the_step():
    step = walked()[1][3]
    assert step.heading_rad == pytest.approx(0.0, abs=0.05)
    assert step.heading_sd_rad == pytest.approx(np.sqrt(step.displacement_covariance_m2[1, 1]) / 1.2, rel=0.05)

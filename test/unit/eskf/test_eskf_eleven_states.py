"""The filter of 11 states (paper 004, eq. 1-3), beside one written from these equations alone."""

import numpy as np
import pytest
from filter_cases import G, covariance, random_state
from scipy.spatial.transform import Rotation

from pdr_core.eskf import ZuptFilter, zupt
from pdr_core.eskf.eleven_states import YAW, estimated, take_rest, turn_back
from pdr_core.eskf.process import link, propagate_covariance
from pdr_core.eskf.updates import apply
from pdr_core.maths.kalman import gain, innovation
from pdr_core.params import Params, changed
from pdr_core.records import HeadingObservation, HeadingSource, joined
from pdr_core.stance import StanceDetection
from support.walks import straight_walk

RNG = np.random.default_rng(8)
KEPT = np.array([0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11])  # of the 15: position, velocity, tilt, accelerometer bias
HELD = np.setdiff1d(np.arange(15), KEPT)


def transition(R_world_from_foot, force_world_mps2, dt_s):
    """Return F (11, 11) as eq. 2 has it, with our signs: errors are truth minus estimate."""
    f = force_world_mps2
    S = np.array([[0, -f[2], f[1]], [f[2], 0, -f[0]], [-f[1], f[0], 0]])
    F = np.eye(11)
    F[0:3, 3:6] = dt_s * np.eye(3)
    F[3:6, 6:8] = -dt_s * S[:, :2]
    F[3:6, 8:11] = -dt_s * R_world_from_foot
    return F


def test_the_covariance_grows_as_in_eq_2():
    dt_s = 1e-4  # eq. 2 is of the first order
    for _ in range(10):
        R, force, P = Rotation.random(random_state=RNG).as_matrix(), RNG.normal([0, 0, G], 3.0), covariance(RNG)
        P[HELD], P[:, HELD] = 0.0, 0.0
        q = np.where(np.isin(np.arange(15), HELD), 0.0, 1e-8)
        F = transition(R, R @ force, dt_s)
        expected = F @ P[np.ix_(KEPT, KEPT)] @ F.T + 1e-8 * np.eye(11)
        propagate_covariance(P, link(R, R, force, force, dt_s, 1e9), q)
        assert P[np.ix_(KEPT, KEPT)] == pytest.approx(expected, abs=1e-9, rel=1e-5)
        assert not P[HELD].any()


def test_a_zero_velocity_corrects_as_with_eq_3():
    for _ in range(10):
        state, residual, R = random_state(RNG), 0.01 * RNG.standard_normal(3), 1e-4 * np.eye(3)
        state.P[HELD], state.P[:, HELD] = 0.0, 0.0
        P, bias, position_m = state.P[np.ix_(KEPT, KEPT)], state.gyro_bias_radps.copy(), state.position_m.copy()
        H = np.hstack([np.zeros((3, 3)), np.eye(3), np.zeros((3, 5))])
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        y = innovation(state.P, zupt.H, R, residual)
        apply(y, zupt.H, gain(y), state)
        assert state.P[np.ix_(KEPT, KEPT)] == pytest.approx((np.eye(11) - K @ H) @ P, abs=1e-9)
        assert state.position_m == pytest.approx(position_m + (K @ residual)[:3])
        assert not state.P[HELD].any()
        assert np.array_equal(state.gyro_bias_radps, bias)


def run(error_rad_of, **changes):
    """Run a filter over a walk with feedback; `error_rad_of` gives the yaw error told at each step."""
    params = changed(Params(), "filter", heading_states=False, heading_feedback=True, **changes)
    stance, chain = StanceDetection(params.stance, params.place), ZuptFilter(params.filter, params.place)
    judged = joined([stance.run(straight_walk(8).imu), stance.finish()])
    nav, steps = chain.run(judged)
    navs, taken = [nav], list(steps)
    while steps:
        for s in steps:
            error_rad = error_rad_of(s)
            source = HeadingSource.OTHER_FOOT if error_rad else HeadingSource.NONE
            chain.answer(HeadingObservation(s.index, s.stamp_ns, s.answer_due_ns, source, error_rad, 0.1))
        nav, steps = chain.resume()
        navs.append(nav)
        taken += steps
    return joined(navs), taken, chain


def test_what_is_no_state_stays_certain_all_the_way():
    _, steps, chain = run(lambda _: 0.0)
    assert len(steps) > 5
    assert not chain.state.P[HELD].any()
    assert chain.state.gyro_bias_radps.any()  # of the rest
    assert all(s.yaw_sd_rad == 0.0 for s in steps)


def test_a_heading_is_taken_whole_and_turns_what_follows():
    before, steps, _ = run(lambda _: 0.0)
    after, _, chain = run(lambda s: 0.3 if s.index == 4 else 0.0)
    due_ns = steps[3].answer_due_ns
    first = int(np.searchsorted(before.stamp_ns, due_ns))
    assert np.array_equal(before.position_m[:first], after.position_m[:first])
    moved = [nav.position_m[-1] - nav.position_m[first] for nav in (before, after)]
    assert moved[1] == pytest.approx(Rotation.from_euler("z", -0.3).apply(moved[0]), abs=0.02)
    assert not chain.state.P[HELD].any()


def test_the_first_rest_takes_back_what_its_bias_has_turned():
    state, bias_radps = random_state(RNG), 0.01
    state.gyro_bias_radps[:] = 0.0
    state.quat_xyzw[:] = [0.0, 0.0, np.sin(0.01), np.cos(0.01)]  # 2 s at that rate
    state.alignment_start_ns, state.last_ns = 0, 2_000_000_000
    take_rest((0.0, 0.0, bias_radps), 1e-9, 0.0035, state)
    assert state.quat_xyzw == pytest.approx([0, 0, 0, 1], abs=1e-6)
    assert state.gyro_bias_radps == pytest.approx([0, 0, bias_radps], rel=1e-6)
    take_rest((0.0, 0.0, 0.02), 0.0035, 0.0035, state)
    assert state.gyro_bias_radps[2] == pytest.approx(0.01, rel=1e-6)  # as much as sensors usually bring


def test_turning_back_turns_foot_and_velocity():
    state = random_state(RNG)
    attitude, velocity = Rotation.from_quat(state.quat_xyzw), state.velocity_mps.copy()
    turn_back(0.4, state)
    turn = Rotation.from_euler("z", -0.4)
    assert (turn * attitude).as_matrix() == pytest.approx(Rotation.from_quat(state.quat_xyzw).as_matrix())
    assert state.velocity_mps == pytest.approx(turn.apply(velocity))


def test_a_gap_and_another_start_leave_no_yaw_error():
    sd = estimated(np.ones(15), heading_states=False)
    assert sd.tolist() == [1.0] * 8 + [0.0] + [1.0] * 3 + [0.0] * 3
    assert estimated(np.ones(15), heading_states=True).all()
    assert YAW == 8

"""The feedback of eq. 10-12: its sign, its rate, and that the printed one runs away."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.chest.correction import error, feed_back, level_anew
from pdr_core.chest.state import fresh_state

UP = np.array([0.0, 0.0, 1.0])
STEP_S = 0.01


def state_with(attitude):
    state = fresh_state()
    state.quat_xyzw[:] = attitude.as_quat()
    return state


def tilted(angle_rad, seed=0):
    """A true attitude, and an estimate that is turned too far about a level axis of the world."""
    rng = np.random.default_rng(seed)
    true, direction = Rotation.random(random_state=seed), rng.uniform(0.0, 2.0 * np.pi)
    off = Rotation.from_rotvec(angle_rad * np.array([np.cos(direction), np.sin(direction), 0.0]))
    return true, off * true


def test_the_error_is_minus_the_level_tilt_error():
    for seed in range(5):
        true, estimate = tilted(0.01, seed)
        p = (estimate * true.inv()).as_rotvec()
        force = estimate.apply(true.inv().apply(9.81 * UP))
        assert np.allclose(error(tuple(force)), -p * [1.0, 1.0, 0.0], atol=1e-6)


@pytest.mark.parametrize("gain", [0.2, 1.0])
def test_the_tilt_dies_away_with_the_time_constant_1_by_k(gain):
    true, estimate = tilted(0.1)
    state, seconds = state_with(estimate), 1.0 / gain
    for _ in range(round(seconds / STEP_S)):
        attitude = Rotation.from_quat(state.quat_xyzw)
        feed_back(error(tuple(attitude.apply(true.inv().apply(9.81 * UP)))), gain, 0, state)
        state.quat_xyzw[:] = (attitude * Rotation.from_rotvec(state.feedback_radps * STEP_S)).as_quat()
    left = (Rotation.from_quat(state.quat_xyzw) * true.inv()).magnitude()
    assert left == pytest.approx(0.1 * np.exp(-1.0), rel=0.02)


def test_the_printed_feedback_runs_to_180_degrees():
    """Cheng eq. 5, 7, 11 and 12 as they stand: e = g_n x f, alpha = C K e, w - alpha."""
    gravity = -9.81 * UP
    for seed in range(3):
        _, estimate = tilted(0.01, seed)
        estimate = estimate * tilted(0.0, seed)[0].inv()  # of a chest that is level in truth, where C and its transpose
        for _ in range(4000):  # differ least
            force = estimate.apply(-gravity)
            alpha = estimate.apply(0.01 * np.cross(gravity, force))
            estimate = estimate * Rotation.from_rotvec(-alpha * STEP_S)
        assert np.degrees(estimate.magnitude()) > 175.0


@pytest.mark.parametrize("angle_deg", [0.5, 20.0, 89.0, 120.0, 179.0])
def test_levelling_anew_takes_back_any_tilt_and_no_yaw(angle_deg):
    true, estimate = tilted(np.radians(angle_deg))
    state = state_with(estimate)
    level_anew(tuple(estimate.apply(true.inv().apply(9.81 * UP))), state)
    left = Rotation.from_quat(state.quat_xyzw) * true.inv()
    assert left.magnitude() == pytest.approx(0.0, abs=1e-6)

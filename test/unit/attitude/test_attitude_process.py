"""Transition and Jacobians of the quaternion filter against finite differences, and the slips of Qiu eq. 7-16."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.attitude import gravity
from pdr_core.attitude.process import exponential_jacobian, from_the_left, from_the_right, transition, turn
from pdr_core.attitude.settings import settings
from pdr_core.attitude.sphere import corrected, rotation_covariance, rotation_jacobian, spread, tangents
from pdr_core.attitude.state import fresh_state
from pdr_core.maths.quaternion import from_rotation_vector, multiply
from pdr_core.params import Params

STEP = 1e-6
SETTINGS = settings(Params())
QIU = [3, 0, 1, 2]  # his real part comes first


def random_state(seed):
    rng = np.random.default_rng(seed)
    state = fresh_state()
    state.quat_xyzw[:] = Rotation.random(random_state=rng).as_quat()
    state.gyro_bias_radps[:] = rng.uniform(-0.05, 0.05, 3)
    A = rng.standard_normal((7, 7)) * 1e-2
    tangent = np.eye(7)
    tangent[:4, :4] -= np.outer(state.quat_xyzw, state.quat_xyzw)
    state.P[:] = tangent @ A @ A.T @ tangent
    state.aligning = False
    return state, rng


def moved(x, rate, dt):
    """The step that `process.py` derives, of any vector of seven, of unit length or not."""
    return np.concatenate([multiply(x[:4], from_rotation_vector((rate - x[4:]) * dt)), x[4:]])


def derivative(f, x):
    return np.column_stack([(f(x + STEP * e) - f(x - STEP * e)) / (2 * STEP) for e in np.eye(len(x))])


@pytest.mark.parametrize("dt", [0.001, 0.005, 0.05])
@pytest.mark.parametrize("seed", range(5))
def test_the_transition_is_the_derivative_of_the_step(seed, dt):
    state, rng = random_state(seed)
    rate = rng.uniform(-15.0, 15.0, 3)
    x = np.concatenate([state.quat_xyzw, state.gyro_bias_radps])
    F = transition(x[:4], tuple((rate - x[4:]) * dt), dt)
    np.testing.assert_allclose(F, derivative(lambda y: moved(y, rate, dt), x), atol=1e-8)


@pytest.mark.parametrize("turn_rad", [(0.0, 0.0, 0.0), (1e-6, -2e-6, 0.0), (1e-3, 0.0, 2e-3), (0.5, -1.2, 2.0)])
def test_the_exponential_has_this_derivative_near_zero_too(turn_rad):
    numeric = derivative(lambda f: np.array(from_rotation_vector(f)), np.array(turn_rad))
    np.testing.assert_allclose(exponential_jacobian(turn_rad), numeric, atol=1e-9)


def test_products_from_both_sides():
    p, q = (Rotation.random(random_state=s).as_quat() for s in (1, 2))
    np.testing.assert_allclose(from_the_right(p) @ q, multiply(q, p), atol=1e-15)
    np.testing.assert_allclose(from_the_left(p) @ q, multiply(p, q), atol=1e-15)


def eq_13(q, rate):
    """Eq. 13 as printed; rate without bias, q with its real part first."""
    w1, w2, w3 = rate
    q0, q1, q2, q3 = q
    A = np.zeros((7, 7))
    A[:4, :4] = [[0, -w1, -w2, -w3], [w1, 0, w3, -w2], [w2, -w3, 0, w1], [w3, w2, -w1, 0]]
    A[:4, 4:] = [[q1, q2, q3], [-q0, q3, -q2], [-q3, -q0, q1], [q2, -q1, -q0]]
    return A / 2


def test_the_transition_begins_like_qius_a_but_is_not_it():
    state, rng = random_state(3)
    rate, order = rng.uniform(-3.0, 3.0, 3), [*QIU, 4, 5, 6]
    A = eq_13(state.quat_xyzw[QIU], rate)
    dt = 1e-5
    F = transition(state.quat_xyzw, tuple(rate * dt), dt)[np.ix_(order, order)]
    np.testing.assert_allclose((F - np.eye(7)) / dt, A, atol=1e-3)
    assert np.abs(A @ np.eye(7) @ A.T)[4:].max() == 0.0  # eq. 15: the variance of the bias is gone after a sample


def test_eq_7_lacks_a_half_and_has_the_sign_of_its_block_wrong():
    q, w = Rotation.random(random_state=4).as_quat(), np.array([0.3, -0.7, 1.1])
    true = (np.array(multiply(q, from_rotation_vector(w * STEP))) - q) / STEP
    cross = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    as_printed = np.vstack([np.column_stack([cross, w]), [*-w, 0.0]])
    mended = 0.5 * np.vstack([np.column_stack([-cross, w]), [*-w, 0.0]])
    np.testing.assert_allclose(mended @ q, true, atol=1e-6)
    assert np.linalg.norm(as_printed @ q - true) > 0.3
    assert np.linalg.norm(0.5 * as_printed @ q - true) > 0.3


@pytest.mark.parametrize("seed", range(5))
def test_h_is_the_derivative_of_the_expected_force(seed):
    q, g = Rotation.random(random_state=seed).as_quat(), 9.81
    H = gravity.jacobian(q, g)
    for axis in np.eye(3):  # along the sphere; off it no form is better than another

        def after(angle, axis=axis):
            return gravity.expected(np.array(multiply(from_rotation_vector(angle * axis), q)), g)

        numeric = (after(STEP) - after(-STEP)) / (2 * STEP)
        np.testing.assert_allclose(H[:, :4] @ tangents(q) @ axis / 2.0, numeric, atol=1e-7)
    assert np.all(H[:, 4:] == 0.0)


def test_h_is_eq_14_and_h_x_is_twice_what_eq_16_needs():
    q, g = Rotation.random(random_state=7).as_quat(), 9.81
    q0, q1, q2, q3 = q[QIU]
    eq_14 = g * 2 * np.array([[-q2, q3, -q0, q1], [q1, q0, q3, q2], [q0, -q1, -q2, q3]])
    H = gravity.jacobian(q, g)
    np.testing.assert_allclose(H[:, :4][:, QIU], eq_14, atol=1e-14)
    np.testing.assert_allclose(Rotation.from_quat(q).inv().apply([0, 0, g]), gravity.expected(q, g), atol=1e-14)
    np.testing.assert_allclose(H[:, :4] @ q, 2.0 * gravity.expected(q, g), atol=1e-13)


@pytest.mark.parametrize("seed", range(3))
def test_errors_of_the_quaternion_are_rotations_about_the_worlds_axes(seed):
    state, rng = random_state(seed)
    angle = rng.uniform(-1e-6, 1e-6, 3)
    error = np.zeros(7)
    error[:4] = multiply(from_rotation_vector(angle), state.quat_xyzw) - state.quat_xyzw
    np.testing.assert_allclose(rotation_jacobian(state.quat_xyzw) @ error, angle, atol=1e-12)
    state.P[:] = 0.0
    spread(np.array([1e-4, 4e-4, 9e-4]), state)
    np.testing.assert_allclose(rotation_covariance(state), np.diag([1e-4, 4e-4, 9e-4]), atol=1e-18)
    np.testing.assert_allclose(state.P[:4, :4] @ state.quat_xyzw, 0.0, atol=1e-18)


@pytest.mark.parametrize("seed", range(3))
def test_a_correction_stays_on_the_sphere_and_takes_the_covariance_along(seed):
    state, rng = random_state(seed)
    before, error = np.concatenate([state.quat_xyzw, state.gyro_bias_radps]), 0.1 * rng.standard_normal(7)
    P = state.P.copy()

    def result(x):
        y = x + error
        return np.concatenate([y[:4] / np.linalg.norm(y[:4]), y[4:]])

    J = derivative(result, before)
    corrected(error, state)
    np.testing.assert_allclose(np.linalg.norm(state.quat_xyzw), 1.0, atol=1e-15)
    np.testing.assert_allclose(state.P, J @ P @ J.T, atol=1e-10)
    np.testing.assert_allclose(state.P[:4, :4] @ state.quat_xyzw, 0.0, atol=1e-15)


def test_white_noise_of_the_rate_spreads_the_attitude_and_no_more():
    state, _ = random_state(1)
    state.P[:] = 0.0
    for _ in range(100):
        turn((1.0, -2.0, 0.5), 0.02, 0.01, SETTINGS, state)
    np.testing.assert_allclose(rotation_covariance(state), np.eye(3) * 100 * (0.02 * 0.01) ** 2, rtol=1e-5, atol=1e-12)

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.strapdown.mechanisation import advance, mean_rate

G = 9.81
UP = np.array([0.0, 0.0, G])


def integrated(rate_radps, force_mps2, duration_s, steps):
    """Integrate a rate and a force, functions of time in the foot frame, from rest at the origin."""
    position, velocity, quat, dt = np.zeros(3), np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), duration_s / steps
    for k in range(steps):
        a, b = k * dt, (k + 1) * dt
        advance(position, velocity, quat, rate_radps((a + b) / 2), force_mps2(a), force_mps2(b), dt, G)
    return position, velocity, Rotation.from_quat(quat)


def test_a_constant_force_gives_half_a_t_squared_exactly():
    accel = np.array([0.3, -0.2, 0.1])
    position, velocity, _ = integrated(lambda _: np.zeros(3), lambda _: accel + UP, 2.0, 7)
    np.testing.assert_allclose(position, accel * 2.0, atol=1e-13)
    np.testing.assert_allclose(velocity, accel * 2.0, atol=1e-13)


def test_a_constant_rate_turns_exactly_however_long_the_steps():
    rate = np.array([0.7, -1.1, 2.0])
    *_, attitude = integrated(lambda _: rate, lambda _: np.zeros(3), 3.0, 4)
    assert (attitude.inv() * Rotation.from_rotvec(3.0 * rate)).magnitude() < 1e-13


def test_a_circle_at_constant_rate_and_force_has_a_closed_form():
    w, a, t = 2.0, 1.5, 1.0  # a along the turning x axis: v = a/w (sin, 1 - cos), p = a/w^2 (1 - cos, wt - sin)
    velocity_true = a / w * np.array([np.sin(w * t), 1 - np.cos(w * t), 0])
    position_true = a / w**2 * np.array([1 - np.cos(w * t), w * t - np.sin(w * t), 0])
    errors = []
    for steps in (100, 200):
        position, velocity, _ = integrated(lambda _: np.array([0, 0, w]), lambda _: np.array([a, 0, G]), t, steps)
        errors.append([np.linalg.norm(position - position_true), np.linalg.norm(velocity - velocity_true)])
    assert np.max(errors[1]) < 2e-5
    np.testing.assert_allclose(np.array(errors[0]) / errors[1], 4.0, rtol=0.05)  # second order


def test_a_motion_that_returns_comes_back():
    def rate(t):
        return 3.0 * np.cos(2 * np.pi * t) * np.array([0.2, -1.0, 0.5]) / np.linalg.norm([0.2, -1.0, 0.5])

    def attitude(t):
        return Rotation.from_rotvec(rate(t - 0.25) / (2 * np.pi))

    def force(t):
        world = np.array([np.cos(2 * np.pi * t), np.cos(4 * np.pi * t), -np.cos(2 * np.pi * t)])
        return attitude(t).inv().apply(world + UP)

    position, velocity, final = integrated(rate, force, 1.0, 20_000)
    assert np.linalg.norm(velocity) < 1e-6
    assert np.linalg.norm(position) < 1e-6
    assert final.magnitude() < 1e-9


def zhou_as_printed(position, velocity, accel, dt):
    """Zhou eq. 1: the updated velocity moves the position, and a dt^2 / 2 comes on top."""
    velocity = velocity + accel * dt
    return position + velocity * dt + accel * dt**2 / 2, velocity


@pytest.mark.parametrize("steps", [10, 100])
def test_zhous_equation_1_counts_the_acceleration_twice(steps):
    dt, position, velocity, zhou, v = 1.0 / steps, np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    quat, accel = np.array([0.0, 0.0, 0.0, 1.0]), np.array([2.0, 0.0, 0.0])
    for _ in range(steps):
        advance(position, velocity, quat, np.zeros(3), accel + UP, accel + UP, dt, G)
        zhou, v = zhou_as_printed(zhou, v, accel, dt)
    assert position[0] == pytest.approx(1.0, abs=1e-12)  # a t^2 / 2
    assert zhou[0] - position[0] == pytest.approx(accel[0] * dt, abs=1e-12)  # one a dt^2 too much in every step


def test_gravity_pulls_down_and_rest_stays_at_rest():
    position, velocity, _ = integrated(lambda _: np.zeros(3), lambda _: np.array([0, 0, G]), 1.0, 10)
    np.testing.assert_array_equal(np.concatenate([position, velocity]), np.zeros(6))
    position, *_ = integrated(lambda _: np.zeros(3), lambda _: np.zeros(3), 1.0, 10)
    np.testing.assert_allclose(position, [0, 0, -G / 2])


def test_an_evenly_changing_rate_turns_by_its_mean_and_the_coning():
    before, after, dt, pieces = np.array([3.0, 0.0, 1.0]), np.array([1.0, 4.0, -2.0]), 0.02, 2000
    share = (np.arange(pieces) + 0.5) / pieces
    true = Rotation.identity()
    for s in share:
        true *= Rotation.from_rotvec((before + s * (after - before)) * dt / pieces)
    plain = (true.inv() * Rotation.from_rotvec((before + after) / 2 * dt)).magnitude()
    corrected = (true.inv() * Rotation.from_rotvec(np.array(mean_rate(before, after, dt)) * dt)).magnitude()
    assert plain > 1e-4
    assert corrected < 0.01 * plain

import numpy as np
import pytest
from filter_cases import covariance, error_of, injected, moved, random_state, transition
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.eskf.process import ProcessNoise, cross_gap, noise, propagate_covariance

SEEDS = st.integers(0, 2**32 - 1)
NOISE = ProcessNoise(1e-5, 1e-6, 3600.0, 1.5, 0.5)


def interval(rng, dt):
    """Return the measured rate and forces of one hard interval of a swing."""
    return rng.uniform(-8, 8, 3), rng.uniform(-30, 30, 3), rng.uniform(-30, 30, 3), dt


@given(SEEDS, st.sampled_from([0.001, 0.0025, 0.005, 0.01]), st.booleans())
def test_the_transition_is_the_derivative_of_the_mechanisation(seed, dt, means):
    rng = np.random.default_rng(seed)
    state, measured = random_state(rng), interval(rng, dt)
    if means:  # one force at both ends
        rate, _, force, dt = measured
        measured = rate, force, force, dt
    after, k = moved(state, *measured)
    F, steps = transition(k), np.repeat([1e-4, 1e-4, 1e-5, 1e-4, 1e-4], 3)
    for column, step in enumerate(steps):
        e = np.zeros(15)
        e[column] = step
        ahead, back = (error_of(after, moved(injected(state, s * e), *measured)[0]) for s in (1, -1))
        # mean_R stands for R times the right Jacobian of the turn: they differ by turn^2 / 12 of a gyro bias, which
        # comes in with dt (and with force dt^2 in the velocity); the central difference itself errs by step^2 / 6.
        turn, force = np.linalg.norm(measured[0]) * dt + 0.1 * dt, 60.0
        slack = turn**2 / 6 * dt * max(1.0, force * dt) if column >= 12 else 0.0
        np.testing.assert_allclose((ahead - back) / (2 * step), F[:, column], rtol=0, atol=slack + 1e-8)


@pytest.mark.parametrize(("row", "column", "sign"), [(3, 7, 1), (4, 6, -1), (3, 9, -1), (6, 12, -1)])
def test_the_signs_of_the_error_model(row, column, sign):
    state = random_state(np.random.default_rng(0))
    state.quat_xyzw[:], state.accel_bias_mps2[:], state.gyro_bias_radps[:] = [0, 0, 0, 1], 0, 0
    F = transition(moved(state, np.zeros(3), np.array([0, 0, 9.81]), np.array([0, 0, 9.81]), 0.01)[1])
    assert np.sign(F[row, column]) == sign


@given(SEEDS)
def test_the_covariance_is_carried_by_the_transition(seed):
    rng = np.random.default_rng(seed)
    _, k = moved(random_state(rng), *interval(rng, 0.005))
    P, q, F = covariance(rng), rng.uniform(0, 1e-4, 15), transition(k)
    carried = P.copy()
    propagate_covariance(carried, k, q)
    np.testing.assert_allclose(carried, F @ P @ F.T + np.diag(q), rtol=1e-12, atol=1e-14)
    assert np.array_equal(carried, carried.T)


def test_the_biases_decay_and_gui_equation_18_as_printed_would_let_them_grow():
    _, k = moved(
        random_state(np.random.default_rng(1)), np.zeros(3), np.zeros(3), np.zeros(3), 0.01, correlation_s=10.0
    )
    ours = np.linalg.matrix_power(transition(k), 10_000)  # 100 s
    np.testing.assert_allclose(np.diag(ours)[9:], np.exp(-10.0), rtol=1e-9)
    printed = (1.0 + 0.01 / 10.0) ** 10_000  # I + beta dt with +beta
    assert printed > 2e4


def test_a_bias_keeps_the_variance_of_its_markov_process():
    tau, walk, dt = 50.0, 1e-3, 0.01
    process = ProcessNoise(walk, walk, tau, 1.5, 0.5)
    _, k = moved(random_state(np.random.default_rng(1)), np.zeros(3), np.zeros(3), np.zeros(3), dt, correlation_s=tau)
    P = np.zeros((15, 15))
    for _ in range(50_000):
        propagate_covariance(P, k, noise(0.0, 0.0, dt, process))
    np.testing.assert_allclose(np.diag(P)[9:], walk**2 * tau / 2, rtol=1e-3)  # steady state of b' = -b/tau + w


def test_the_noise_grows_with_time_and_not_with_the_rate():
    def after_a_second(rate_hz):
        P, dt = np.zeros((15, 15)), 1.0 / rate_hz
        _, k = moved(random_state(np.random.default_rng(2)), np.zeros(3), np.zeros(3), np.zeros(3), dt)
        for _ in range(rate_hz):
            propagate_covariance(P, k, noise(0.01 / np.sqrt(dt), 0.001 / np.sqrt(dt), dt, NOISE))
        return np.sqrt(np.diag(P))

    slow, fast = after_a_second(100), after_a_second(800)
    np.testing.assert_allclose(slow[3:6], 0.01, rtol=0.01)
    np.testing.assert_allclose(slow[6:9], 0.001, rtol=0.01)
    np.testing.assert_allclose(slow[:3], 0.01 / np.sqrt(3), rtol=0.03)
    np.testing.assert_allclose(slow, fast, rtol=0.03)


@given(SEEDS, st.floats(0.1, 1e9))
def test_a_gap_forgets_the_velocity_and_keeps_the_covariance_positive(seed, gap_s):
    rng = np.random.default_rng(seed)
    P, cross = covariance(rng), rng.standard_normal((15, 6))
    before, cross_before = P.copy(), cross.copy()
    cross_gap(P, cross, gap_s, NOISE)
    assert np.array_equal(P, P.T)
    assert np.linalg.eigvalsh(P)[0] >= -1e-15 * np.abs(P).max()
    np.testing.assert_array_equal(P[3:6, 3:6], 1.5**2 * np.eye(3))
    assert not P[3:6, :3].any()
    assert not P[3:6, 6:].any()
    assert not cross[3:6].any()
    np.testing.assert_array_equal(np.delete(cross, [3, 4, 5], 0), np.delete(cross_before, [3, 4, 5], 0))
    grown = np.diag(P - before)
    np.testing.assert_allclose(grown[:3], 1.5**2 * gap_s * max(1.0, gap_s), rtol=1e-9)
    assert np.all(grown[6:9] <= np.pi**2 * (1 + 1e-9))
    np.testing.assert_array_equal(grown[9:], np.zeros(6))

"""States and measurements for the tests of the filter."""

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.eskf.process import carry, link
from pdr_core.eskf.state import fresh_state
from pdr_core.eskf.updates import inject
from pdr_core.records import StanceBlock, inertial_block
from pdr_core.strapdown.mechanisation import advance

G = 9.81


def random_state(rng):
    """Return a filter somewhere, with biases and a full covariance."""
    state = fresh_state()
    state.position_m[:], state.velocity_mps[:] = rng.uniform(-50, 50, 3), rng.uniform(-5, 5, 3)
    state.quat_xyzw[:] = Rotation.random(random_state=rng).as_quat()
    state.accel_bias_mps2[:], state.gyro_bias_radps[:] = rng.uniform(-0.3, 0.3, 3), rng.uniform(-0.05, 0.05, 3)
    state.P[:] = covariance(rng)
    state.gravity_mps2 = G
    state.aligning = False
    return state


def covariance(rng):
    A = rng.standard_normal((15, 15)) * np.repeat([0.3, 0.1, 0.02, 0.02, 0.003], 3)[:, None]
    return A @ A.T


def copied(state):
    other = fresh_state()
    for name in state.dtype.names:
        other[name] = state[name]
    return other


def moved(state, rate, before, after, dt, correlation_s=3600.0):
    """Move a copy of the state by one measured interval; return it and the blocks of F."""
    new = copied(state)
    w, f0, f1 = rate - new.gyro_bias_radps, before - new.accel_bias_mps2, after - new.accel_bias_mps2
    R0, R1 = advance(new.position_m, new.velocity_mps, new.quat_xyzw, tuple(w), tuple(f0), tuple(f1), dt, G)
    k = link(R0, R1, tuple(f0), tuple(f1), dt, correlation_s)
    new.accel_bias_mps2[:] *= k.bias_decay
    new.gyro_bias_radps[:] *= k.bias_decay
    return new, k


def transition(k):
    F = np.eye(15)
    carry(k, F)
    return F


def injected(state, error):
    other = copied(state)
    inject(other, error)
    return other


def error_of(estimate, truth):
    """Return the errors as `error_state.py` defines them: truth minus estimate, the turn in the world frame."""
    turn = Rotation.from_quat(truth.quat_xyzw) * Rotation.from_quat(estimate.quat_xyzw).inv()
    return np.concatenate(
        [
            truth.position_m - estimate.position_m,
            truth.velocity_mps - estimate.velocity_mps,
            turn.as_rotvec(),
            truth.accel_bias_mps2 - estimate.accel_bias_mps2,
            truth.gyro_bias_radps - estimate.gyro_bias_radps,
        ]
    )


def judged(imu, stance, rest_rate=None, rest_sd=None):
    """Return samples with given verdicts."""
    n = len(imu.stamp_ns)
    rate, sd = np.zeros((n, 3)) if rest_rate is None else rest_rate, np.zeros(n) if rest_sd is None else rest_sd
    return StanceBlock(imu, np.asarray(stance, bool), np.zeros(n), np.ones(n), np.zeros(n), rate, sd)


def standing(seconds, rate_hz=200.0, start_ns=0, gyro_sd=0.014, accel_sd=0.2):
    """Return samples of a foot at rest, without noise."""
    n = round(seconds * rate_hz)
    stamps = start_ns + np.arange(n, dtype=np.int64) * round(1e9 / rate_hz)
    force = np.tile([0.0, 0.0, G], (n, 1))
    return inertial_block(stamps, np.zeros((n, 3)), force, np.full(n, gyro_sd), np.full(n, accel_sd))

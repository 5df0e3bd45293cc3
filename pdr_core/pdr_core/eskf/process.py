"""How the errors grow from one sample to the next: transition F and noise Q (Gui eq. 12-19, Zhou eq. 7-9).

With the definitions of `error_state.py` the errors obey
    d position / dt = velocity error
    d velocity / dt = -[f x] attitude - R accel_bias + noise          (f: specific force in the world frame)
    d attitude / dt = -R gyro_bias + noise
    d bias / dt = -bias / correlation time + noise                    (first-order Markov)
Gui eq. 18 prints +beta for the Markov terms, opposite to its eq. 15-16, which would make the biases diverge, and calls
beta a time constant though it is the inverse of one. F below is the exact derivative of `mechanisation.advance`, up to
second order in the rotation within one interval; the tests compare it with finite differences.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.eskf.error_state import ACCEL_BIAS, ATTITUDE, GYRO_BIAS, POSITION, SIZE, VELOCITY
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import cross_matrix, product, rotated
from pdr_core.records import Floats


class ProcessNoise(NamedTuple):
    """What drives the errors beside the sensor's own noise."""

    accel_bias_walk: float  # [m/s^2/sqrt(s)]
    gyro_bias_walk: float  # [rad/s/sqrt(s)]
    bias_correlation_s: float
    gap_speed_mps: float
    gap_rate_radps: float


@compiled
def transition(
    R_before: Floats, R_after: Floats, force_before: Floats, force_after: Floats, dt_s: float, correlation_s: float
) -> Floats:
    """Return F, (15, 15), over one interval; forces [m/s^2] (3,) in the foot frame, without bias."""
    after = rotated(R_after, force_after)
    attitude_to_accel = -cross_matrix(0.5 * (rotated(R_before, force_before) + after))
    mean_R = 0.5 * (R_before + R_after)
    gyro_to_accel = product(cross_matrix(after), mean_R) * (0.5 * dt_s)
    decay = np.exp(-dt_s / correlation_s)
    F = np.zeros((SIZE, SIZE))
    for i in range(3):
        for error in (POSITION, VELOCITY, ATTITUDE):
            F[error + i, error + i] = 1.0
        F[ACCEL_BIAS + i, ACCEL_BIAS + i] = decay
        F[GYRO_BIAS + i, GYRO_BIAS + i] = decay
        F[POSITION + i, VELOCITY + i] = dt_s
        for j in range(3):
            for error, rate in ((POSITION, 0.5 * dt_s * dt_s), (VELOCITY, dt_s)):
                F[error + i, ATTITUDE + j] = attitude_to_accel[i, j] * rate
                F[error + i, ACCEL_BIAS + j] = -mean_R[i, j] * rate
                F[error + i, GYRO_BIAS + j] = gyro_to_accel[i, j] * rate
            F[ATTITUDE + i, GYRO_BIAS + j] = -mean_R[i, j] * dt_s
    return F


@compiled
def noise(accel_sd_mps2: float, gyro_sd_radps: float, dt_s: float, process: ProcessNoise) -> Floats:
    """Return the diagonal of Q, (15,), over one interval: white sensor noise and the drift of the biases."""
    q = np.zeros(SIZE)
    velocity_sd = accel_sd_mps2 * dt_s
    q[POSITION : POSITION + 3] = (0.5 * velocity_sd * dt_s) ** 2
    q[VELOCITY : VELOCITY + 3] = velocity_sd**2
    q[ATTITUDE : ATTITUDE + 3] = (gyro_sd_radps * dt_s) ** 2
    q[ACCEL_BIAS : ACCEL_BIAS + 3] = process.accel_bias_walk**2 * dt_s
    q[GYRO_BIAS : GYRO_BIAS + 3] = process.gyro_bias_walk**2 * dt_s
    return q


@compiled
def gap_transition() -> Floats:
    """Return F, (15, 15), across a gap: the velocity is forgotten, all else stays."""
    F = np.eye(SIZE)
    for i in range(VELOCITY, VELOCITY + 3):
        F[i, i] = 0.0
    return F


@compiled
def gap_noise(dt_s: float, process: ProcessNoise) -> Floats:
    """Return the diagonal of Q, (15,), across a gap in which a person may have walked and turned.

    The position wanders like that of a walker who takes a new direction every second; a foot may end a gap at any
    phase of its swing.
    """
    q = np.zeros(SIZE)
    q[POSITION : POSITION + 3] = process.gap_speed_mps**2 * dt_s * max(dt_s, 1.0)
    q[VELOCITY : VELOCITY + 3] = process.gap_speed_mps**2
    q[ATTITUDE : ATTITUDE + 3] = process.gap_rate_radps**2 * dt_s * max(dt_s, 1.0)
    return q

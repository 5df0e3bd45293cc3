"""How the state moves from one sample to the next, and its errors with it (Qiu eq. 7-15).

Two slips. Eq. 7 lacks the factor 1/2 that eq. 11 has; with the real part last, as here and as its rows are laid out, its
block must be -[w x]: dq/dt = q w / 2, the rate in the foot frame on the right. And eq. 15 carries the covariance with
the Jacobian A of the continuous dq/dt, which is none of the discrete step: without the identity and the interval it
would forget all of P within a sample. Over an interval dt in which the foot turns by the vector f = (w - b) dt the step
is exactly

    q <- q e(f),   e(f) = (f sin(|f|/2) / |f|, cos(|f|/2)),   b <- b,

so the transition is the product with e(f) from the right for the quaternion's errors, and q de/df (-dt) for those of the
bias, where (x, y, z, w) with n = |f|, s = sin(n/2) / n

    de/df = (s I + (cos(n/2) / 2 - s) / n^2 f f';  -s/2 f').

For small dt it is I + A dt with A of eq. 13. How the bias changes the coning term of the rate (`samples.between`) is left
out: dt/6 of a change of the rate, below a thousandth.
"""

import numpy as np

from pdr_core.attitude.settings import Settings
from pdr_core.attitude.state import GYRO_BIAS, QUATERNION, SIZE, AttitudeState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import symmetrise
from pdr_core.maths.quaternion import Quaternion, from_rotation_vector, multiply, normalised
from pdr_core.maths.vector import Vector, norm, product, scaled
from pdr_core.records import Floats


@compiled
def from_the_right(p: Quaternion) -> Floats:
    """Return the matrix (4, 4) that multiplies a quaternion (x, y, z, w) by p from the right."""
    x, y, z, w = p[0], p[1], p[2], p[3]
    return np.array([[w, z, -y, x], [-z, w, x, y], [y, -x, w, z], [-x, -y, -z, w]])


@compiled
def from_the_left(p: Quaternion) -> Floats:
    """Return the matrix (4, 4) that multiplies a quaternion by p from the left."""
    x, y, z, w = p[0], p[1], p[2], p[3]
    return np.array([[w, -z, y, x], [z, w, -x, y], [-y, x, w, z], [-x, -y, -z, w]])


@compiled
def exponential_jacobian(turn_rad: Vector) -> Floats:
    """Return de/df, (4, 3), at a rotation vector."""
    n = norm(turn_rad)
    s = np.sin(0.5 * n) / n if n > 1e-8 else 0.5
    bend = (0.5 * np.cos(0.5 * n) - s) / n**2 if n > 1e-4 else -1.0 / 24.0
    out = np.empty((4, 3))
    for i in range(3):
        for j in range(3):
            out[i, j] = bend * turn_rad[i] * turn_rad[j]
        out[i, i] += s
        out[3, i] = -0.5 * s * turn_rad[i]
    return out


@compiled
def transition(quat_xyzw: Floats, turn_rad: Vector, dt_s: float) -> Floats:
    """Return F, (7, 7), of the step that starts at the quaternion and turns by `turn_rad`, (3,), in the foot frame."""
    F = np.eye(SIZE)
    F[QUATERNION:GYRO_BIAS, QUATERNION:GYRO_BIAS] = from_the_right(from_rotation_vector(turn_rad))
    F[QUATERNION:GYRO_BIAS, GYRO_BIAS:] = product(from_the_left(quat_xyzw), exponential_jacobian(turn_rad)) * -dt_s
    return F


@compiled
def turn(rate_radps: Vector, gyro_sd_radps: float, dt_s: float, s: Settings, state: AttitudeState) -> None:
    """Move state and covariance by one interval, at a rate (3,) in the foot frame, without bias.

    White noise of the rate is a rotation noise that has no direction, so it is the same in foot and world axes, and on
    the sphere it is I - q q'.
    """
    turn_rad = scaled(dt_s, rate_radps)
    F = transition(state.quat_xyzw, turn_rad, dt_s)
    state.quat_xyzw[:] = normalised(multiply(state.quat_xyzw, from_rotation_vector(turn_rad)))
    P = product(F, product(state.P, F.T))
    q, variance = state.quat_xyzw, (0.5 * gyro_sd_radps * dt_s) ** 2
    for i in range(4):
        for j in range(4):
            P[i, j] += variance * ((i == j) - q[i] * q[j])
    for i in range(3):
        P[GYRO_BIAS + i, GYRO_BIAS + i] += s.gyro_bias_walk**2 * dt_s
    symmetrise(P)
    state.P[:] = P

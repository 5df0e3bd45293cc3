"""Unit quaternions as points of a sphere, on which their errors lie.

A small rotation t [rad] about the world's axes, q_true = Exp(t) q, moves q by G(q) t / 2 with the four by three G below.
Its columns are of unit length, orthogonal to each other and to q. So an error e of the quaternion is the rotation
t = 2 G' e, and what of e lies along q is none: the covariance of e must be nil there.
"""

import numpy as np

from pdr_core.attitude.state import GYRO_BIAS, QUATERNION, SIZE, AttitudeState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import product
from pdr_core.records import Floats


@compiled
def tangents(quat_xyzw: Floats) -> Floats:
    """Return G, (4, 3)."""
    x, y, z, w = quat_xyzw[0], quat_xyzw[1], quat_xyzw[2], quat_xyzw[3]
    return np.array([[w, z, -y], [-z, w, x], [y, -x, w], [-x, -y, -z]])


@compiled
def rotation_jacobian(quat_xyzw: Floats) -> Floats:
    """Return the Jacobian (3, 7) of the rotation error about the world's axes with respect to the state: 2 G', 0."""
    out = np.zeros((3, SIZE))
    out[:, QUATERNION:GYRO_BIAS] = 2.0 * tangents(quat_xyzw).T
    return out


@compiled
def rotation_covariance(state: AttitudeState) -> Floats:
    """Return the covariance (3, 3) [rad^2] of the rotation error about the world's axes."""
    J = rotation_jacobian(state.quat_xyzw)
    return product(J, product(state.P, J.T))


@compiled
def spread(variance_rad2: Floats, state: AttitudeState) -> None:
    """Make the attitude less certain by variances (3,) of rotations about the world's axes."""
    G = tangents(state.quat_xyzw)
    for i in range(4):
        for j in range(4):
            for k in range(3):
                state.P[i, j] += 0.25 * variance_rad2[k] * G[i, k] * G[j, k]


@compiled
def corrected(error: Floats, state: AttitudeState) -> None:
    """Add estimated errors (7,) to the state, and bring quaternion and covariance back to the sphere.

    q / |q| has the derivative (I - q q') / |q|, with q of unit length on the right: it takes what lies along q out of
    the covariance.
    """
    q = state.quat_xyzw + error[QUATERNION:GYRO_BIAS]
    size = np.sqrt(q[0] ** 2 + q[1] ** 2 + q[2] ** 2 + q[3] ** 2)
    q /= size
    J = np.eye(SIZE)
    for i in range(4):
        for j in range(4):
            J[i, j] = (J[i, j] - q[i] * q[j]) / size
    state.quat_xyzw[:] = q
    state.gyro_bias_radps[:] += error[GYRO_BIAS:]
    state.P[:] = product(J, product(state.P, J.T))

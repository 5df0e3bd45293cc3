"""Where up is: a foot that stands measures gravity alone (Qiu eq. 12, 14, 16).

Eq. 16 subtracts H g from the measured force, but the quaternion is quadratic in h(x) = C(q)' g, so H times the state is
twice that, and H times g has no meaning. The residual is the force minus h(x). With the real part last, the rows of eq.
14 read as below; they are the derivatives of the homogeneous form, w^2 + z^2 - x^2 - y^2 for the third, which agree
with those of any other form where it counts, along the sphere.

What a standing foot shows beside gravity goes on for a while: the noise of one sample is raised by how many samples
fall into that time, so that a faster sensor is not believed more.
"""

import numpy as np

from pdr_core.attitude.settings import Settings
from pdr_core.attitude.sphere import tangents
from pdr_core.attitude.state import GYRO_BIAS, QUATERNION, SIZE, AttitudeState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.levelling import ACCEL_PER_SPEED
from pdr_core.maths.quaternion import Quaternion, multiply, normalised, rows
from pdr_core.maths.vector import Vector, norm, product, scaled
from pdr_core.records import Floats


@compiled
def expected(quat_xyzw: Floats, gravity_mps2: float) -> Floats:
    """Return h(x), the specific force (3,) of a foot at rest."""
    return np.array(scaled(gravity_mps2, rows(quat_xyzw)[2]))


@compiled
def jacobian(quat_xyzw: Floats, gravity_mps2: float) -> Floats:
    """Return H, (3, 7) (eq. 14)."""
    q = 2.0 * gravity_mps2 * quat_xyzw
    x, y, z, w = q[0], q[1], q[2], q[3]
    H = np.zeros((3, SIZE))
    H[0, QUATERNION:GYRO_BIAS] = z, -w, x, -y
    H[1, QUATERNION:GYRO_BIAS] = w, z, y, x
    H[2, QUATERNION:GYRO_BIAS] = -x, -y, z, w
    return H


@compiled
def standing_sd_mps2(zero_velocity_sd_mps: float, s: Settings) -> float:
    """Return what a foot that stands so still shows beside gravity."""
    return np.hypot(s.accel_sd_mps2, ACCEL_PER_SPEED * zero_velocity_sd_mps)


@compiled
def motion_mps2(force_mps2: Vector, rate_radps: Vector, s: Settings) -> float:
    """Return what the sample itself tells of a motion: how far the force is from gravity, and how fast it turns."""
    return np.hypot(s.motion_share * (norm(force_mps2) - s.gravity_mps2), s.motion_per_rate * norm(rate_radps))


@compiled
def sample_variance(sd_mps2: float, dt_s: float, s: Settings) -> float:
    """Return the variance that one sample of many counts with."""
    return sd_mps2**2 * max(1.0, s.accel_correlation_s / dt_s)


@compiled
def stand_up(turn: Quaternion, state: AttitudeState) -> None:
    """Turn the estimate by a quaternion of the world frame; its errors turn with it."""
    before = tangents(state.quat_xyzw)
    state.quat_xyzw[:] = normalised(multiply(turn, state.quat_xyzw))
    M = np.eye(SIZE)
    M[QUATERNION:GYRO_BIAS, QUATERNION:GYRO_BIAS] = product(tangents(state.quat_xyzw), before.T)
    state.P[:] = product(M, product(state.P, M.T))

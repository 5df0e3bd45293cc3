"""The estimate as others read it: pose in the world frame, twist in the foot frame, with their covariances."""

import numpy as np

from pdr_core.eskf.error_state import ATTITUDE, GYRO_BIAS, POSITION, VELOCITY
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import matrix
from pdr_core.maths.vector import product
from pdr_core.records import Floats, NavBlock

UNKNOWN_RATE_SD_RADPS = 10.0  # of a foot whose gyro is off


def empty_nav(count: int) -> NavBlock:
    """Return room for `count` estimates."""
    return NavBlock(
        np.empty(count, np.int64),
        np.empty((count, 3)),
        np.empty((count, 4)),
        np.empty((count, 3)),
        np.empty((count, 3)),
        np.empty((count, 6, 6)),
        np.zeros((count, 6, 6)),
    )


@compiled
def write(out: NavBlock, i: int, state: FilterState) -> None:
    """Write the estimate as sample i of the output."""
    P = state.P
    rate_sd_radps = state.last_gyro_sd_radps if state.last_gyro_sd_radps >= 0.0 else UNKNOWN_RATE_SD_RADPS
    J = foot_velocity_jacobian(state.quat_xyzw, state.velocity_mps)
    velocity_covariance = product(product(J, P[VELOCITY : ATTITUDE + 3, VELOCITY : ATTITUDE + 3]), J.T)
    out.stamp_ns[i] = state.last_ns
    for j in range(4):
        out.quat_xyzw[i, j] = state.quat_xyzw[j]
    for j in range(3):
        out.position_m[i, j] = state.position_m[j]
        out.velocity_mps[i, j] = (
            J[j, 0] * state.velocity_mps[0] + J[j, 1] * state.velocity_mps[1] + J[j, 2] * state.velocity_mps[2]
        )
        out.rate_radps[i, j] = state.last_rate_radps[j] - state.gyro_bias_radps[j]
        out.twist_covariance[i, 3 + j, 3 + j] = rate_sd_radps**2
        for k in range(3):
            out.pose_covariance[i, j, k] = P[POSITION + j, POSITION + k]
            out.pose_covariance[i, j, 3 + k] = P[POSITION + j, ATTITUDE + k]
            out.pose_covariance[i, 3 + j, k] = P[ATTITUDE + j, POSITION + k]
            out.pose_covariance[i, 3 + j, 3 + k] = P[ATTITUDE + j, ATTITUDE + k]
            out.twist_covariance[i, j, k] = velocity_covariance[j, k]
            out.twist_covariance[i, 3 + j, 3 + k] += P[GYRO_BIAS + j, GYRO_BIAS + k]


@compiled
def foot_velocity_jacobian(quat_xyzw: Floats, velocity_mps: Floats) -> Floats:
    """Return d (velocity in the foot frame) / d (velocity error, attitude error), (3, 6).

    R_true' v_true = R' (I - [attitude x]) (v + velocity error), so the error in the foot frame is
    R' (velocity error + [v x] attitude error). The first three columns are R', which also turns the velocity itself.
    """
    R, v = matrix(quat_xyzw), velocity_mps
    J = np.empty((3, 6))
    for i in range(3):
        for j in range(3):
            J[i, j] = R[j, i]
        J[i, 3] = R[1, i] * v[2] - R[2, i] * v[1]
        J[i, 4] = R[2, i] * v[0] - R[0, i] * v[2]
        J[i, 5] = R[0, i] * v[1] - R[1, i] * v[0]
    return J

"""The estimate as others read it: pose in the world frame, twist in the foot frame, with their covariances."""

import numpy as np

from pdr_core.conventions import UNKNOWN_RATE_SD_RADPS
from pdr_core.eskf.error_state import ATTITUDE, GYRO_BIAS, POSITION, VELOCITY
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import rows
from pdr_core.maths.vector import Matrix, Triple, Vector, added, column, cross, rotated, transposed
from pdr_core.records import Floats, NavBlock


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
    R_foot_from_world = transposed(rows(state.quat_xyzw))
    velocity_mps = rotated(R_foot_from_world, state.velocity_mps)
    velocity_covariance = foot_velocity_covariance(R_foot_from_world, state.velocity_mps, P)
    out.stamp_ns[i] = state.last_ns
    for j in range(4):
        out.quat_xyzw[i, j] = state.quat_xyzw[j]
    for j in range(3):
        out.position_m[i, j] = state.position_m[j]
        out.velocity_mps[i, j] = velocity_mps[j]
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
def foot_velocity_covariance(R_foot_from_world: Matrix, velocity_mps: Vector, P: Floats) -> Floats:
    """Return the covariance (3, 3) of the velocity in the foot frame: J P J' with J as in `foot_velocity_error`."""
    JP = np.empty((3, ATTITUDE + 3))
    for j in range(VELOCITY, ATTITUDE + 3):
        JP[:, j] = foot_velocity_error(R_foot_from_world, velocity_mps, column(P, VELOCITY, j), column(P, ATTITUDE, j))
    out = np.empty((3, 3))
    for i in range(3):
        out[i] = foot_velocity_error(R_foot_from_world, velocity_mps, JP[i, VELOCITY:ATTITUDE], JP[i, ATTITUDE:])
    return out


@compiled
def foot_velocity_error(
    R_foot_from_world: Matrix, velocity_mps: Vector, velocity_error: Vector, attitude_error: Vector
) -> Triple:
    """Return the error of the velocity in the foot frame.

    R_true' v_true = R' (I - [attitude x]) (v + velocity error), so it is R' (velocity error + v x attitude error).
    """
    return rotated(R_foot_from_world, added(velocity_error, cross(velocity_mps, attitude_error)))

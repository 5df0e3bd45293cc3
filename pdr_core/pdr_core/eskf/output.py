"""The estimate as others read it: pose in the world frame, twist in the foot frame, with their covariances."""

import numpy as np

from pdr_core.eskf.error_state import ATTITUDE, GYRO_BIAS, POSITION, VELOCITY
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import matrix
from pdr_core.maths.vector import cross_matrix, product, rotated
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
    n, P = state.nominal, state.P
    R_foot_from_world = matrix(n.quat_xyzw).T.copy()
    velocity = rotated(R_foot_from_world, n.velocity_mps)
    velocity_covariance = velocity_covariance_in_foot(R_foot_from_world, n.velocity_mps, P)
    out.stamp_ns[i] = state.last_ns[0]
    for j in range(4):
        out.quat_xyzw[i, j] = n.quat_xyzw[j]
    for j in range(3):
        out.position_m[i, j] = n.position_m[j]
        out.velocity_mps[i, j] = velocity[j]
        out.rate_radps[i, j] = state.last_rate_radps[j] - n.gyro_bias_radps[j]
        out.twist_covariance[i, 3 + j, 3 + j] = state.last_gyro_sd_radps[0] ** 2
        for k in range(3):
            out.pose_covariance[i, j, k] = P[POSITION + j, POSITION + k]
            out.pose_covariance[i, j, 3 + k] = P[POSITION + j, ATTITUDE + k]
            out.pose_covariance[i, 3 + j, k] = P[ATTITUDE + j, POSITION + k]
            out.pose_covariance[i, 3 + j, 3 + k] = P[ATTITUDE + j, ATTITUDE + k]
            out.twist_covariance[i, j, k] = velocity_covariance[j, k]
            out.twist_covariance[i, 3 + j, 3 + k] += P[GYRO_BIAS + j, GYRO_BIAS + k]


@compiled
def velocity_covariance_in_foot(R_foot_from_world: Floats, velocity_mps: Floats, P: Floats) -> Floats:
    """Return the covariance, (3, 3), of the velocity in the foot frame.

    R_true' v_true = R' (I - [attitude x]) (v + velocity error), so the error in the foot frame is
    R' (velocity error + [v x] attitude error).
    """
    V, A = slice(VELOCITY, VELOCITY + 3), slice(ATTITUDE, ATTITUDE + 3)
    X = cross_matrix(velocity_mps)
    mixed = product(X, P[A, V])
    world = P[V, V] + mixed + mixed.T + product(product(X, P[A, A]), X.T)
    return product(product(R_foot_from_world, world), R_foot_from_world.T)

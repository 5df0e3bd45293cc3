"""The estimate as others read it: pose in the world frame, twist in the chest frame, with their covariances."""

import numpy as np

from pdr_core.chest.settings import Settings
from pdr_core.chest.state import ChestState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import rows
from pdr_core.maths.vector import rotated, transposed
from pdr_core.records import NavBlock


def empty_nav(count: int) -> NavBlock:
    """Return room for `count` estimates."""
    shapes = ((3,), (4,), (3,), (3,), (6, 6), (6, 6))
    return NavBlock(np.empty(count, np.int64), *(np.zeros((count, *shape)) for shape in shapes))


@compiled
def write(out: NavBlock, i: int, s: Settings, state: ChestState) -> None:
    """Write the estimate as sample i of the output."""
    R_chest_from_world = transposed(rows(state.quat_xyzw))
    velocity = rotated(R_chest_from_world, state.velocity_mps)
    tilt_rad2 = tilt_sd_rad(s, state) ** 2
    out.stamp_ns[i] = state.last_ns
    for j in range(4):
        out.quat_xyzw[i, j] = state.quat_xyzw[j]
    for j in range(3):
        out.position_m[i, j] = state.position_m[j]
        out.velocity_mps[i, j] = velocity[j]
        out.rate_radps[i, j] = state.last_rate_radps[j] - state.gyro_bias_radps[j]
        out.pose_covariance[i, j, j] = state.position_sd_m**2
        out.pose_covariance[i, 3 + j, 3 + j] = tilt_rad2 if j < 2 else state.yaw_sd_rad**2
        out.twist_covariance[i, j, j] = state.velocity_sd_mps**2
        out.twist_covariance[i, 3 + j, 3 + j] = state.bias_variance


@compiled
def tilt_sd_rad(s: Settings, state: ChestState) -> float:
    """Return the standard deviation of roll and of pitch: before the first rest nothing is known of them."""
    return s.tilt_sd_rad if state.aligned else np.pi

"""Somebody knows better where the chest is, or where it points: the track is turned, or put elsewhere."""

import numpy as np

from pdr_core.chest.ahead import chest_yaw_rad
from pdr_core.chest.state import UNKNOWN_BIAS_VARIANCE, ChestState
from pdr_core.chest.steps import forget_before
from pdr_core.conventions import NO_STAMP
from pdr_core.maths.quaternion import from_euler, matrix, multiply, yaw_rad
from pdr_core.records import PoseEstimate


def turn_track(angle_rad: float, state: ChestState) -> None:
    """Turn about the vertical, counter-clockwise: attitude, velocity, and what is remembered in the world frame."""
    turn = from_euler(0.0, 0.0, angle_rad)
    state.quat_xyzw[:] = multiply(turn, state.quat_xyzw)
    R = matrix(turn)
    for vector in (state.velocity_mps, state.step_force, state.force_before):
        vector[:] = R @ vector
    for yaw in (state.step_yaw, state.yaw_before):
        yaw[:] = R[:2, :2] @ yaw
    state.yaw_from_rad += angle_rad


def place(pose: PoseEstimate, state: ChestState) -> None:
    """Go on from a pose, with its deviations: its yaw is where the chest points; without a quaternion it points on."""
    if pose.quat_xyzw is not None:
        angle_rad = yaw_rad(pose.quat_xyzw) - chest_yaw_rad(state.quat_xyzw, state)
        turn_track(angle_rad, state)
        state.held_yaw_rad += angle_rad
        state.yaw_sd_rad = np.sqrt(pose.covariance[5, 5])
    for position in (state.position_m, state.held_m, state.even_m):
        position[:] = pose.position_m
    state.position_sd_m = np.sqrt(max(pose.covariance[0, 0], pose.covariance[1, 1]))
    state.even_ns, state.settle_ns, state.step_start_ns = state.last_ns, NO_STAMP, NO_STAMP
    forget_before(state)
    state.step_number = 0
    state.placed += 1


def forget_bias(state: ChestState) -> None:
    """Know no more of the gyro than of any other."""
    state.gyro_bias_radps[:] = state.rest_bias_radps[:] = 0.0
    state.bias_variance = state.rest_bias_variance = UNKNOWN_BIAS_VARIANCE

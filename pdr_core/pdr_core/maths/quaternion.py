"""Unit quaternions (x, y, z, w) as in ROS and scipy; q turns body coordinates into world coordinates."""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats


@compiled
def multiply(p: Floats, q: Floats) -> Floats:
    """Return the product p q, (4,): first q, then p."""
    return np.array(
        [
            p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1],
            p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0],
            p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3],
            p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2],
        ]
    )


@compiled
def from_rotation_vector(angle_rad: Floats) -> Floats:
    """Return the quaternion (4,) of a rotation vector [rad] (3,): the exponential map, exact also near zero."""
    norm = np.sqrt(angle_rad[0] ** 2 + angle_rad[1] ** 2 + angle_rad[2] ** 2)
    half = 0.5 * norm
    scale = np.sin(half) / norm if norm > 1e-8 else 0.5 - norm**2 / 48.0
    return np.array([scale * angle_rad[0], scale * angle_rad[1], scale * angle_rad[2], np.cos(half)])


@compiled
def normalised(q: Floats) -> Floats:
    """Return q scaled to unit length."""
    return q / np.sqrt(q[0] ** 2 + q[1] ** 2 + q[2] ** 2 + q[3] ** 2)


@compiled
def matrix(q: Floats) -> Floats:
    """Return the rotation matrix (3, 3) of a unit quaternion."""
    x, y, z, w = q
    return np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
            [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
            [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )


@compiled
def yaw_rad(q: Floats) -> float:
    """Return the yaw of the body x axis, counter-clockwise from world x (REP-103)."""
    x, y, z, w = q
    return np.arctan2(2.0 * (x * y + z * w), 1.0 - 2.0 * (y * y + z * z))


@compiled
def from_euler(roll_rad: float, pitch_rad: float, yaw_rad: float) -> Floats:
    """Return the quaternion of roll, pitch, yaw about the fixed axes x, y, z (REP-103)."""
    cr, sr = np.cos(0.5 * roll_rad), np.sin(0.5 * roll_rad)
    cp, sp = np.cos(0.5 * pitch_rad), np.sin(0.5 * pitch_rad)
    cy, sy = np.cos(0.5 * yaw_rad), np.sin(0.5 * yaw_rad)
    return np.array(
        [
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        ]
    )

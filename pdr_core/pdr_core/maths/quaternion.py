"""Unit quaternions (x, y, z, w) as in ROS and scipy; q turns body coordinates into world coordinates.

The functions take anything with four (or three) numbers and return tuples, which cost nothing in compiled code.
"""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Rows, Triple, Vector, norm, scaled
from pdr_core.records import Floats

Four = tuple[float, float, float, float]
Quaternion = Four | Floats  # x, y, z, w


@compiled
def multiply(p: Quaternion, q: Quaternion) -> Four:
    """Return the product p q: first q, then p."""
    return (
        p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1],
        p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0],
        p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3],
        p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2],
    )


@compiled
def conjugate(q: Quaternion) -> Four:
    """Return the inverse of a unit quaternion."""
    return -q[0], -q[1], -q[2], q[3]


@compiled
def from_rotation_vector(angle_rad: Vector) -> Four:
    """Return the quaternion of a rotation vector [rad]: the exponential map, exact also near zero."""
    norm = np.sqrt(angle_rad[0] ** 2 + angle_rad[1] ** 2 + angle_rad[2] ** 2)
    half = 0.5 * norm
    scale = np.sin(half) / norm if norm > 1e-8 else 0.5 - norm**2 / 48.0
    return scale * angle_rad[0], scale * angle_rad[1], scale * angle_rad[2], np.cos(half)


@compiled
def to_rotation_vector(q: Quaternion) -> Triple:
    """Return the rotation vector [rad] of a unit quaternion, of at most half a turn: the logarithm."""
    sine, cosine = norm((q[0], q[1], q[2])), abs(q[3])
    scale = 2.0 * np.arctan2(sine, cosine) / sine if sine > 1e-8 else 2.0
    return scaled(scale if q[3] >= 0.0 else -scale, (q[0], q[1], q[2]))


@compiled
def normalised(q: Quaternion) -> Four:
    """Return q scaled to unit length."""
    length = np.sqrt(q[0] ** 2 + q[1] ** 2 + q[2] ** 2 + q[3] ** 2)
    return q[0] / length, q[1] / length, q[2] / length, q[3] / length


@compiled
def rows(q: Quaternion) -> Rows:
    """Return the rotation matrix of a unit quaternion, by rows."""
    x, y, z, w = q[0], q[1], q[2], q[3]
    return (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)),
        (2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)),
        (2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)),
    )


@compiled
def matrix(q: Quaternion) -> Floats:
    """Return the rotation matrix of a unit quaternion as an array (3, 3)."""
    return np.array(rows(q))


@compiled
def yaw_rad(q: Quaternion) -> float:
    """Return the yaw of the body x axis, counter-clockwise from world x (REP-103)."""
    x, y, z, w = q[0], q[1], q[2], q[3]
    return np.arctan2(2.0 * (x * y + z * w), 1.0 - 2.0 * (y * y + z * z))


@compiled
def turn_about_up_rad(before: Quaternion, after: Quaternion) -> float:
    """Return by how much a body has turned about the vertical, -pi..pi, however it is mounted (swing and twist)."""
    z = after[2] * before[3] - after[3] * before[2] - after[0] * before[1] + after[1] * before[0]
    w = after[3] * before[3] + after[0] * before[0] + after[1] * before[1] + after[2] * before[2]
    turn = 2.0 * np.arctan2(z, w)
    return turn - 2.0 * np.pi * np.round(turn / (2.0 * np.pi))


@compiled
def turned_about_up(q: Quaternion, turn_rad: float) -> Four:
    """Return the attitude of a body, world from body, after a turn about the vertical."""
    return multiply((0.0, 0.0, np.sin(0.5 * turn_rad), np.cos(0.5 * turn_rad)), q)


@compiled
def from_euler(roll_rad: float, pitch_rad: float, yaw_rad: float) -> Four:
    """Return the quaternion of roll, pitch, yaw about the fixed axes x, y, z (REP-103)."""
    cr, sr = np.cos(0.5 * roll_rad), np.sin(0.5 * roll_rad)
    cp, sp = np.cos(0.5 * pitch_rad), np.sin(0.5 * pitch_rad)
    cy, sy = np.cos(0.5 * yaw_rad), np.sin(0.5 * yaw_rad)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )

"""Orientation at a short rest, before and after the alignment (Qiu eq. 1 and 2, table 2 and figure 3)."""

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.maths.magnetic import magnetic_yaw_rad
from pdr_core.maths.quaternion import from_euler, matrix
from pdr_core.records import Floats
from pdr_core.records_gait import Mounting


def rest_orientation(accel_mps2: Floats) -> Floats:
    """Return world from sensor, (4,), without yaw, at a rest with that mean specific force, (3,): Qiu eq. 1-2."""
    x, y, z = accel_mps2
    return np.array(from_euler(np.arctan2(y, z), np.arctan2(-x, np.hypot(y, z)), 0.0))


def walking_yaw_rad(mounting: Mounting, accel_mps2: Floats, field_tesla: Floats) -> float:
    """Return the yaw of the walking direction, counter-clockwise from magnetic east, at a rest.

    Specific force and field, (3,), are their means at the rest in foot axes. For Qiu's eq. 1 see maths.magnetic.
    """
    R_body_from_foot = matrix(mounting.quat_xyzw)
    return float(magnetic_yaw_rad(rest_orientation(R_body_from_foot @ accel_mps2), R_body_from_foot @ field_tesla))


def walking_frame(quat_xyzw: Floats, heading_rad: float) -> Floats:
    """Return orientations, (n, 4) world from foot, in a world whose x points along a heading."""
    turn = Rotation.from_quat(from_euler(0.0, 0.0, -heading_rad))
    return continuous((turn * Rotation.from_quat(quat_xyzw)).as_quat())


def aligned(quat_xyzw: Floats, mounting: Mounting) -> Floats:
    """Return the orientations of the body, (n, 4), from those of the foot, (n, 4): q R_trans'.

    At a rest with the walking direction ahead each is (0, 0, 0, 1), which Qiu writes (1, 0, 0, 0).
    """
    R_foot_from_body = Rotation.from_quat(mounting.quat_xyzw).inv()
    return continuous((Rotation.from_quat(quat_xyzw) * R_foot_from_body).as_quat())


def continuous(quat_xyzw: Floats) -> Floats:
    """Return the same orientations, (n, 4), without jumps from q to -q; the first w is not negative."""
    same = np.einsum("ij,ij->i", quat_xyzw[1:], quat_xyzw[:-1]) >= 0.0
    signs = np.cumprod([1.0 if quat_xyzw[0, 3] >= 0.0 else -1.0, *np.where(same, 1.0, -1.0)])
    return signs[:, None] * quat_xyzw


def euler_rad(R: Floats) -> tuple[float, float, float]:
    """Return roll, pitch and yaw about the fixed axes x, y, z of a rotation matrix, (3, 3): Qiu eq. 2 solved.

    With x vertical only roll and yaw together are determined: the roll is then taken as zero.
    """
    cos_pitch = float(np.hypot(R[2, 1], R[2, 2]))
    pitch = float(np.arctan2(-R[2, 0], cos_pitch))
    if cos_pitch < 1e-9:
        return 0.0, pitch, float(np.arctan2(-R[0, 1], R[1, 1]))
    return float(np.arctan2(R[2, 1], R[2, 2])), pitch, float(np.arctan2(R[1, 0], R[0, 0]))

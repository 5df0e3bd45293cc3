"""Where up is, by the specific force of a foot at rest: its attitude (Gui eq. 1-2), and how far one is off.

Gui writes them for right-front-up axes and with a one-sided arctangent, which fails when the sensor is upside down. For
forward-left-up axes and any mounting: roll = atan2(f_y, f_z), pitch = atan2(-f_x, sqrt(f_y^2 + f_z^2)).
"""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import Four, from_euler, rows
from pdr_core.maths.vector import Vector, norm, rotated
from pdr_core.records import Floats

ACCEL_PER_SPEED = 0.1 / 0.0022  # [1/s] a foot that moves at this speed accelerates so much: units of the GLRT


@compiled
def levelled(force_mps2: Floats, yaw_rad: float) -> Four:
    """Return the attitude, world from foot, of a resting sensor that measures `force_mps2` (3,)."""
    roll = np.arctan2(force_mps2[1], force_mps2[2])
    pitch = np.arctan2(-force_mps2[0], np.hypot(force_mps2[1], force_mps2[2]))
    return from_euler(roll, pitch, yaw_rad)


@compiled
def off_vertical(quat_xyzw: Floats, force_mps2: Vector) -> tuple[float, float, float]:
    """Return the shortest turn [rad] about the world's x and y that lays the force (foot frame) on the vertical.

    Its angle comes last.
    """
    up = rotated(rows(quat_xyzw), force_mps2)
    across = np.hypot(up[0], up[1])
    angle = np.arctan2(across, up[2])
    if across < 1e-9 * norm(up):
        return angle, 0.0, angle
    return up[1] * angle / across, -up[0] * angle / across, angle

"""Self-alignment: the attitude of a foot at rest from the direction of gravity (Gui eq. 1-2).

Gui writes them for right-front-up axes and with a one-sided arctangent, which fails when the sensor is upside down. For
forward-left-up axes and any mounting: roll = atan2(f_y, f_z), pitch = atan2(-f_x, sqrt(f_y^2 + f_z^2)).
"""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import Four, from_euler
from pdr_core.records import Floats


@compiled
def levelled(force_mps2: Floats, yaw_rad: float) -> Four:
    """Return the attitude, world from foot, of a resting sensor that measures `force_mps2` (3,)."""
    roll = np.arctan2(force_mps2[1], force_mps2[2])
    pitch = np.arctan2(-force_mps2[0], np.hypot(force_mps2[1], force_mps2[2]))
    return from_euler(roll, pitch, yaw_rad)

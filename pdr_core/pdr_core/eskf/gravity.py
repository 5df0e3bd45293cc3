"""Levelling a foot that stands, where its tilt is lost: after a gap, a fall, or when the sensor was kicked aside.

The filter is linear in small errors, and a large tilt is none. But a standing foot measures gravity, whatever its tilt:
the shortest turn that lays the measured specific force on the vertical is the tilt error itself, of any size, so that
H is I on the two tilt errors. How far the foot accelerates while it stands goes with how far it moves: the detector's
noise of the velocity is .0022 sqrt(T), and the statistic T is in units of .1 m/s^2.
"""

import numpy as np

from pdr_core.eskf.error_state import ATTITUDE, SIZE
from pdr_core.maths.compiled import compiled
from pdr_core.maths.levelling import ACCEL_PER_SPEED, off_vertical
from pdr_core.maths.vector import Vector
from pdr_core.records import Floats

LOST_RAD = 0.2  # a tilt as uncertain as this is lost

H = np.eye(SIZE)[ATTITUDE : ATTITUDE + 2]


@compiled
def tilt_is_lost(P: Floats) -> bool:
    """Return whether the tilt is too uncertain for a linear update."""
    return P[ATTITUDE, ATTITUDE] + P[ATTITUDE + 1, ATTITUDE + 1] > LOST_RAD**2


@compiled
def residual(quat_xyzw: Floats, force_mps2: Vector) -> Floats:
    """Return the turn [rad] about world x and y that lays the measured force (foot frame) on the vertical, (2,)."""
    about_x, about_y, _ = off_vertical(quat_xyzw, force_mps2)
    return np.array([about_x, about_y])


@compiled
def noise(velocity_sd_mps: float, gravity_mps2: float) -> Floats:
    """Return the covariance [rad^2], (2, 2), of the residual of a foot that stands so still."""
    return np.eye(2) * (ACCEL_PER_SPEED * velocity_sd_mps / gravity_mps2) ** 2

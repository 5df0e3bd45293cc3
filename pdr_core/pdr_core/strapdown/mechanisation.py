"""Gui eq. 3-7: from one sample to the next, the pose follows the angular rate and the specific force.

Two slips of the papers are left out here. Gui eq. 3 turns by 2 atan(|w| dt / 2), a third-order approximation of the
rotation by |w| dt that is used here. Zhou eq. 1 adds a dt^2 / 2 to a position that has already moved by the updated
velocity, which counts the acceleration twice; Gui eq. 6-7 move it by the mean velocity, which is right.
"""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import from_rotation_vector, matrix, multiply, normalised
from pdr_core.maths.vector import rotated
from pdr_core.records import Floats


@compiled
def advance(
    position_m: Floats,
    velocity_mps: Floats,
    quat_xyzw: Floats,
    rate_radps: Floats,
    force_before_mps2: Floats,
    force_after_mps2: Floats,
    dt_s: float,
    gravity_mps2: float,
) -> tuple[Floats, Floats]:
    """Move position, velocity (3,) and attitude (4,) by one interval, in place.

    `rate_radps` (3,) is the mean over the interval, the forces (3,) are those at its ends; all without bias. Returns
    the rotations world from foot at both ends, (3, 3), of which eq. 4 needs the mean.
    """
    R_before = matrix(quat_xyzw)
    quat_xyzw[:] = normalised(multiply(quat_xyzw, from_rotation_vector(rate_radps * dt_s)))  # eq. 3
    R_after = matrix(quat_xyzw)
    accel = 0.5 * (rotated(R_before, force_before_mps2) + rotated(R_after, force_after_mps2))  # eq. 4
    accel[2] -= gravity_mps2  # eq. 5
    position_m += velocity_mps * dt_s + 0.5 * accel * dt_s**2  # eq. 7 with eq. 6 in it
    velocity_mps += accel * dt_s  # eq. 6
    return R_before, R_after

"""Gui eq. 3-7: from one sample to the next, the pose follows the angular rate and the specific force.

Two slips of the papers are left out here. Gui eq. 3 turns by 2 atan(|w| dt / 2), a third-order approximation of the
rotation by |w| dt that is used here. Zhou eq. 1 adds a dt^2 / 2 to a position that has already moved by the updated
velocity, which counts the acceleration twice; Gui eq. 6-7 move it by the mean velocity, which is right.
"""

from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import from_rotation_vector, multiply, normalised, rows
from pdr_core.maths.vector import Rows, Triple, Vector, added, cross, difference, mean, rotated, scaled
from pdr_core.records import Floats


@compiled
def mean_rate(before_radps: Vector, after_radps: Vector, dt_s: float) -> Triple:
    """Return the rate [rad/s] whose steady turn over the interval adds up to the true one, from those at its ends.

    Gui and Zhou take one rate for the interval. That misses twice what dt^2 / 12 (before x after) turns. Once because
    the axis moves within the interval (coning: the second term of Bortz 1971, 1/2 angle x rate). And once because the
    mean of the ends is off by dt^2 / 12 times the second derivative w" of the rate: in a frame that turns these do not
    cancel, the sum of R w" over a motion between two rests is, by parts, that of -R (w x w').
    """
    return added(mean(before_radps, after_radps), scaled(dt_s / 6.0, cross(before_radps, after_radps)))


@compiled
def advance(
    position_m: Floats,
    velocity_mps: Floats,
    quat_xyzw: Floats,
    rate_radps: Vector,
    force_before_mps2: Vector,
    force_after_mps2: Vector,
    dt_s: float,
    gravity_mps2: float,
) -> tuple[Rows, Rows]:
    """Move position, velocity (3,) and attitude (4,) by one interval, in place.

    `rate_radps` is the mean over the interval, the forces are those at its ends; all without bias, in the foot frame.
    Returns the rotations world from foot at both ends, by rows.
    """
    R_before = rows(quat_xyzw)
    turned = multiply(quat_xyzw, from_rotation_vector(scaled(dt_s, rate_radps)))  # eq. 3
    quat_xyzw[:] = normalised(turned)
    R_after = rows(quat_xyzw)
    force = mean(rotated(R_before, force_before_mps2), rotated(R_after, force_after_mps2))  # eq. 4
    accel = difference(force, (0.0, 0.0, gravity_mps2))  # eq. 5
    for i in range(3):
        position_m[i] += (velocity_mps[i] + 0.5 * accel[i] * dt_s) * dt_s  # eq. 7 with eq. 6 in it
        velocity_mps[i] += accel[i] * dt_s  # eq. 6
    return R_before, R_after

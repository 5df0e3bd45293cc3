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
    """Return the rate whose steady turn is that of a rate which changes evenly over an interval.

    Gui and Zhou take one rate for the interval. Where its axis moves, the turns do not commute, and what they add up to
    differs from the turn by the mean rate (coning, Bortz 1971): by dt^2 / 12 (before x after), from the second term of
    his equation, 1/2 (angle x rate), integrated over the interval.
    """
    return added(mean(before_radps, after_radps), scaled(dt_s / 12.0, cross(before_radps, after_radps)))


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

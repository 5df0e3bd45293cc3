"""Heading and dip from a magnetic field in body axes, by tilt: Qiu eq. 1, third line.

With roll p and pitch t the level axes of a body keep its heading and lie flat: v_level = R_y(t) R_x(p) v. So the field
m there is

    X = mx ct + (my sp + mz cp) st      Y = my cp - mz sp      Z = -mx st + (my sp + mz cp) ct

Only the yaw is left between level and world axes, (X, Y) = R_z(-yaw) (horizontal field of the world), and atan2(-Y, X)
is the yaw counter-clockwise from magnetic north. Qiu prints an arctan of three arguments: my cp + mx sp st, -mz sp ct,
and mx ct - mz st. The first two belong together, they are Y of R_x(p) R_y(t); the third is X of that, with the sign of
mz st turned. Qiu's own eq. 2 has the other order, R_y(t) R_x(p), and from there comes what stands here; and Y needs the
minus. Our world is ENU (REP-103), where yaw counts from east: at declination zero the horizontal field is (0, H), so
(X, Y) = H (sin yaw, cos yaw) and yaw = atan2(X, Y), which is atan2(-Y, X) + 90 deg.

Neither roll nor pitch is needed: up in body axes is (-st, sp ct, cp ct), the third row of R_world_from_body. At rest
that is where the accelerometer points.
"""

import numpy as np

from pdr_core.maths import quaternion
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import Quaternion
from pdr_core.maths.vector import Triple, Vector, cross, dot, norm
from pdr_core.records import Floats

UP = (0.0, 0.0, 1.0)  # in a world frame


@compiled
def up_in_body(quat_xyzw: Quaternion) -> Triple:
    """Return which way is up, in body axes, for a unit quaternion (world from body)."""
    return quaternion.rows(quat_xyzw)[2]


@compiled
def level_field(up: Vector, field: Vector) -> Triple:
    """Return a field, (3,) in body axes (FLU), in level axes: x ahead where the body's x points, y left, z up.

    `up`, (3,) in body axes, may have any length but zero: what an accelerometer at rest shows will do. A body whose x
    is vertical has no heading; it is taken to have no roll. Source: Qiu eq. 1, derived anew above.
    """
    across, length = np.hypot(up[1], up[2]), norm(up)
    sine, cosine = -up[0] / length, across / length
    sin_roll, cos_roll = (up[1] / across, up[2] / across) if across > 0.0 else (0.0, 1.0)
    down_the_side = field[1] * sin_roll + field[2] * cos_roll
    return (
        field[0] * cosine + down_the_side * sine,
        field[1] * cos_roll - field[2] * sin_roll,
        -field[0] * sine + down_the_side * cosine,
    )


@compiled
def magnetic_yaw_rad(quat_xyzw: Quaternion, field: Vector) -> float:
    """Return the yaw, -pi..pi, of the body x axis that a field shows, counter-clockwise from magnetic east.

    Of the unit quaternion (world from body) only the tilt counts, its own yaw may be anything. `field`, (3,) in body
    axes and any unit. Less the declination (east positive) it is the yaw from true east. Source: Qiu eq. 1, see above.
    """
    x, y, _ = level_field(up_in_body(quat_xyzw), field)
    return np.arctan2(x, y)


@compiled
def dip_rad(up: Vector, field: Vector) -> float:
    """Return by how much a field, (3,), points below the horizon; `up`, (3,) in the same axes, may have any length."""
    return np.arctan2(-dot(up, field), norm(cross(up, field)))


@compiled
def azimuth_rad(field: Vector) -> float:
    """Return the azimuth of a field (3,) in a world frame, z up: counter-clockwise from x."""
    return np.arctan2(field[1], field[0])


@compiled
def azimuth_by_rotation(field: Vector) -> Triple:
    """Return how the azimuth of a field (3,) in a world frame moves with a small rotation e about the world's axes.

    The rotation changes m by e x m, so the azimuth by e_z - (m_z / m_h^2) (m_x e_x + m_y e_y), m_h^2 = m_x^2 + m_y^2.
    """
    steep = field[2] / (field[0] ** 2 + field[1] ** 2)
    return -steep * field[0], -steep * field[1], 1.0


@compiled
def same_field(
    norm_tesla: float,
    dip: float,
    other_norm_tesla: float,
    other_dip_rad: float,
    norm_tolerance: float,
    dip_tolerance_rad: float,
) -> bool:
    """Return whether two fields are alike in strength, to a share of it, and in dip."""
    return abs(norm_tesla / other_norm_tesla - 1.0) < norm_tolerance and abs(dip - other_dip_rad) < dip_tolerance_rad


@compiled
def alike(values: Floats, tolerance: float) -> bool:
    """Return whether no two of n values, (n,), are farther apart than the tolerance."""
    return bool(np.max(values) - np.min(values) < tolerance)


@compiled
def alike_angles(angles_rad: Floats, tolerance_rad: float) -> bool:
    """Return whether no two of n angles, (n,), are farther apart than the tolerance."""
    turned = angles_rad - angles_rad[0]
    return alike(turned - 2.0 * np.pi * np.round(turned / (2.0 * np.pi)), tolerance_rad)

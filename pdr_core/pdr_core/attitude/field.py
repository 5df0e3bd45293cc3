"""The heading by the magnetic field: it should point where it pointed in the first rest.

The azimuth of the field in the world frame, m = C(q) m_foot, is an angle that no tilt-compensated formula has to be
written for; Qiu eq. 1 prints one with three arguments. A rotation t of the estimate moves it by

    t_z - m_z (m_x t_x + m_y t_y) / (m_x^2 + m_y^2),

so a steep field shows the tilt as heading; the innovation knows that. But the field corrects the heading alone: what the
gain would do to the tilt is left out, for gravity knows better. A field is disturbed, and not used, where it is stronger
or weaker or steeper than in the first rest.
"""

import numpy as np

from pdr_core.attitude.settings import Settings
from pdr_core.attitude.sphere import rotation_jacobian, tangents
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Vector, norm, product
from pdr_core.records import Floats


@compiled
def dip_rad(field: Vector) -> float:
    """Return how far a field (3,) in the world frame points below the horizon."""
    return np.arctan2(-field[2], np.hypot(field[0], field[1]))


@compiled
def disturbed(field: Vector, reference: Floats, s: Settings) -> bool:
    """Return whether a field in the world frame is not that of the first rest, however it is turned."""
    strength = abs(norm(field) / norm(reference) - 1.0)
    return strength > s.field_norm_share or abs(dip_rad(field) - dip_rad(reference)) > s.field_dip_rad


@compiled
def residual(field: Vector, reference: Floats) -> Floats:
    """Return by how much the estimate must be turned to the left, (1,), -pi..pi."""
    across = field[0] * reference[1] - field[1] * reference[0]
    along = field[0] * reference[0] + field[1] * reference[1]
    return np.array([np.arctan2(across, along)])


@compiled
def jacobian(quat_xyzw: Floats, field: Vector) -> Floats:
    """Return H, (1, 7), at a field in the world frame."""
    horizontal2 = field[0] ** 2 + field[1] ** 2
    by_rotation = np.array([[-field[2] * field[0] / horizontal2, -field[2] * field[1] / horizontal2, 1.0]])
    return product(by_rotation, rotation_jacobian(quat_xyzw))


@compiled
def heading_alone(K: Floats, quat_xyzw: Floats) -> Floats:
    """Return the gain (7, 1) without what it would do to the tilt, in place."""
    up = tangents(quat_xyzw)[:, 2]
    about_up = 0.0
    for i in range(4):
        about_up += up[i] * K[i, 0]
    for i in range(4):
        K[i, 0] = about_up * up[i]
    return K


@compiled
def sample_variance(gravity_sd_mps2: float, dt_s: float, s: Settings) -> float:
    """Return the variance [rad^2] of the heading by one sample of many: of the field, and of how still the foot is."""
    sd_rad = np.hypot(s.field_sd_rad, gravity_sd_mps2 / s.gravity_mps2)
    return sd_rad**2 * max(1.0, s.field_correlation_s / dt_s)

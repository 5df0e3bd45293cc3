"""The heading by the magnetic field: it should point where it pointed in the first rest.

The azimuth of the field in the world frame, m = C(q) m_foot, needs no tilt-compensated formula. How it moves with a
rotation of the estimate is in `maths/magnetic.py`: a steep field shows the tilt as heading; the innovation knows that.
But the field corrects the heading alone: what
the gain would do to the tilt is left out, for gravity knows better. A field is disturbed, and not used, where it is
stronger or weaker or steeper than in the first rest.
"""

import numpy as np

from pdr_core.attitude.settings import Settings
from pdr_core.attitude.sphere import rotation_jacobian, tangents
from pdr_core.attitude.state import GYRO_BIAS, QUATERNION
from pdr_core.maths.compiled import compiled
from pdr_core.maths.magnetic import UP, azimuth_by_rotation, dip_rad
from pdr_core.maths.quaternion import rows
from pdr_core.maths.vector import Vector, norm, product
from pdr_core.records import Floats


@compiled
def disturbed(field: Vector, reference: Floats, s: Settings) -> bool:
    """Return whether a field in the world frame is not that of the first rest, however it is turned."""
    strength = abs(norm(field) / norm(reference) - 1.0)
    return strength > s.field_norm_share or abs(dip_rad(UP, field) - dip_rad(UP, reference)) > s.field_dip_rad


@compiled
def residual(field: Vector, reference: Floats) -> Floats:
    """Return by how much the estimate must be turned to the left, (1,), -pi..pi."""
    across = field[0] * reference[1] - field[1] * reference[0]
    along = field[0] * reference[0] + field[1] * reference[1]
    return np.array([np.arctan2(across, along)])


@compiled
def jacobian(quat_xyzw: Floats, field: Vector) -> Floats:
    """Return H, (1, 7), at a field in the world frame."""
    return product(np.array(azimuth_by_rotation(field)).reshape(1, 3), rotation_jacobian(quat_xyzw))


@compiled
def heading_alone(K: Floats, quat_xyzw: Floats) -> Floats:
    """Return the gain (7, 1) for the heading and the gyro bias about the vertical, in place: nothing that tilts."""
    keep_along(tangents(quat_xyzw)[:, 2], K[QUATERNION:GYRO_BIAS, 0])
    keep_along(np.array(rows(quat_xyzw)[2]), K[GYRO_BIAS:, 0])
    return K


@compiled
def keep_along(axis: Floats, v: Floats) -> None:
    """Replace v by its part along an axis of unit length."""
    along = 0.0
    for i in range(axis.shape[0]):
        along += axis[i] * v[i]
    for i in range(axis.shape[0]):
        v[i] = along * axis[i]


@compiled
def sample_variance(gravity_sd_mps2: float, dt_s: float, s: Settings) -> float:
    """Return the variance [rad^2] of the heading by one sample of many: of the field, and of how still the foot is."""
    sd_rad = np.hypot(s.field_sd_rad, gravity_sd_mps2 / s.gravity_mps2)
    return sd_rad**2 * max(1.0, s.field_correlation_s / dt_s)

"""Differential magnetic update: how the field changes in a quiet stance shows the gyro bias, even indoors.

With w_m = w + b the measured rate, a constant field m obeys dm/dt = -w x m in the foot's axes. Turned back by the rates
without the *estimated* bias, as `quiet_field.py` does, it goes on turning by what the estimate is wrong, d = b - b_est:

    d m_back / dt = d x m = -[m x] d            so       residual = change of the field,   H = -[m x] on the gyro bias.

(m_back = Exp(phi_est) m with phi_est = integral of w_m - b_est, which turns too far by d t.) A turn about the field
itself changes nothing: of three biases it shows two, and the third as the foot comes to stand otherwise.

Noise. The white noise s of a sample gives s / sqrt(sum of squared times) to the change. And a foot that turns at w
while it stands sees two more changes go with w: an offset h that the calibration has left turns with the sensor, w x h,
and the sensor is carried by some millimetres through a field that iron bends, over 100 uT/m at the floor. Both together
are s_h |w| in any direction (measured at the first rests of tile walks: 15 uT a radian for the worst), so

    R = (s^2 / sum tau^2 + s_h^2 w'w) I.

What else there is, a tram or a lift that bends the field, is left out where the normalised innovation shows it.
"""

import numpy as np

from pdr_core.eskf.error_state import GYRO_BIAS, SIZE
from pdr_core.eskf.quiet_field import QuietField
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Vector, norm
from pdr_core.records import Floats


@compiled
def H(field_tesla: Vector) -> Floats:  # noqa: N802  (its usual name)
    """Return the Jacobian (3, 15) of the change of a field (3,)."""
    out = np.zeros((3, SIZE))
    out[0, GYRO_BIAS + 1], out[0, GYRO_BIAS + 2] = field_tesla[2], -field_tesla[1]
    out[1, GYRO_BIAS], out[1, GYRO_BIAS + 2] = -field_tesla[2], field_tesla[0]
    out[2, GYRO_BIAS], out[2, GYRO_BIAS + 1] = field_tesla[1], -field_tesla[0]
    return out


@compiled
def deviation(field: QuietField, offset_sd_tesla: float) -> float:
    """Return the noise [T/s] of an axis of the change that a window has shown."""
    return np.hypot(field.change_sd, offset_sd_tesla * norm(field.turned_radps))

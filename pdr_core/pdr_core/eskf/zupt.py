"""Zero-velocity update: the contact point of a standing foot does not move (Gui eq. 22, Zhou eq. 10).

Gui and Zhou take the sensor itself to be at rest. But a foot rolls over heel and ball while it stands, and the sensor
moves with it: about a contact at the height h below it, at the angular rate w in the world frame, by

    v = w x (h z) = h (w_y, -w_x, 0).

It needs no mounting, for the world frame knows where down is. The residual is this velocity minus the estimate, so H is
+I on the velocity error. That the contact velocity itself depends on the attitude and on the gyro bias is left out: the
derivatives are at most h |w| and h, so with tilts known to .01 rad and biases to .003 rad/s they are some .2 mm/s,
far below how well h is known; a test has the exact ones.

The rows of the gain that would change the gyro bias are set to zero: a standing foot rolls, and the filter would take
that for a bias (measured on real walks: 1.2 m instead of 0.6 m mean error).
"""

from pdr_core.eskf.error_state import GYRO_BIAS, VELOCITY, observing
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import rows
from pdr_core.maths.vector import Triple, Vector, rotated
from pdr_core.records import Floats

H = observing(VELOCITY)


@compiled
def rolling_velocity(quat_xyzw: Floats, rate_radps: Vector, height_m: float) -> Triple:
    """Return the velocity [m/s] of the sensor in the world frame; `rate_radps` in the foot frame, without bias."""
    rate = rotated(rows(quat_xyzw), rate_radps)
    return height_m * rate[1], -height_m * rate[0], 0.0


@compiled
def residual(expected_mps: Vector, velocity_mps: Floats) -> Floats:
    """Return the expected minus the estimated velocity, (3,)."""
    out = -velocity_mps
    for i in range(3):
        out[i] += expected_mps[i]
    return out


@compiled
def without_gyro_bias(K: Floats) -> Floats:
    """Return the gain (15, 3) with the rows of the gyro bias set to zero, in place."""
    K[GYRO_BIAS : GYRO_BIAS + 3] = 0.0
    return K

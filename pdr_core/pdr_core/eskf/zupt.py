"""Zero-velocity update: a standing foot does not move (Gui eq. 22, Zhou eq. 10).

The residual is the truth minus the estimate, 0 - v, so H is +I on the velocity error. The rows of the gain that would
change the gyro bias are set to zero: a standing foot rolls, and the filter would take that for a bias (measured on
real walks: 1.2 m instead of 0.6 m mean error).
"""

from pdr_core.eskf.error_state import GYRO_BIAS, VELOCITY, observing
from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats

H = observing(VELOCITY)


@compiled
def residual(velocity_mps: Floats) -> Floats:
    """Return the measured minus the estimated velocity, (3,)."""
    return -velocity_mps


@compiled
def without_gyro_bias(K: Floats) -> Floats:
    """Return the gain (15, 3) with the rows of the gyro bias set to zero, in place."""
    K[GYRO_BIAS : GYRO_BIAS + 3] = 0.0
    return K

"""Zero-velocity update: a standing foot does not move (Gui eq. 22, Zhou eq. 10).

A foot at rest has no velocity in its own frame: R_true' v_true = 0. With the errors of `error_state.py` that is
R' (v + velocity error + [v x] attitude error) = 0. So the residual is -v, and H is +I on the velocity error and [v x]
on the attitude error. The papers have the first block alone. The second is as small as v, and of it only the column of
the yaw is kept, v x z, because it keeps a stance from telling the yaw: turn the world by a yaw, and the estimate of v
changes by z x v and the yaw by 1. No stance can see that, and indeed z x v + v x z = 0. Without it the filter takes
every tremble of a standing foot for news of its yaw (measured on simulated walks: after a rest of 10 s the yaw is off
by 12 mrad instead of 0.5). See `relate` in `updates.py` for the other half.

The rows of the gain that would change the gyro bias are set to zero: a standing foot rolls, and the filter would take
that for a bias (measured on real walks: 1.2 m instead of 0.6 m mean error).
"""

from pdr_core.eskf.error_state import ATTITUDE, GYRO_BIAS, VELOCITY, observing
from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats

SHOWS_VELOCITY = observing(VELOCITY)


@compiled
def residual(velocity_mps: Floats) -> Floats:
    """Return the measured minus the estimated velocity, (3,)."""
    return -velocity_mps


@compiled
def jacobian(velocity_mps: Floats) -> Floats:
    """Return H, (3, 15)."""
    H = SHOWS_VELOCITY.copy()
    H[0, ATTITUDE + 2], H[1, ATTITUDE + 2] = velocity_mps[1], -velocity_mps[0]
    return H


@compiled
def without_gyro_bias(K: Floats) -> Floats:
    """Return the gain (15, 3) with the rows of the gyro bias set to zero, in place."""
    K[GYRO_BIAS : GYRO_BIAS + 3] = 0.0
    return K

"""Weighing a stance as if the yaw were known.

A standing foot tells nothing of the yaw: turn the whole track about the vertical, and its velocity is still zero. But
in the covariance an unknown yaw correlates with everything that happened since: by the linear model, a residual of
some mm/s speaks for a track turned by degrees, and the position would move by decimetres to fit. After a gap, where
the yaw is lost, this destroys the track; on common walks it turns it (measured: tile walks .29 -> .16 m mean error).

So gain and gate are made from the covariance given the yaw error e, with y for the innovation,

    P - P e e'P / e'P e,        H P - H P e e'P / e'P e,        S - H P e e'P H' / e'P e,

in which the yaw has no part: its row of the gain is zero. The true covariance is corrected by Joseph's form, which
holds for any gain.
"""

from pdr_core.eskf.error_state import ATTITUDE
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import Innovation
from pdr_core.maths.vector import inverse_positive
from pdr_core.records import Floats

YAW = ATTITUDE + 2


@compiled
def given_yaw(yaw: Floats, y: Innovation) -> Innovation:
    """Return the innovation y as it were if the yaw error were known; `yaw` (n,): its covariances with all errors."""
    HP, S = y.HP.copy(), y.S.copy()
    if yaw[YAW] > 0.0:
        for i in range(S.shape[0]):
            share = y.HP[i, YAW] / yaw[YAW]
            for j in range(S.shape[1]):
                S[i, j] -= share * y.HP[j, YAW]
            for j in range(HP.shape[1]):
                HP[i, j] -= share * yaw[j]
            HP[i, YAW] = 0.0
    return Innovation(y.residual, HP, S, inverse_positive(S))

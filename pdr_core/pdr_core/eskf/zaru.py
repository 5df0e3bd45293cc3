"""Zero angular rate update: in a proven rest the gyro shows its bias (Gui eq. 23).

Gui prints the measured rate as the error measurement; the residual must be the rate minus the bias already estimated.
The measured rate of a rest is the mean over its best window, see `stance/rest.py`.
"""

import numpy as np

from pdr_core.eskf.error_state import GYRO_BIAS, observing
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Vector, difference
from pdr_core.records import Floats

H = observing(GYRO_BIAS)


@compiled
def residual(rest_rate_radps: Vector, gyro_bias_radps: Floats) -> Floats:
    """Return the measured minus the estimated bias, (3,)."""
    return np.array(difference(rest_rate_radps, gyro_bias_radps))

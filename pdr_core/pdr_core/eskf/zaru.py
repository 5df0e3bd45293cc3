"""Zero angular rate update: in a proven rest the gyro shows its bias (Gui eq. 23).

Gui prints the measured rate as the error measurement; the residual must be the rate minus the bias already estimated.
The measured rate of a rest is the mean over its best window, see `stance/rest.py`.
"""

import numpy as np

from pdr_core.eskf.error_state import GYRO_BIAS, SIZE
from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats


@compiled
def residual(rest_rate_radps: Floats, gyro_bias_radps: Floats) -> Floats:
    """Return the measured minus the estimated bias, (3,)."""
    return rest_rate_radps - gyro_bias_radps


@compiled
def jacobian() -> Floats:
    """Return H, (3, 15)."""
    H = np.zeros((3, SIZE))
    for i in range(3):
        H[i, GYRO_BIAS + i] = 1.0
    return H

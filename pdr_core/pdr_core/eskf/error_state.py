"""The 15 errors of the filter.

An error is the truth minus the estimate. The attitude error is a small rotation in the world frame:
R_true = Exp(attitude error) R_estimated. A bias is what the sensor shows too much: measured = true + bias. These
definitions fix every sign in `process.py` and in the updates; Gui eq. 13-14 and Zhou eq. 7 define some of them the
other way round.
"""

import numpy as np

from pdr_core.records import Floats

SIZE = 15
POSITION, VELOCITY, ATTITUDE, ACCEL_BIAS, GYRO_BIAS = 0, 3, 6, 9, 12  # where each error's three axes begin


def observing(error: int) -> Floats:
    """Return the Jacobian H, (3, 15), of a measurement that shows one error directly."""
    return np.eye(SIZE)[error : error + 3]

"""Heading observation: somebody beyond the filter knows by how much the track is turned (Gui eq. 24-25).

Gui compares yaw angles. Of a pitched foot the yaw also moves with the tilt errors, by tan(pitch), which his eq. 25
leaves out, and a vector of three in eq. 24 meets the one row of eq. 25. What is observed here is the turn of the whole
track about the vertical. That is the third attitude error itself, whatever the foot's tilt: H is 1 there, and the
residual, truth minus estimate, is minus the yaw error.
"""

import numpy as np

from pdr_core.eskf.error_state import ATTITUDE, observing
from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats

H = observing(ATTITUDE)[2:]


@compiled
def residual(yaw_error_rad: float) -> Floats:
    """Return the measured minus the estimated turn about the vertical, (1,)."""
    return np.array([-yaw_error_rad])

"""The fourth root of the range of the acceleration (Weinberg 2002, Analog Devices AN-602): d = K0 (a_max - a_min)^1/4.

Weinberg has the vertical acceleration of the hip; here it is the norm at the foot.
"""

import numpy as np

from pdr_core.gait.step_length.model import Model
from pdr_core.records import Floats
from pdr_core.records_gait import GaitStep


def terms(step: GaitStep) -> Floats:
    """Return the fourth root of the range."""
    return np.array([(step.accel_max_mps2 - step.accel_min_mps2) ** 0.25])


WEINBERG = Model("weinberg", "d = K0 (a_max - a_min)^1/4", terms, prior=(0.66,), prior_sd=(0.3,))

"""The cube root of the mean absolute acceleration (Kim 2004): d = K0 (mean |a|)^1/3, a beside gravity."""

import numpy as np

from pdr_core.gait.step_length.model import Model
from pdr_core.records import Floats
from pdr_core.records_gait import GaitStep


def terms(step: GaitStep) -> Floats:
    """Return the cube root of the mean absolute acceleration."""
    return np.array([np.cbrt(step.accel_mean_abs_mps2)])


KIM = Model("kim", "d = K0 (mean |a|)^1/3", terms, prior=(0.82,), prior_sd=(0.3,))

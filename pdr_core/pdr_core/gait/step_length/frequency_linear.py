"""Longer at a higher frequency f (Zhou's "bi-parametric linear model", Sun 2008): d = K0 + K1 f."""

import numpy as np

from pdr_core.gait.step_length.model import Model
from pdr_core.records import Floats
from pdr_core.records_gait import GaitStep


def terms(step: GaitStep) -> Floats:
    """Return 1 and f [Hz]."""
    return np.array([1.0, step.frequency_hz])


FREQUENCY_LINEAR = Model("frequency_linear", "d = K0 + K1 f", terms, prior=(0.9, 0.5), prior_sd=(0.5, 0.3))

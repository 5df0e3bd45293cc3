"""Every stride is as long as the others: d = K0."""

import numpy as np

from pdr_core.gait.step_length.model import Model
from pdr_core.records import Floats
from pdr_core.records_gait import GaitStep


def terms(_: GaitStep) -> Floats:
    """Return 1."""
    return np.ones(1)


CONSTANT = Model("constant", "d = K0", terms, prior=(1.3,), prior_sd=(0.5,))

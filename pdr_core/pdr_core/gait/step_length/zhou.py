"""Zhou eq. 15, one formula for walking and one for running.

    d_W = K0 + K1 f^-1/2 + K2 f^-1 + K3 a        d_R = K4 a^1/3

f is the stride's frequency. The paper prints K3 max(a_k), where a_k is already the mean over the stride: the maximum of
one number. Of the two readings, the mean of what is filtered and its largest value, the first is taken, of the absolute
value: measured on real walks it predicts better (docs/step_length.md).

f^-1/2 and f^-1 hardly differ over the frequencies of one person, so their coefficients cannot be told apart. The priors
say what is known of people: at the same acceleration a slower stride is longer, by 0.6 m a second.
"""

import numpy as np

from pdr_core.gait.step_length.kim import terms as cube_root
from pdr_core.gait.step_length.model import Model
from pdr_core.records import Floats
from pdr_core.records_gait import GaitStep


def terms(step: GaitStep) -> Floats:
    """Return 1, the mean absolute acceleration, f^-1 and f^-1/2."""
    return np.array([1.0, step.accel_mean_abs_mps2, 1.0 / step.frequency_hz, step.frequency_hz**-0.5])


WALKING = Model(
    "zhou", "d = K0 + K3 a + K2 f^-1 + K1 f^-1/2", terms, prior=(-0.4, 0.25, 0.6, 0.0), prior_sd=(1.0, 0.05, 0.3, 0.3)
)
RUNNING = Model("zhou", "d = K4 a^1/3", cube_root, prior=(0.65,), prior_sd=(0.3,))

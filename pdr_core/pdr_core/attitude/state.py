"""All that the orientation filter remembers between two samples: one numpy record, copied, saved, restored as one.

The seven states are the quaternion and the gyro bias (Qiu, after eq. 6), in this order: x, y, z, w and three axes.
"""

import numpy as np

from pdr_core.conventions import NO_STAMP

SIZE = 7
QUATERNION, GYRO_BIAS = 0, 4  # where each begins

# fmt: off
LAYOUT = np.dtype([
    ("quat_xyzw", np.float64, 4),             # world from foot, of unit length
    ("gyro_bias_radps", np.float64, 3),       # measured = true + bias
    ("P", np.float64, (SIZE, SIZE)),          # covariance of the errors, truth minus estimate; nil along the quaternion
    ("last_ns", np.int64),                    # NO_STAMP: none yet
    ("last_rate_radps", np.float64, 3),       # as measured
    ("last_gyro_sd_radps", np.float64),
    ("coasting", np.bool_),                   # the last interval was not integrated
    ("aligning", np.bool_),                   # the first moments, in which gravity alone gives the attitude
    ("alignment_start_ns", np.int64),
    ("force_sum_mps2", np.float64, 3),
    ("force_samples", np.int64),
    ("field_sum_tesla", np.float64, 3),
    ("field_samples", np.int64),
    ("field_tesla", np.float64, 3),           # in the first rest, world frame; nil: none was measured
    ("motion_mps2", np.float64),              # by how much the force may be off gravity, as remembered
    ("contradicted_s", np.float64),           # for how long gravity has contradicted the estimate
    ("gaps", np.int64),                       # what happened so far, for people to read
    ("doubted", np.int64),
    ("disturbed", np.int64),
], align=True)
# fmt: on
AttitudeState = np.record


def fresh_state() -> AttitudeState:
    """Return the memory of a filter that has seen nothing."""
    state = np.zeros(1, LAYOUT).view(np.recarray)[0]
    state.quat_xyzw[3] = 1.0
    state.aligning = True
    state.last_ns = state.alignment_start_ns = NO_STAMP
    return state

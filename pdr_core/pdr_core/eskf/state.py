"""All that the filter remembers between two samples: one numpy record, so it is copied, saved and restored as one.

A record also costs compiled code only a pointer, where a tuple of arrays would cost each of them at every call.
"""

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.eskf.error_state import SIZE

PLACES = 12  # that are compared to judge the field

# fmt: off
ESTIMATE = [
    ("position_m", np.float64, 3),            # world frame
    ("velocity_mps", np.float64, 3),          # world frame
    ("quat_xyzw", np.float64, 4),             # world from foot
    ("accel_bias_mps2", np.float64, 3),
    ("gyro_bias_radps", np.float64, 3),
    ("P", np.float64, (SIZE, SIZE)),          # covariance of the errors
    ("gravity_mps2", np.float64),
]
LAST_SAMPLE = [
    ("last_ns", np.int64),                    # NO_STAMP: none yet
    ("last_force_mps2", np.float64, 3),       # as measured
    ("last_rate_radps", np.float64, 3),
    ("last_gyro_sd_radps", np.float64),
    ("coasting", np.bool_),                   # the last interval was not integrated
    ("adrift", np.bool_),                     # no stance since then: velocity and tilt are unknown
    ("held_m", np.float64, 3),                # the position before the interval
]
ALIGNMENT = [                                 # the first moments, in which gravity alone gives the attitude
    ("aligning", np.bool_),
    ("alignment_start_ns", np.int64),
    ("force_sum_mps2", np.float64, 3),
    ("force_samples", np.int64),
    ("moved", np.bool_),                      # the foot did not rest
]
COMPASS = [                                   # the magnetic field in these moments
    ("compass_fields", np.int64),
    ("compass_sum_tesla", np.float64, 3),     # in the axes of the foot
    ("compass_square_sum", np.float64),
    ("compass_variance_sum", np.float64),
    ("compass", np.int64),                    # what came of it: the values of initial_yaw.py
    ("compass_yaw_rad", np.float64),
    ("compass_yaw_sd_rad", np.float64),
]
GATE = [
    ("last_accepted_ns", np.int64),           # of the zero-velocity updates
    ("contradicted_s", np.float64),           # time in stances that contradict the estimate, since one agreed
    ("contradicted_ns", np.int64),            # the last sample of them
    ("doubt", np.float64, SIZE),              # by what P was raised when it was doubted last
]
# The ends of the last two stances: row 0 the confirmed one, row 1 one that may still go on; NO_STAMP: none. `cross`
# holds the covariances of the errors now with the position errors at both (stochastic cloning): so the covariance of
# a displacement is exact, not the difference of two growing ones.
STEPS = [
    ("step_number", np.int64),                # of the next step event
    ("end_ns", np.int64, 2),
    ("end_sample", np.int64, 2),
    ("end_position_m", np.float64, (2, 3)),
    ("away_m", np.float64),                   # farthest distance from where the foot stood last
    ("excursion_m", np.float64),              # the farthest between the two ends
    ("end_covariance", np.float64, (2, 3, 3)),
    ("end_quat_xyzw", np.float64, (2, 4)),
    ("end_yaw_rad", np.float64, 2),
    ("end_yaw_sd_rad", np.float64, 2),
    ("cross", np.float64, (SIZE, 6)),
    ("displacement_covariance", np.float64, (3, 3)),
]
LEVEL_GROUND = [
    ("floor_m", np.float64),                  # height of the floor; NaN: none
    ("floor_told", np.float64),               # what this stance has told of it [1/m^2]; 0: it is not on it
    ("floor_cross", np.float64, (SIZE, 1)),   # covariance of the errors now with that of its height
    ("floor_ends", np.float64, (1, 6)),       # and of that with the position errors at both stance ends
    ("floor_variance_m2", np.float64),
]
QUIET_FIELD = [                               # the magnetic field in a window of a quiet stance
    ("field_open", np.bool_),
    ("field_start_ns", np.int64),
    ("field_samples", np.int64),
    ("field_turn_xyzw", np.float64, 4),       # of the foot since then: turns what is now back to what was
    ("field_time_sums", np.float64, 2),       # of times and of their squares
    ("field_sum", np.float64, 3),             # of the field, turned back
    ("field_time_sum", np.float64, 3),        # of time times field
    ("field_variance_sum", np.float64),
    ("bias_is_rare", np.bool_),                # beyond what sensors usually bring, and proven
    ("witness_sd", np.float64),               # of the change of the field in the last window [T/s]; 0: none yet
    ("witness_tesla", np.float64, 3),         # the field in it
    ("witness_bias_radps", np.float64, 3),    # the bias that its change speaks for, as far as it shows it
    ("field_use", np.int64),                  # NONE, CHANGE or HEADING of field_places.py
    ("field_windows", np.int64),              # that told something
    ("field_rejected", np.int64),             # that contradicted
]
NORTH = [                                     # the places where the foot stood, and the azimuth of the field
    ("places", np.int64),
    ("place_m", np.float64, 3),               # the last one
    ("place_norm_tesla", np.float64, PLACES),
    ("place_dip_rad", np.float64, PLACES),
    ("place_azimuth_rad", np.float64, PLACES),
    ("north_norm_tesla", np.float64),         # strength and dip of the field where north was found
    ("north_dip_rad", np.float64),
    ("north_rad", np.float64),                # azimuth of the field in the world frame
    ("north_variance", np.float64),           # 0: not found yet
    ("north_cross", np.float64, (SIZE, 1)),   # covariance of the errors with that of north
    ("north_ends", np.float64, (1, 6)),       # and of that with the position errors at both stance ends
]
COUNTS = [                                    # what happened so far, for people to read
    ("samples", np.int64),
    ("accepted", np.int64),                   # zero-velocity updates that agree with the estimate
    ("contradicted", np.int64),                   # those that contradict the estimate: they count for little
    ("doubted", np.int64),                    # how often stances that went on contradicting made it doubt the estimate
    ("gaps", np.int64),
    ("longest_swing_s", np.float64),          # longest time without a zero-velocity update
    ("normalised_innovation", np.float64),    # of the last zero-velocity update
]
# fmt: on
LAYOUT = np.dtype(
    [
        *ESTIMATE,
        *LAST_SAMPLE,
        *ALIGNMENT,
        *COMPASS,
        *GATE,
        *STEPS,
        *LEVEL_GROUND,
        *QUIET_FIELD,
        *NORTH,
        *COUNTS,
    ],
    align=True,
)
FilterState = np.record


def fresh_state() -> FilterState:
    """Return the memory of a filter that has seen nothing."""
    state = np.zeros(1, LAYOUT).view(np.recarray)[0]
    state.quat_xyzw[3] = 1.0
    state.aligning = True
    for stamp in ("last_ns", "alignment_start_ns", "last_accepted_ns"):
        state[stamp] = NO_STAMP
    state.end_ns[:] = NO_STAMP
    state.floor_m = np.nan
    return state

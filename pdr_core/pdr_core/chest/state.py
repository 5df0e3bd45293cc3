"""All that the chest remembers between two samples: one numpy record, copied, saved and restored as one."""

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import NO_STAMP

BUCKETS = 10  # that a window of the rest test is made of
# each of them: samples; sums of |f|, ||f| - g|, |w|, |w - reference| and w
SEEN, SEEN_FORCE, SEEN_OFF, SEEN_RATE, SEEN_SPREAD, SEEN_TURN = range(6)

# fmt: off
ESTIMATE = [
    ("position_m", np.float64, 3),            # world frame
    ("velocity_mps", np.float64, 3),          # world frame
    ("quat_xyzw", np.float64, 4),             # world from chest
    ("gyro_bias_radps", np.float64, 3),       # gB of eq. 2
    ("bias_variance", np.float64),            # of each axis [rad^2/s^2]
    ("force_scale", np.float64),              # g by aSF of eq. 2
    ("feedback_radps", np.float64, 3),        # -alpha of eq. 5
    ("feedback_until_ns", np.int64),
    ("level_axes", np.float64, (3, 3)),       # what counts as ahead, left and up, in the sensor's axes
    ("aligned", np.bool_),                    # there has been a rest
]
LAST_SAMPLE = [
    ("last_ns", np.int64),                    # NO_STAMP: none yet
    ("last_force_mps2", np.float64, 3),       # scaled
    ("last_rate_radps", np.float64, 3),       # as measured
    ("coasting", np.bool_),                   # the last interval was not integrated
]
REST = [
    ("bucket_ns", np.int64),                  # start of the open bucket
    ("bucket", np.float64, 20),               # sums over its samples, see rest.py
    ("ring", np.float64, (BUCKETS, 8)),
    ("ring_next", np.int64),
    ("ring_filled", np.int64),
    ("rest_reference_mps2", np.float64),      # that |f| is compared with
    ("rest_reference_radps", np.float64, 3),  # that w is compared with, to see whether it is constant
    ("constant_ns", np.int64),                # since when it has been, with a force that is one of a rest; NO_STAMP
    ("resting", np.bool_),
    ("rest_start_ns", np.int64),
    ("rest_sums", np.float64, 20),            # of its buckets
    ("rest_angle_rad", np.float64, 3),        # integral of the rate since it began
    ("rest_bias_radps", np.float64, 3),       # what was known of the bias before this rest
    ("rest_bias_variance", np.float64),
    ("held_m", np.float64, 3),                # where it rests
    ("held_yaw_rad", np.float64),
    ("rest_end_ns", np.int64),                # of the last rest
]
STEP = [
    ("low_mps2", np.float64, 2),              # |f| - g behind each pole of the low-pass
    ("armed", np.bool_),                      # it was far enough below zero
    ("step_start_ns", np.int64),              # NO_STAMP: no step is under way
    ("step_start_m", np.float64, 3),
    ("step_start_sd_m", np.float64),          # position_sd_m then
    ("step_force", np.float64, 3),            # integral of the force in the world frame [m/s]
    ("step_s", np.float64),                   # of the intervals in it
    ("step_figures", np.float64, 5),          # samples, sum, largest, least, sum of magnitudes of |f| - g
    ("step_yaw", np.float64, 2),              # integrals of cosine and sine of the yaw
    ("yaw_from_rad", np.float64, 2),          # of the chest as the step before began, and as this one did
    ("step_number", np.int64),
    ("since_rest", np.int64),                 # steps
    ("uneven", np.int64),                     # steps in a row whose mean force is no weight
    ("level_due", np.bool_),                  # the tilt is not known: level by the next whole stride
    ("level_ns", np.int64),                   # when it was lost, or last found
    ("releveled", np.bool_),                  # by the step that ends: its sums are of the wrong tilt
    ("settle_ns", np.int64),                  # since when the speed is off by nobody knows what; NO_STAMP: it is not
    ("stepped_ns", np.int64),                 # when the last step ended, or a rest
    ("idle", np.bool_),                       # for so long that there is no walk
    ("walk_mps", np.float64, 2),              # mean velocity of the last uniform step, ahead and left; 0: unknown
    ("walking", np.bool_),                    # there was one since the last rest
    ("force_before", np.float64, 3),          # step_force, step_s and step_yaw of the step before; 0: there is none
    ("s_before", np.float64),
    ("yaw_before", np.float64, 2),
    ("even_ns", np.int64),                    # end of the last uniform step, or of a rest since; NO_STAMP: none
    ("even_m", np.float64, 3),
]
DOUBT = [
    ("position_sd_m", np.float64),
    ("velocity_sd_mps", np.float64),
    ("yaw_sd_rad", np.float64),
]
COUNTS = [
    ("samples", np.int64),
    ("gaps", np.int64),
    ("rests", np.int64),
    ("fed_back", np.int64),                   # steps
    ("levelled", np.int64),                   # steps that had to level the chest anew
    ("placed", np.int64),                     # poses that somebody has told
    ("idled", np.int64),                      # times
    ("moved", np.bool_),                      # steps came before any rest
]
# fmt: on
LAYOUT = np.dtype([*ESTIMATE, *LAST_SAMPLE, *REST, *STEP, *DOUBT, *COUNTS], align=True)
ChestState = np.record
UNKNOWN_BIAS_VARIANCE = 0.05**2  # of a gyro that was never at rest: 3 deg/s
UNKNOWN_M, UNKNOWN_SPEED_SD_MPS = 20.0, 1.5  # of who was never at rest


def state_of(row: NDArray[np.void]) -> ChestState:
    """Return the memory in an array of one row, which goes on living in it."""
    return row.view(np.recarray)[0]


def fresh_state() -> ChestState:
    """Return the memory of a chest that has felt nothing."""
    state = state_of(np.zeros(1, LAYOUT))
    state.quat_xyzw[3] = state.force_scale = 1.0
    state.level_axes[:] = np.eye(3)
    state.bias_variance = UNKNOWN_BIAS_VARIANCE
    state.position_sd_m, state.velocity_sd_mps, state.yaw_sd_rad = UNKNOWN_M, UNKNOWN_SPEED_SD_MPS, np.pi
    for stamp in (
        "last_ns",
        "bucket_ns",
        "constant_ns",
        "step_start_ns",
        "rest_end_ns",
        "rest_start_ns",
        "feedback_until_ns",
        "even_ns",
        "level_ns",
        "settle_ns",
        "stepped_ns",
    ):
        state[stamp] = NO_STAMP
    return state

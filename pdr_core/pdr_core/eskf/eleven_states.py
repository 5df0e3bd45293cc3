"""The filter of 11 states (paper 004, eq. 1-3): without yaw error and gyro bias, which zero velocities do not show.

It is the filter of 15 states with those four held at zero variance: their rows and columns of P are zero, so no update
touches them, and the rest of F, H and P is that of eq. 2 and 3. (Eq. 2 prints the rotation without the interval that it
acts for; its signs are those of errors that are estimate minus truth, ours are the other way round.) The gyro bias
comes from rests alone, shrunk by what sensors usually bring. A heading observation is taken whole: who gives it has
weighed it (eq. 8-11), and it turns what follows, not the track so far.
"""

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.eskf.error_state import ATTITUDE, GYRO_BIAS
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import from_rotation_vector, multiply, normalised, rows
from pdr_core.maths.vector import Vector, difference, rotated, scaled
from pdr_core.records import Floats

YAW = ATTITUDE + 2


def estimated(sd: Floats, heading_states: bool) -> Floats:
    """Return the deviations (15,) of the start, none for what is no state."""
    held = np.arange(len(sd)) >= GYRO_BIAS
    held[YAW] = True
    return sd if heading_states else np.where(held, 0.0, sd)


@compiled
def turn_back(yaw_error_rad: float, state: FilterState) -> None:
    """Turn the foot and its velocity back about the vertical."""
    turn = from_rotation_vector((0.0, 0.0, -yaw_error_rad))
    state.quat_xyzw[:] = normalised(multiply(turn, state.quat_xyzw))
    c, s = np.cos(yaw_error_rad), np.sin(yaw_error_rad)
    x, y = state.velocity_mps[0], state.velocity_mps[1]
    state.velocity_mps[0], state.velocity_mps[1] = c * x + s * y, c * y - s * x


@compiled
def take_rest(rest_rate_radps: Vector, rest_sd_radps: float, usual_sd_radps: float, state: FilterState) -> None:
    """Take the gyro bias from a rest; before the first step, take back by how much it has turned the foot so far."""
    share = usual_sd_radps**2 / (usual_sd_radps**2 + rest_sd_radps**2)
    bias = scaled(share, rest_rate_radps)
    new = rotated(rows(state.quat_xyzw), difference(bias, state.gyro_bias_radps))
    if state.end_ns[0] == NO_STAMP:
        turn_back(new[2] * (state.last_ns - state.alignment_start_ns) * 1e-9, state)
    for i in range(3):
        state.gyro_bias_radps[i] = bias[i]

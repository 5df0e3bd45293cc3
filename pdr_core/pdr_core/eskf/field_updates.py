"""What a quiet stance in a magnetic field tells the filter: the gyro bias, and where the field is clean the heading."""

import numpy as np

from pdr_core.eskf import field_change, field_heading, rare_bias
from pdr_core.eskf.error_state import SIZE
from pdr_core.eskf.field_places import CHANGE, HEADING, clean, visited
from pdr_core.eskf.last_stances import correct_ends
from pdr_core.eskf.quiet_field import QuietField
from pdr_core.eskf.settings import FieldSettings
from pdr_core.eskf.state import PLACES, FilterState
from pdr_core.eskf.updates import inject, learn
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import correct, correct_cross, estimated_error, gain, innovation, normalised_squared
from pdr_core.maths.quaternion import rows
from pdr_core.maths.vector import Vector, product, rotated


@compiled
def stand_in_field(field: QuietField, s: FieldSettings, state: FilterState) -> None:
    """Take into the estimate what a quiet stance has shown of the field, as far as the field allows."""
    field_changed(field, s, state)
    world = rotated(rows(state.quat_xyzw), field.field_now_tesla)
    if s.use == HEADING and visited(world, state):
        used = clean(s, state) and heading_corrected(world, s, state)
        state.field_use = HEADING if used else CHANGE


@compiled
def field_changed(field: QuietField, s: FieldSettings, state: FilterState) -> None:
    """Tell the filter the gyro bias that the change of the field in a quiet stance shows."""
    H, sd = field_change.H(field.mean_tesla), field_change.deviation(field, s.offset_sd_tesla)
    rare_bias.testify(field, sd, state)
    y = innovation(state.P, H, np.eye(3) * sd**2, np.array(field.change_tesla_per_s))
    if normalised_squared(y) > s.gate:
        state.field_rejected += 1
    else:
        state.field_windows += 1
        state.field_use = max(state.field_use, CHANGE)
        learn(y, H, state)


@compiled
def heading_corrected(field_tesla: Vector, s: FieldSettings, state: FilterState) -> bool:
    """Tell the filter and its north where the field (world frame) of a clean place points; return if they agree.

    What bends a field does so over some metres: all places of the memory together count as one.
    """
    if not field_heading.known(state):
        field_heading.find(field_tesla, s.heading_sd_rad, state)
        return True
    P, H = field_heading.with_north(state), field_heading.H(field_tesla)
    R, residual = np.eye(1) * s.heading_sd_rad**2, field_heading.residual(field_tesla, state)
    if normalised_squared(innovation(P, H, R, residual)) > s.heading_gate:
        return False
    y = innovation(P, H, R * PLACES, residual)
    K = gain(y)
    error = estimated_error(K, y)
    inject(state, error[:SIZE])
    state.north_rad += error[SIZE]
    HC = product(np.ascontiguousarray(H[:, :SIZE]), state.cross) - state.north_ends
    correct_ends(y, HC, state)
    correct_cross(state.cross, np.ascontiguousarray(K[:SIZE]), HC)
    state.north_ends[:] -= K[SIZE, 0] * HC
    correct(P, K, y)
    field_heading.split(P, state)
    return True

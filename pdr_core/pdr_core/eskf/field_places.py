"""Is the field clean enough for a compass? The places where the foot has stood tell.

The Earth's field is the same all over a walk: its strength, its dip below the horizon, and its azimuth beside a gyro
that hardly drifts within some strides. Iron bends all three, and differently from place to place: indoors, at the
height of a foot, by 20 %, 10 and 20 degrees. So the direction of the field is believed where all of the last places
agree with one another, this one included. A disturbance is let in only if it bends them all alike.

A magnetometer that is not calibrated agrees with itself too, as long as the foot points the same way. So the places
must agree with the strength and the dip of the field in which north was found, after a turn as before it; and with what
the parameters say of the Earth's field, if they do.
"""

import numpy as np

from pdr_core.eskf.settings import FieldSettings
from pdr_core.eskf.state import PLACES, FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.magnetic import UP, alike, alike_angles, azimuth_rad, dip_rad, same_field
from pdr_core.maths.vector import Vector, difference, norm

NONE, CHANGE, HEADING = 0, 1, 2  # what is used of the field: the values of records.FieldUse
APART_M = 0.3  # nearer places show the same iron


@compiled
def visited(field_tesla: Vector, state: FilterState) -> bool:
    """Note the field (world frame) where the foot stands; return whether this is another place than the last one."""
    if state.places > 0 and norm(difference(state.position_m, state.place_m)) < APART_M:
        return False
    here = state.places % PLACES
    state.place_m[:] = state.position_m
    state.place_norm_tesla[here] = norm(field_tesla)
    state.place_dip_rad[here] = dip_rad(UP, field_tesla)
    state.place_azimuth_rad[here] = azimuth_rad(field_tesla)
    state.places += 1
    return True


@compiled
def clean(s: FieldSettings, state: FilterState) -> bool:
    """Return whether the last places agree, with one another and with what else is known of the field."""
    if state.places < PLACES:
        return False
    strength, dip = np.mean(state.place_norm_tesla), np.mean(state.place_dip_rad)
    if not (
        alike(state.place_norm_tesla / strength, s.norm_tolerance) and alike(state.place_dip_rad, s.dip_tolerance_rad)
    ):
        return False
    if not alike_angles(state.place_azimuth_rad, s.azimuth_tolerance_rad):
        return False
    known = s.norm_tesla == 0.0 or near(strength, dip, s.norm_tesla, s.dip_rad, s)
    return known and (
        state.north_norm_tesla == 0.0 or near(strength, dip, state.north_norm_tesla, state.north_dip_rad, s)
    )


@compiled
def near(norm_tesla: float, dip: float, other_norm_tesla: float, other_dip_rad: float, s: FieldSettings) -> bool:
    """Return whether two fields are alike in strength and dip."""
    return same_field(norm_tesla, dip, other_norm_tesla, other_dip_rad, s.norm_tolerance, s.dip_tolerance_rad)

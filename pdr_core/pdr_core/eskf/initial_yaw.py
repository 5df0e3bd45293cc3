"""The yaw at the start by a calibrated magnetometer (Gui section 5.2), where the field of the first rest allows it.

Gravity has levelled the foot; turned by that attitude, with a yaw of zero, the mean field of the first second has the
azimuth alpha. The world is ENU, so magnetic north lies at pi/2 less the declination, and the yaw is north - alpha. The
mean field has then exactly north's azimuth. By the linear model of `field_heading.py` that azimuth was, in truth,
north = alpha_true + noise = north + H e + noise, with H = [h', 1] on the errors e of tilt and yaw, so

    e_yaw = -h' e_tilt - noise      P_yaw,. = -h' P_tilt,.      P_yaw = h' P_tilt h + s^2

It is Kalman's update of a yaw of which nothing was known. A wrong tilt turns the compass by tan(dip) times itself.

One place cannot show whether iron bends its field. Where `pdr calibrate mag` has told the strength and the dip of the
Earth's field, this field must agree with them, and s is that of any clean place. Where nobody knows them all that can
be asked is the strength of the Earth's field anywhere, and s is what iron in buildings does to the azimuth. The filter
knows from then on where north is: later clean places correct the yaw itself, see `field_updates.py`.
"""

import numpy as np

from pdr_core.conventions import EARTH_FIELD_TESLA, NANOSECONDS
from pdr_core.eskf.error_state import ATTITUDE, SIZE
from pdr_core.eskf.field_places import near
from pdr_core.eskf.settings import FieldSettings, Settings
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.levelling import levelled
from pdr_core.maths.magnetic import UP, azimuth_by_rotation, azimuth_rad, dip_rad
from pdr_core.maths.quaternion import rows
from pdr_core.maths.vector import Triple, Vector, dot, norm, product, rotated, scaled
from pdr_core.records import Floats

WATCHED_NS = NANOSECONDS  # a magnetometer of 5 Hz shows itself in that time
FEWEST = 3
LEVEL_SHARE = 0.1  # less of the field is level beyond a dip of 84 deg: no compass
IRON_SD_RAD = 0.35  # 20 deg: azimuths at floor level in buildings differ by 15 to 32 deg (measured on real walks)
NORTH_SD_RAD = 1e-3  # it defines the world frame
UNDECIDED, FOUND, MOVED, TOO_FEW, UNSTEADY, STEEP, NOT_EARTHS, NOT_PLACES = range(8)


@compiled
def watch(field_tesla: Vector, field_sd_tesla: float, state: FilterState) -> None:
    """Take the field of a sample into the mean; a deviation below 0: it has none."""
    if field_sd_tesla < 0.0:
        return
    state.compass_fields += 1
    state.compass_square_sum += dot(field_tesla, field_tesla)
    state.compass_variance_sum += field_sd_tesla**2
    for i in range(3):
        state.compass_sum_tesla[i] += field_tesla[i]


@compiled
def decide(s: Settings, state: FilterState) -> None:
    """Turn the levelled foot to the yaw that the mean field shows, where the field allows it."""
    state.compass = TOO_FEW if state.compass_fields < FEWEST else MOVED if state.moved else UNDECIDED
    if state.compass != UNDECIDED:
        return
    level = levelled(state.force_sum_mps2, 0.0)
    mean = scaled(1.0 / state.compass_fields, state.compass_sum_tesla)
    field = rotated(rows(level), mean)
    state.compass = verdict(field, s.field, state)
    if state.compass == FOUND:
        north_rad = 0.5 * np.pi - s.field.declination_rad
        yaw_rad = north_rad - azimuth_rad(field)
        yaw_rad -= 2.0 * np.pi * np.round(yaw_rad / (2.0 * np.pi))
        state.compass_yaw_rad = yaw_rad
        state.quat_xyzw[:] = levelled(state.force_sum_mps2, yaw_rad)
        know(rotated(rows(state.quat_xyzw), mean), north_rad, s.field, state)


@compiled
def verdict(field_tesla: Triple, s: FieldSettings, state: FilterState) -> int:
    """Return what is to be said of the mean field, levelled (z up)."""
    n, strength, dip = state.compass_fields, norm(field_tesla), dip_rad(UP, field_tesla)
    unrest = state.compass_square_sum / n - strength**2 - 3.0 * state.compass_variance_sum / n
    if unrest > (s.norm_tolerance * strength) ** 2:
        return UNSTEADY
    if np.hypot(field_tesla[0], field_tesla[1]) < LEVEL_SHARE * strength:
        return STEEP
    if s.norm_tesla > 0.0:
        return FOUND if near(strength, dip, s.norm_tesla, s.dip_rad, s) else NOT_PLACES
    return FOUND if EARTH_FIELD_TESLA[0] <= strength <= EARTH_FIELD_TESLA[1] else NOT_EARTHS


@compiled
def know(field_tesla: Triple, north_rad: float, s: FieldSettings, state: FilterState) -> None:
    """Note how well the yaw is known by the field (world frame), and where north is."""
    h = tilt_jacobian(field_tesla)
    hP = product(h, state.P)
    noise_rad = np.sqrt(state.compass_variance_sum) / state.compass_fields / np.hypot(field_tesla[0], field_tesla[1])
    sd_rad = np.hypot(noise_rad, s.heading_sd_rad if s.norm_tesla > 0.0 else IRON_SD_RAD)
    variance = product(hP, h.T)[0, 0] + sd_rad**2
    yaw = ATTITUDE + 2
    state.P[yaw, :] = -hP[0]
    state.P[:, yaw] = -hP[0]
    state.P[yaw, yaw] = variance
    state.compass_yaw_sd_rad = np.sqrt(variance)
    state.north_norm_tesla, state.north_dip_rad = norm(field_tesla), dip_rad(UP, field_tesla)
    state.north_rad, state.north_variance = north_rad, NORTH_SD_RAD**2


@compiled
def tilt_jacobian(field_tesla: Vector) -> Floats:
    """Return h, (1, 15): how the azimuth of a field (world frame) moves with all errors but that of the yaw."""
    h = np.zeros((1, SIZE))
    turned = azimuth_by_rotation(field_tesla)
    h[0, ATTITUDE], h[0, ATTITUDE + 1] = turned[0], turned[1]
    return h

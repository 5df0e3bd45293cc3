"""The magnetic field along a walk, in the world frame: the Earth's, that of a building's iron, one that is switched on.

Iron below a floor makes a field without sources or curls above it, so its potential is a sum of modes

    phi = A / k cos(k n x + a) exp(-k z),    B = -grad phi = A (n sin(k n x + a), cos(k n x + a)) exp(-k z)

with a level direction n and a wave number k. Heights are left out, z = 0: there is iron below every floor, and only a
standing foot is asked for the field.
"""

import numpy as np

from pdr_core.params import SimulationParams
from pdr_core.records import Floats

BUILDING = 9  # this stream of a seed
MODES = 12
WAVELENGTH_M = (2.0, 8.0)  # so that strides of a walk meet new iron, and a standing foot a constant field


def field_tesla(params: SimulationParams, time_s: Floats, position_m: Floats) -> Floats:
    """Return the field in the world frame (east, north, up), (n, 3) [T], at n times [s] and places (n, 3) [m]."""
    field = earth_tesla(params) + switched_tesla(params, time_s)
    if params.indoor_field > 0.0:
        field += building_tesla(params.indoor_field * params.field_norm_tesla, params.seed, position_m)
    return field


def earth_tesla(params: SimulationParams) -> Floats:
    """Return the Earth's field, (3,) [T]: a positive dip points down, a positive declination to the east."""
    dip_rad, declination_rad = np.radians([params.field_dip_deg, params.field_declination_deg])
    level = np.cos(dip_rad) * np.array([np.sin(declination_rad), np.cos(declination_rad)])
    return params.field_norm_tesla * np.append(level, -np.sin(dip_rad))


def switched_tesla(params: SimulationParams, time_s: Floats) -> Floats:
    """Return the field that is switched on for some time, (n, 3) [T]."""
    azimuth_rad = np.radians(params.disturbance_azimuth_deg)
    field = params.disturbance_tesla * np.array([np.cos(azimuth_rad), np.sin(azimuth_rad), 0.0])
    since_s = time_s - params.disturbance_start_s
    return ((since_s >= 0.0) & (since_s < params.disturbance_s))[:, None] * field


def building_tesla(strength_tesla: float, seed: int, position_m: Floats) -> Floats:
    """Return the field of a building's iron, (n, 3) [T]: its vertical part has the strength as its root mean square.

    Each level axis has half the power, since a mode points along its own direction only.
    """
    rng = np.random.default_rng([seed, BUILDING])
    azimuth_rad, phase_rad = rng.uniform(0.0, 2.0 * np.pi, (2, MODES))
    wave_number = 2.0 * np.pi / np.exp(rng.uniform(*np.log(WAVELENGTH_M), MODES))
    ahead = np.column_stack([np.cos(azimuth_rad), np.sin(azimuth_rad)])
    angle_rad = position_m[:, :2] @ (wave_number[:, None] * ahead).T + phase_rad
    level, upright = np.sin(angle_rad) @ ahead, np.cos(angle_rad).sum(axis=1)
    return strength_tesla * np.sqrt(2.0 / MODES) * np.column_stack([level, upright])

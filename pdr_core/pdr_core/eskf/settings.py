"""The filter's parameters in the form that compiled code takes."""

from typing import NamedTuple

from pdr_core.eskf.process import ProcessNoise
from pdr_core.records import Floats


class FieldSettings(NamedTuple):
    """What the filter may take of the magnetic field."""

    use: int  # at most: NONE, CHANGE or HEADING of field_places.py
    offset_sd_tesla: float
    gate: float
    norm_tesla: float  # 0: nobody knows
    dip_rad: float
    declination_rad: float
    norm_tolerance: float
    dip_tolerance_rad: float
    azimuth_tolerance_rad: float
    heading_sd_rad: float
    heading_gate: float


class Settings(NamedTuple):
    """Numbers only; times in nanoseconds where they are compared with stamps."""

    process: ProcessNoise
    heading_states: bool
    gyro_bias_sd_radps: float  # what the sensor may bring
    samples: int  # POINTS, MEANS or AVERAGES of strapdown/samples.py
    gravity_mps2: float
    gravity_from_rest: bool
    alignment_ns: int
    initial_yaw_rad: float
    compass_start: bool  # the field gives the yaw at the start
    initial_sd: Floats  # (15,)
    zero_velocity_sd_mps: float
    contact_height_m: float
    huber: float
    gate: float
    release_s: float
    merge_ns: int
    step_min_m: float
    step_turn_min_rad: float
    level_ground: bool
    floor_limit_m: float
    floor_sd_m: float
    field: FieldSettings

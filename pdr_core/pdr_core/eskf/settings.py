"""The filter's parameters in the form that compiled code takes."""

from typing import NamedTuple

from pdr_core.eskf.process import ProcessNoise
from pdr_core.records import Floats


class Settings(NamedTuple):
    """Numbers only; times in nanoseconds where they are compared with stamps."""

    process: ProcessNoise
    samples: int  # POINTS, MEANS or AVERAGES of strapdown/samples.py
    gravity_mps2: float
    gravity_from_rest: bool
    alignment_ns: int
    initial_yaw_rad: float
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

"""What the compiled loop needs of the parameters."""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import gravity_mps2, nanoseconds
from pdr_core.parameter import choices_of
from pdr_core.params import ChestParams, PlaceParams

METHODS = choices_of(ChestParams, "method")
IMPROVED, TRADITIONAL, INERTIAL = range(3)


class Settings(NamedTuple):
    """Numbers only."""

    method: int
    gravity_mps2: float
    bucket_ns: int
    static_accel_mps2: float
    static_gyro_radps: float
    sways: bool  # a rest is fitted, not averaged
    sway_sd_rad: float
    bias_wander_radps: float
    feedback_per_s: float
    traditional_per_s: float
    swing_mps2: float
    lowpass_radps: float
    step_min_ns: int
    step_max_ns: int
    start_steps: int
    uniform_accel_mps2: float
    steady_steps: int
    directed: bool  # a step that should be has a direction
    step_sd_m: float
    level_ground: bool
    tilt_sd_rad: float


def settings(p: ChestParams, place: PlaceParams, buckets: int) -> Settings:
    """Derive the settings from the parameters; a window of the rest test has so many buckets."""
    return Settings(
        method=METHODS.index(p.method),
        gravity_mps2=gravity_mps2(np.radians(place.latitude_deg), place.height_m),
        bucket_ns=nanoseconds(p.static_window_s / buckets),
        static_accel_mps2=p.static_accel_mps2,
        static_gyro_radps=p.static_gyro_radps,
        sways=p.static_correction == "fit",
        sway_sd_rad=p.sway_sd_rad,
        bias_wander_radps=p.bias_wander_radps,
        feedback_per_s=p.feedback_per_s,
        traditional_per_s=p.traditional_feedback_per_s,
        swing_mps2=p.step_swing_mps2,
        lowpass_radps=2.0 * np.pi * p.step_lowpass_hz,
        step_min_ns=nanoseconds(p.step_min_s),
        step_max_ns=nanoseconds(p.step_max_s),
        start_steps=p.start_steps,
        uniform_accel_mps2=p.uniform_accel_mps2,
        steady_steps=p.steady_steps,
        directed=p.step_direction == "chest",
        step_sd_m=p.step_sd_m,
        level_ground=p.level_ground,
        tilt_sd_rad=p.tilt_sd_rad,
    )

"""The orientation filter's parameters in the form that compiled code takes."""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import gravity_mps2, nanoseconds
from pdr_core.params import Params
from pdr_core.strapdown.samples import KINDS


class Settings(NamedTuple):
    """Numbers only."""

    samples: int  # POINTS, MEANS or AVERAGES of strapdown/samples.py
    gravity_mps2: float
    alignment_ns: int
    initial_yaw_rad: float
    initial_tilt_sd_rad: float
    initial_yaw_sd_rad: float
    initial_gyro_bias_sd_radps: float
    gyro_bias_walk: float
    gap_rate_radps: float
    gate: float
    release_s: float
    accel_bias_tilt_rad: float  # by how much a resting accelerometer's bias tilts
    accel_sd_mps2: float
    accel_correlation_s: float
    motion_share: float
    motion_per_rate: float
    motion_memory_s: float
    use_field: bool
    field_sd_rad: float
    field_correlation_s: float
    field_norm_share: float
    field_dip_rad: float


def settings(params: Params) -> Settings:
    """Return the settings that the parameters mean."""
    p, f = params.attitude, params.filter
    gravity = gravity_mps2(np.radians(params.place.latitude_deg), params.place.height_m)
    return Settings(
        samples=KINDS[f.samples],
        gravity_mps2=gravity,
        alignment_ns=nanoseconds(f.alignment_s),
        initial_yaw_rad=f.initial_yaw_rad,
        initial_tilt_sd_rad=f.initial_tilt_sd_rad,
        initial_yaw_sd_rad=f.initial_yaw_sd_rad,
        initial_gyro_bias_sd_radps=f.initial_gyro_bias_sd_radps,
        gyro_bias_walk=f.gyro_bias_walk,
        gap_rate_radps=f.gap_rate_radps,
        gate=f.gate,
        release_s=f.gate_release_s,
        accel_bias_tilt_rad=f.initial_accel_bias_sd_mps2 / gravity,
        accel_sd_mps2=p.accel_sd_mps2,
        accel_correlation_s=p.accel_correlation_s,
        motion_share=p.motion_share,
        motion_per_rate=p.motion_per_rate,
        motion_memory_s=p.motion_memory_s,
        use_field=p.use_field,
        field_sd_rad=p.field_sd_rad,
        field_correlation_s=p.field_correlation_s,
        field_norm_share=p.field_norm_share,
        field_dip_rad=p.field_dip_rad,
    )

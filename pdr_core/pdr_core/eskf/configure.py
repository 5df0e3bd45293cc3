"""From parameters to the settings of the compiled filter; apart, so that a new parameter compiles nothing anew."""

import numpy as np

from pdr_core.conventions import gravity_mps2, nanoseconds
from pdr_core.eskf.eleven_states import estimated
from pdr_core.eskf.field_places import CHANGE, HEADING, NONE
from pdr_core.eskf.process import ProcessNoise
from pdr_core.eskf.settings import FieldSettings, Settings
from pdr_core.params import FilterParams, PlaceParams
from pdr_core.records import Floats
from pdr_core.strapdown.samples import KINDS

USES = {"off": NONE, "change": CHANGE, "auto": HEADING}


def settings(params: FilterParams, place: PlaceParams) -> Settings:
    """Derive the settings from the parameters."""
    p = params
    return Settings(
        process=process_noise(p),
        heading_states=p.heading_states,
        gyro_bias_sd_radps=p.initial_gyro_bias_sd_radps,
        samples=KINDS[p.samples],
        gravity_mps2=gravity_mps2(np.radians(place.latitude_deg), place.height_m),
        gravity_from_rest=p.gravity_source == "rest",
        alignment_ns=nanoseconds(p.alignment_s),
        initial_yaw_rad=p.initial_yaw_rad,
        compass_start=p.initial_yaw_source == "magnetometer",
        initial_sd=estimated(initial_deviations(p), p.heading_states),
        zero_velocity_sd_mps=p.zero_velocity_sd_mps,
        contact_height_m=p.contact_height_m,
        huber=p.huber,
        gate=p.gate,
        release_s=p.gate_release_s,
        merge_ns=nanoseconds(p.step_merge_s),
        step_min_m=p.step_min_m,
        step_turn_min_rad=p.step_turn_min_rad,
        level_ground=p.level_ground,
        floor_limit_m=p.floor_limit_m,
        floor_sd_m=p.floor_sd_m,
        field=field_settings(params, place),
    )


def field_settings(p: FilterParams, place: PlaceParams) -> FieldSettings:
    """Derive what the filter may take of the magnetic field."""
    return FieldSettings(
        USES[p.magnetometer],
        p.field_offset_sd_tesla,
        p.field_gate,
        place.field_norm_tesla,
        float(np.radians(place.field_dip_deg)),
        float(np.radians(place.field_declination_deg)),
        p.field_norm_tolerance,
        p.field_dip_tolerance_rad,
        p.field_azimuth_tolerance_rad,
        p.field_heading_sd_rad,
        p.field_heading_gate,
    )


def process_noise(p: FilterParams) -> ProcessNoise:
    """Return what drives the errors; a gyro bias that is no state does not wander."""
    gyro_bias_walk = p.gyro_bias_walk if p.heading_states else 0.0
    return ProcessNoise(p.accel_bias_walk, gyro_bias_walk, p.bias_correlation_s, p.gap_speed_mps, p.gap_rate_radps)


def initial_deviations(p: FilterParams) -> Floats:
    """Return how well the 15 errors are known at the start."""
    position_and_velocity = [p.initial_position_sd_m] * 3 + [p.initial_velocity_sd_mps] * 3
    attitude = [p.initial_tilt_sd_rad] * 2 + [p.initial_yaw_sd_rad]
    biases = [p.initial_accel_bias_sd_mps2] * 3 + [p.initial_gyro_bias_sd_radps] * 3
    return np.array(position_and_velocity + attitude + biases)

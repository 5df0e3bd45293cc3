"""From the filter's health to its message."""

from pdr_core import records
from pdr_msgs.msg import FilterHealth
from pdr_nodes.convert import time_message, vector


def health_message(
    health: records.FilterHealth, notices: list[records.Notice], world_frame: str, foot_frame: str
) -> FilterHealth:
    """Return the filter's health as a message."""
    message = FilterHealth(child_frame_id=foot_frame, state=health.mode.value)
    message.header.stamp = time_message(health.stamp_ns)
    message.header.frame_id = world_frame
    message.nav_quality = health.quality
    message.samples = health.samples
    message.zero_velocity_updates = health.accepted
    message.zero_velocity_contradictions = health.contradicted
    message.gaps = health.gaps
    message.resets = health.resets
    message.since_zero_velocity = health.since_zero_velocity_s
    message.normalised_innovation = health.normalised_innovation
    message.position_stddev = health.position_sd_m
    message.height_stddev = health.height_sd_m
    message.velocity_stddev = health.velocity_sd_mps
    message.tilt_stddev = health.tilt_sd_rad
    message.yaw_stddev = health.yaw_sd_rad
    message.gyro_bias = vector(health.gyro_bias_radps)
    message.gyro_bias_stddev = vector(health.gyro_bias_sd_radps)
    message.accel_bias = vector(health.accel_bias_mps2)
    message.accel_bias_stddev = vector(health.accel_bias_sd_mps2)
    message.gravity = health.gravity_mps2
    message.field_use = health.field_use.value
    message.north = health.north_rad
    message.north_stddev = health.north_sd_rad
    message.notices = [notice.text for notice in notices]
    return message

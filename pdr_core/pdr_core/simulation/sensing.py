"""From the motion of a foot to the samples of the sensor on it."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.conventions import gravity_mps2, seconds_between, stamp_ns_from_seconds
from pdr_core.maths import quaternion
from pdr_core.maths.vector import each_rotated
from pdr_core.parameter import ParameterError
from pdr_core.params import PlaceParams, SimulationParams
from pdr_core.records import Floats, ImuBlock, Stamps
from pdr_core.simulation.imu_model import SensorModel, answered, earth_in_foot, point_samples, sensed
from pdr_core.simulation.increments import interval_means
from pdr_core.simulation.magnetic_field import field_tesla
from pdr_core.simulation.magnetometer import about_the_sensor, at_rate, with_field
from pdr_core.simulation.motion import Course, Motion
from pdr_core.simulation.sensors import SENSOR_MODELS
from pdr_core.simulation.shocks import shocks_mps2


class Followed(NamedTuple):
    """The motion at the stamps of all samples, or, for a sensor with a low-pass, `often` times as closely."""

    often: int
    rate_hz: float  # of what follows
    stamp_ns: Stamps  # (n,)
    time_s: Floats  # (n,) since the start
    motion: Motion
    strikes_s: Floats  # (strides,)


def chosen_sensor(params: SimulationParams, model: SensorModel | None) -> SensorModel:
    """Return the sensor, or the one that the parameters name, with the ranges that they give; 0 leaves its own.

    ParameterError of means from a sensor with a low-pass: it samples, it does not integrate.
    """
    sensor = model or SENSOR_MODELS[params.sensor_model]
    if sensor.filters and params.output == "means":
        text = "simulation.output = 'means': this sensor has a low-pass and does not integrate; set it to points"
        raise ParameterError(text)
    return replace(
        sensor,
        gyro_range_radps=params.gyro_range_radps or sensor.gyro_range_radps,
        accel_range_mps2=params.accel_range_mps2 or sensor.accel_range_mps2,
    )


def followed(path: Course, params: SimulationParams, sensor: SensorModel, start_ns: int) -> Followed:
    """Return the motion along a course as closely as the sensor needs it; it begins at `start_ns`."""
    often = sensor.oversampling(params.sample_rate_hz)
    rate_hz = params.sample_rate_hz * often
    samples = round(path.duration_s * params.sample_rate_hz)
    stamp_ns = stamp_ns_from_seconds(np.arange(samples * often) / rate_hz) + start_ns
    time_s = seconds_between(stamp_ns, start_ns)
    return Followed(often, rate_hz, stamp_ns, time_s, path.at(time_s), path.strikes_s)


def inertial(f: Followed, params: SimulationParams, place: PlaceParams, sensor: SensorModel, seed: int) -> ImuBlock:
    """Return the samples of gyro and accelerometer; the seed is the sensor's."""
    gyro, accel = felt(params, place, f.stamp_ns, f.motion)
    if params.shock_mps2 > 0.0:
        accel = accel + shocks_mps2(f.time_s, f.strikes_s, params.shock_mps2, seed)
    gyro, accel = in_sensor_axes(params, gyro), in_sensor_axes(params, accel)
    gyro, accel = answered(gyro, accel, f.rate_hz, sensor, seed)
    each = slice(None, None, f.often)
    return sensed(f.stamp_ns[each], gyro[each], accel[each], params.sample_rate_hz, sensor, seed)


def magnetic(f: Followed, params: SimulationParams, sensor: SensorModel, seed: int, imu: ImuBlock) -> ImuBlock:
    """Return the samples with the field; the seed is the sensor's, that of the parameters the building's."""
    world = field_tesla(params, f.time_s, f.motion.position_m)
    true = in_sensor_axes(params, Rotation.from_quat(f.motion.quat_xyzw).inv().apply(world))
    shown = about_the_sensor(true, f.rate_hz, sensor.magnetometer, seed)
    each = slice(None, None, f.often)
    measured = at_rate(f.time_s[each], params.magnetometer_rate_hz)
    return with_field(imu, shown[each], sensor.magnetometer, measured, seed)


def felt(params: SimulationParams, place: PlaceParams, stamp_ns: Stamps, motion: Motion) -> tuple[Floats, Floats]:
    """Return the true rate and specific force in the foot frame, at each stamp or over the interval before, (n, 3)."""
    latitude_rad = float(np.radians(place.latitude_deg))
    gravity = gravity_mps2(latitude_rad, place.height_m)
    if params.output == "means":
        gyro, accel = interval_means(stamp_ns, motion.position_m, motion.velocity_mps, motion.quat_xyzw, gravity)
    else:
        gyro, accel = point_samples(motion, gravity)
    return gyro + earth_in_foot(motion, latitude_rad) if params.earth_rate else gyro, accel


def in_sensor_axes(params: SimulationParams, vectors: Floats) -> Floats:
    """Return vectors of the foot frame along the axes of the sensor, (n, 3): the intake's mounting undoes it."""
    p = params
    R_foot_from_sensor = quaternion.matrix(
        quaternion.from_euler(p.mounting_roll_rad, p.mounting_pitch_rad, p.mounting_yaw_rad)
    )
    return each_rotated(np.ascontiguousarray(R_foot_from_sensor.T), vectors)

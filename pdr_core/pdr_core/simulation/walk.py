"""Whole simulated walks by name."""

from dataclasses import dataclass, replace

import numpy as np

from pdr_core.conventions import gravity_mps2, seconds_between, stamp_ns_from_seconds
from pdr_core.maths import quaternion
from pdr_core.maths.vector import each_rotated
from pdr_core.params import PlaceParams, SimulationParams
from pdr_core.records import Floats, ImuBlock, Stamps, Truth, TruthKind
from pdr_core.simulation.courses import foot_course, gui_course
from pdr_core.simulation.imu_model import SENSOR_MODELS, SensorModel, earth_in_foot, point_samples, sensed
from pdr_core.simulation.increments import interval_means
from pdr_core.simulation.motion import Course, Motion
from pdr_core.simulation.shocks import shocks_mps2


@dataclass(frozen=True)
class SimulatedWalk:
    """What the sensor measured, in its own axes, and where the foot really was."""

    imu: ImuBlock
    motion: Motion
    truth: Truth


def simulated_walk(
    params: SimulationParams, place: PlaceParams | None = None, start_ns: int = 0, model: SensorModel | None = None
) -> SimulatedWalk:
    """Simulate the walk that the parameters name; its first sample is stamped `start_ns`.

    `model` is a sensor in place of the one that they name. ParameterError if motion and walk do not go together.
    """
    return walked(course(params), params, place, start_ns, model)


def walked(
    path: Course,
    params: SimulationParams,
    place: PlaceParams | None = None,
    start_ns: int = 0,
    model: SensorModel | None = None,
) -> SimulatedWalk:
    """Simulate the walk along any course, with the sensor that the parameters name, or with `model`."""
    rate_hz = params.sample_rate_hz
    stamp_ns = stamp_ns_from_seconds(np.arange(round(path.duration_s * rate_hz)) / rate_hz) + start_ns
    time_s = seconds_between(stamp_ns, start_ns)
    motion = path.at(time_s)
    gyro, accel = felt(params, place or PlaceParams(), stamp_ns, motion)
    if params.shock_mps2 > 0.0:
        accel = accel + shocks_mps2(time_s, path.strikes_s, params.shock_mps2, params.seed)
    chosen = ranged(model or SENSOR_MODELS[params.sensor_model], params)
    imu = sensed(stamp_ns, in_sensor_axes(params, gyro), in_sensor_axes(params, accel), rate_hz, chosen, params.seed)
    return SimulatedWalk(imu, motion, Truth(TruthKind.POSITION, stamp_ns, motion.position_m))


def course(params: SimulationParams) -> Course:
    """Return the motion that the parameters name; ParameterError if it has no such walk."""
    if params.motion == "gui":
        return gui_course(params.walk, params.walk_length_m)
    return foot_course(params.walk, params.walk_length_m, params.pace)


def walk_duration_s(params: SimulationParams) -> float:
    """Return how long the walk takes [s]."""
    return course(params).duration_s


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


def ranged(model: SensorModel, params: SimulationParams) -> SensorModel:
    """Return the sensor with the ranges that the parameters give; 0 leaves its own."""
    return replace(
        model,
        gyro_range_radps=params.gyro_range_radps or model.gyro_range_radps,
        accel_range_mps2=params.accel_range_mps2 or model.accel_range_mps2,
    )

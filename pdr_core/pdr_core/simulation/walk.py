"""Whole simulated walks by name."""

from dataclasses import dataclass

from pdr_core.params import PlaceParams, SimulationParams
from pdr_core.records import ImuBlock, Truth, TruthKind
from pdr_core.simulation.courses import foot_course, gui_course
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.motion import Course, Motion, thinned
from pdr_core.simulation.sensing import chosen_sensor, followed, inertial, magnetic


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
    """Simulate the walk along any course, with the sensor that the parameters name, or with `model`.

    ParameterError if sensor and output do not go together.
    """
    sensor = chosen_sensor(params, model)
    path_followed = followed(path, params, sensor, start_ns)
    imu = inertial(path_followed, params, place or PlaceParams(), sensor)
    if params.magnetometer:
        imu = magnetic(path_followed, params, sensor, imu)
    motion = thinned(path_followed.motion, path_followed.often)
    return SimulatedWalk(imu, motion, Truth(TruthKind.POSITION, imu.stamp_ns, motion.position_m))


def course(params: SimulationParams) -> Course:
    """Return the motion that the parameters name; ParameterError if it has no such walk."""
    if params.motion == "gui":
        return gui_course(params.walk, params.walk_length_m)
    return foot_course(params.walk, params.walk_length_m, params.pace)


def walk_duration_s(params: SimulationParams) -> float:
    """Return how long the walk takes [s]."""
    return course(params).duration_s

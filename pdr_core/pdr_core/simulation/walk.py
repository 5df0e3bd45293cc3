"""Whole simulated walks by name."""

from dataclasses import dataclass

from pdr_core.parameter import ParameterError
from pdr_core.params import PlaceParams, SimulationParams
from pdr_core.records import ImuBlock, Truth, TruthKind
from pdr_core.simulation.chest_motion import ChestCourse
from pdr_core.simulation.chest_person import person
from pdr_core.simulation.chest_steps import stretches
from pdr_core.simulation.courses import gui_course, strides
from pdr_core.simulation.foot_motion import FootCourse
from pdr_core.simulation.gait import Stride
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.motion import Course, Motion, thinned
from pdr_core.simulation.sensing import chosen_sensor, followed, inertial, magnetic
from pdr_core.simulation.sensors import SENSOR_MODELS
from pdr_core.simulation.testers import TESTERS, Tester, footprints
from pdr_core.simulation.two_feet import both_feet
from pdr_core.simulation.two_sensors import both_sensors, seeds


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


def simulated_feet(
    params: SimulationParams, place: PlaceParams | None = None, start_ns: int = 0, model: SensorModel | None = None
) -> dict[str, SimulatedWalk]:
    """Simulate both feet, "left" and "right", of a person who walks the walk that the parameters name, smoothly.

    Both truths are in one world frame: the walk begins midway between the feet at the origin, along x. The first
    samples are stamped `start_ns`. `model` is a sensor in place of the one that they name; each foot has its own copy.
    """
    if params.tester != "none" or params.heading_deviation_rad:
        raise ParameterError("both feet have an angle of their own: leave out simulation.tester and heading_deviation")
    sensors = both_sensors(model or SENSOR_MODELS[params.sensor_model], params)
    feet = both_feet(strides(params.walk, params.walk_length_m, params.pace), params)
    return {
        name: walked(feet[name], params, place, start_ns, sensors[name], seed) for name, seed in seeds(params).items()
    }


def walked(
    path: Course,
    params: SimulationParams,
    place: PlaceParams | None = None,
    start_ns: int = 0,
    model: SensorModel | None = None,
    sensor_seed: int | None = None,
) -> SimulatedWalk:
    """Simulate the walk along any course, with the sensor that the parameters name, or with `model`.

    `sensor_seed` is that of noise and shocks in place of the parameters'. ParameterError if sensor and output do not
    go together.
    """
    sensor = chosen_sensor(params, model)
    path_followed = followed(path, params, sensor, start_ns)
    seed = params.seed if sensor_seed is None else sensor_seed
    imu = inertial(path_followed, params, place or PlaceParams(), sensor, seed)
    if params.magnetometer:
        imu = magnetic(path_followed, params, sensor, seed, imu)
    motion = thinned(path_followed.motion, path_followed.often)
    return SimulatedWalk(imu, motion, Truth(TruthKind.POSITION, imu.stamp_ns, motion.position_m))


def course(params: SimulationParams) -> Course:
    """Return the motion that the parameters name; ParameterError if it has no such walk."""
    if params.motion == "gui":
        return gui_course(params.walk, params.walk_length_m)
    if params.motion == "chest":
        return chest_course(params)
    row = personal_strides(params)
    return FootCourse(row, footprints(row, walker(params), params.placement_sd_m, params.seed))


def personal_strides(params: SimulationParams) -> list[Stride]:
    """Return the strides of a smooth walk as the person of the parameters makes them."""
    who = walker(params)
    usual = strides(params.walk, params.walk_length_m, params.pace * who.pace, who.stature_m)
    return who.varied(usual, params.seed)


def walker(params: SimulationParams) -> Tester:
    """Return who walks; ParameterError of a deviation beside that of a tester."""
    if params.tester != "none" and params.heading_deviation_rad:
        raise ParameterError("simulation.heading_deviation_rad: a tester has one of their own; leave out one of them")
    return TESTERS[params.tester]._replace(
        deviation_rad=TESTERS[params.tester].deviation_rad + params.heading_deviation_rad
    )


def walk_duration_s(params: SimulationParams) -> float:
    """Return how long the walk takes [s]."""
    return course(params).duration_s


def chest_course(params: SimulationParams) -> ChestCourse:
    """Return the motion of a card on the chest of the person of this seed; ParameterError if it has no such walk."""
    parts = stretches(params.walk, params.walk_length_m)
    return ChestCourse(person(params.seed, params.chest_speed_mps), parts, params.seed)

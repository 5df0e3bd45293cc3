"""Whole simulated walks by name."""

from dataclasses import dataclass

import numpy as np

from pdr_core.conventions import gravity_mps2, stamp_ns_from_seconds
from pdr_core.params import DriverParams, PlaceParams
from pdr_core.records import Floats, ImuBlock, Truth, TruthKind
from pdr_core.simulation.foot_motion import STEP_LENGTH_M, FootMotion, Phase, move, steps, turn
from pdr_core.simulation.imu_model import SENSOR_MODELS, measure, orientation

REST_S = 3.0  # standing still at both ends


@dataclass(frozen=True)
class SimulatedWalk:
    """What the sensor measured and where the foot really was."""

    imu: ImuBlock
    motion: FootMotion
    quat_xyzw: Floats  # (n, 4) true attitude
    truth: Truth


def simulated_walk(params: DriverParams, place: PlaceParams | None = None, start_ns: int = 0) -> SimulatedWalk:
    """Simulate the walk that the parameters name; its first sample is stamped `start_ns`."""
    where = place or PlaceParams()
    phases = all_phases(params)
    time_s: Floats = np.arange(0.0, walk_duration_s(params), 1.0 / params.sample_rate_hz, dtype=np.float64)
    stamp_ns = stamp_ns_from_seconds(time_s) + start_ns
    motion = move(phases, time_s)
    gravity = gravity_mps2(np.radians(where.latitude_deg), where.height_m)
    imu = measure(motion, stamp_ns, params.sample_rate_hz, gravity, SENSOR_MODELS[params.sensor_model], params.seed)
    truth = Truth(TruthKind.POSITION, stamp_ns, motion.position_m)
    return SimulatedWalk(imu, motion, orientation(motion).as_quat(), truth)


def all_phases(params: DriverParams) -> list[Phase]:
    """Return the phases of a walk that begins and ends at rest."""
    return [Phase(REST_S), *walk_phases(params.walk, params.walk_length_m), Phase(REST_S)]


def walk_duration_s(params: DriverParams) -> float:
    """Return how long the walk takes [s]."""
    return sum(phase.duration_s for phase in all_phases(params))


def walk_phases(name: str, length_m: float) -> list[Phase]:
    """Return the phases of a walk of about `length_m`, in whole steps."""
    if name == "still":
        return []
    if name == "straight":
        return steps(max(1, round(length_m / STEP_LENGTH_M)))
    long_side = max(1, round(length_m / STEP_LENGTH_M / 3.0))
    short_side = max(1, round(length_m / STEP_LENGTH_M / 2.0) - long_side)
    corner = turn(np.pi / 2.0)
    return (steps(long_side) + corner + steps(short_side) + corner) * 2

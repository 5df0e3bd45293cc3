"""The error of the mechanisation alone: noise-free point samples of a walk, a true start, and no update.

A point sample says nothing of what happens until the next one. So this is what the sample rate costs, whatever sensor
and filter do; a filter bounds it, from stance to stance, but never sees better.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.conventions import NANOSECONDS, gravity_mps2
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import row
from pdr_core.params import PlaceParams, SimulationParams
from pdr_core.records import Floats, ImuBlock
from pdr_core.simulation import SimulatedWalk, simulated_walk
from pdr_core.simulation.gait import WALK, Stride
from pdr_core.simulation.gui_motion import STANCE_S, STEP_LENGTH_M, SWING_S
from pdr_core.strapdown.mechanisation import advance
from pdr_core.strapdown.samples import POINTS, between

RATES_HZ = (50.0, 100.0, 200.0, 400.0, 1000.0)
WALKED_S = 60.0  # beside the rests


@dataclass(frozen=True)
class MechanisationError:
    """Largest errors over one walk."""

    motion: str
    rate_hz: float
    walked_s: float
    distance_m: float  # of the horizontal path
    position_m: float
    velocity_mps: float
    attitude_rad: float


def mechanisation_errors(walked_s: float = WALKED_S) -> list[MechanisationError]:
    """Return the errors on a straight walk of about `walked_s`, for both motions at every rate."""
    params = SimulationParams(walk="straight", sensor_model="ideal")
    speeds_mps = {"gui": STEP_LENGTH_M / (SWING_S + STANCE_S), "smooth": WALK.length_m / Stride(WALK).duration_s}
    walks = [replace(params, motion=motion, walk_length_m=v * walked_s) for motion, v in speeds_mps.items()]
    return [error(replace(walk, sample_rate_hz=rate_hz)) for walk in walks for rate_hz in RATES_HZ]


def error(params: SimulationParams) -> MechanisationError:
    """Return the errors on the walk that the parameters name."""
    walk, place = simulated_walk(params), PlaceParams()
    position_m, velocity_mps, quat_xyzw = integrated(walk, gravity_mps2(np.radians(place.latitude_deg)))
    truth = walk.motion
    turn = Rotation.from_quat(truth.quat_xyzw) * Rotation.from_quat(quat_xyzw).inv()
    moving = np.flatnonzero(~truth.still)
    return MechanisationError(
        params.motion,
        params.sample_rate_hz,
        float(walk.imu.stamp_ns[moving[-1]] - walk.imu.stamp_ns[moving[0]]) / NANOSECONDS,
        float(np.linalg.norm(np.diff(truth.position_m[:, :2], axis=0), axis=1).sum()),
        float(np.linalg.norm(position_m - truth.position_m, axis=1).max()),
        float(np.linalg.norm(velocity_mps - truth.velocity_mps, axis=1).max()),
        float(turn.magnitude().max()),
    )


def integrated(walk: SimulatedWalk, gravity: float) -> tuple[Floats, Floats, Floats]:
    """Return position, velocity (n, 3) and attitude (n, 4) by the mechanisation alone, from the true start."""
    track = tuple(np.array(c) for c in (walk.motion.position_m, walk.motion.velocity_mps, walk.motion.quat_xyzw))
    integrate(walk.imu, gravity, *track)
    return track[0], track[1], track[2]


@compiled
def integrate(imu: ImuBlock, gravity: float, position_m: Floats, velocity_mps: Floats, quat_xyzw: Floats) -> None:
    """Replace all rows but the first, which is the start, by what the mechanisation makes of the samples."""
    for i in range(1, imu.stamp_ns.shape[0]):
        position_m[i], velocity_mps[i], quat_xyzw[i] = position_m[i - 1], velocity_mps[i - 1], quat_xyzw[i - 1]
        dt_s = (imu.stamp_ns[i] - imu.stamp_ns[i - 1]) / NANOSECONDS
        last_rate, rate = row(imu.gyro_radps, i - 1), row(imu.gyro_radps, i)
        last_force, force = row(imu.accel_mps2, i - 1), row(imu.accel_mps2, i)
        turn, before, after = between(POINTS, last_rate, rate, last_force, force, dt_s)
        advance(position_m[i], velocity_mps[i], quat_xyzw[i], turn, before, after, dt_s, gravity)

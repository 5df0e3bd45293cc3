"""Strides, steps and samples for the tests of what navigates with the gyro off."""

import numpy as np

from pdr_core.gait.dead_reckoning import GaitDeadReckoning, Length
from pdr_core.maths.quaternion import from_euler
from pdr_core.params import DeadReckoningParams, Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import Biases, Handover, ImuBlock, NavBlock, PoseEstimate, StanceBlock, StepEvent, joined
from pdr_core.records_gait import Angle, Behaviour, GaitStep
from pdr_core.simulation import SimulatedWalk, simulated_feet
from pdr_core.stance import StanceDetection

SECOND = 1_000_000_000
BEGIN_NS = 1_700_000_000 * SECOND
PARAMS = DeadReckoningParams()
STRAIGHT, SURE = Angle(0.0, 0.0), Length(1.3, 0.0)
SD = np.array([0.1, 0.1, 0.1, 0.01, 0.01, 0.02])  # of a start


def gait_step(index: int, begin_ns: int = BEGIN_NS, behaviour=Behaviour.WALKING) -> GaitStep:
    """The stride of that number, 1 s each, from a stamp on."""
    return GaitStep(
        index, begin_ns + (index - 1) * SECOND, begin_ns + index * SECOND, behaviour, 1.0, 1.0, 9.0, -3.0, 2.0
    )


def step_event(heading_rad: float, sd_rad=0.01, length_m=1.3, index=1, duration_s=1.0) -> StepEvent:
    """A stride of a filter, in a direction that it knows so well."""
    ahead = np.array([np.cos(heading_rad), np.sin(heading_rad), 0.0])
    across = np.array([-ahead[1], ahead[0], 0.0])
    covariance = (sd_rad * length_m) ** 2 * np.outer(across, across) + 1e-8 * np.eye(3)
    stamp_ns = BEGIN_NS + round(duration_s * SECOND)
    return StepEvent(index, BEGIN_NS, stamp_ns, length_m * ahead, length_m * ahead, covariance, 0.0, sd_rad)


def left_foot(walk="straight", length_m=40.0, sensor="ideal", **more) -> SimulatedWalk:
    """A simulated left foot with a magnetometer."""
    told = {"walk": walk, "walk_length_m": length_m, "sensor_model": sensor, "motion": "smooth", "magnetometer": True}
    return simulated_feet(SimulationParams(**told | more), start_ns=BEGIN_NS)["left"]


def tracked(imu: ImuBlock) -> tuple[NavBlock, list[StepEvent]]:
    """What the filter makes of it with its gyro on."""
    chain = FootInertial(Params())
    outputs = [chain.run(imu), chain.finish()]
    return joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps]


def judged_without_gyro(imu: ImuBlock) -> StanceBlock:
    """The samples with the gyro off, judged by the accelerometer."""
    off = imu._replace(gyro_radps=np.zeros_like(imu.gyro_radps), gyro_sd_radps=np.full(len(imu.stamp_ns), -1.0))
    params = changed(Params(), "stance", detector="acceleration_moving_variance")
    params = changed(params, "detectors", acceleration_moving_variance_threshold=1.4)
    detection = StanceDetection(params.stance, params.place, params.detectors)
    return joined([detection.run(off), detection.finish()])


def start(yaw=0.0, sd=SD, stamp_ns=BEGIN_NS, tilt=0.0) -> Handover:
    """Where dead reckoning begins."""
    pose = PoseEstimate(np.array([5.0, -2.0, 0.5]), np.array(from_euler(tilt, 0.0, yaw)), np.diag(np.square(sd)))
    return Handover(stamp_ns, pose, Biases(np.zeros(3), np.array([1e-3, 0.0, 0.0]), np.eye(6) * 1e-6))


def begun(**more) -> GaitDeadReckoning:
    """Dead reckoning that has begun there."""
    track = GaitDeadReckoning(PARAMS)
    track.begin(start(**more))
    return track


def finite(nav) -> bool:
    """Tell whether every number is one."""
    return all(np.isfinite(column).all() for column in nav)

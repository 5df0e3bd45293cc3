"""A walk whose sensor switches its gyro by itself, for the tests of what fills in the rates."""

import numpy as np

from pdr_core.maths.motion_switch import MotionSwitch
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.power.motion_rule import motion_rule
from pdr_core.records import Flags, ImuBlock
from pdr_core.simulation import SimulatedWalk, simulated_walk

PARAMS = changed(Params(), "power", duty="swing")
RULE = motion_rule(PARAMS.power)
LEARNT_NS = 25_000_000_000  # so long the gyro is on all the time
BIAS_RADPS = np.array([0.02, -0.03, 0.04])


def ideal_walk(**more: object) -> SimulatedWalk:
    """Return a rectangle without noise, by a gyro with a bias."""
    told = {"walk": "rectangle", "walk_length_m": 50.0, "sample_rate_hz": 100.0, "sensor_model": "ideal"}
    walk = simulated_walk(SimulationParams(**{"motion": "smooth", "shock_mps2": 60.0} | told | more))
    walk.imu.gyro_radps[:] += BIAS_RADPS
    return walk


def switched(imu: ImuBlock) -> tuple[ImuBlock, Flags]:
    """Return the samples without the rates that a sleeping gyro does not measure, and which (n,) these are."""
    _, measured = MotionSwitch(RULE, powered=True).run(imu.stamp_ns, imu.accel_mps2)
    asleep = ~measured & (imu.stamp_ns > imu.stamp_ns[0] + LEARNT_NS)
    rates, sd = np.where(asleep[:, None], 0.0, imu.gyro_radps), np.where(asleep, -1.0, imu.gyro_sd_radps)
    return imu._replace(gyro_radps=rates, gyro_sd_radps=sd), asleep

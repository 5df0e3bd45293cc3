"""A walk whose sensor switches its gyro by itself, for the tests of what fills in the rates."""

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.maths.motion_switch import MotionSwitch
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.power.motion_rule import motion_rule
from pdr_core.records import Flags, Floats, ImuBlock, Stamps
from pdr_core.simulation import SimulatedWalk, simulated_walk

PARAMS = changed(Params(), "power", duty="swing")
RULE = motion_rule(PARAMS.power)
LEARNT_NS = 25_000_000_000  # so long the gyro is on all the time
BIAS_RADPS = np.array([0.1, -0.15, 0.2])


def ideal_walk(**more: object) -> SimulatedWalk:
    """Return a rectangle without noise, by a gyro with a bias."""
    told = {"walk": "rectangle", "walk_length_m": 50.0, "sample_rate_hz": 100.0, "sensor_model": "ideal"}
    walk = simulated_walk(SimulationParams(**{"motion": "smooth", "shock_mps2": 60.0} | told | more))
    walk.imu.gyro_radps[:] += BIAS_RADPS
    return walk


def switched(imu: ImuBlock) -> tuple[ImuBlock, Flags]:
    """Return the samples without the rates that a sleeping gyro does not measure, and which (n,) these are."""
    _, measured = MotionSwitch(RULE, powered=True).run(imu.stamp_ns, imu.accel_mps2)
    return without_rates(imu, ~measured)


def without_rates(imu: ImuBlock, asleep: Flags) -> tuple[ImuBlock, Flags]:
    """Return the samples without the rates of those that are asleep once enough was learnt, and which these are."""
    asleep = asleep & (imu.stamp_ns > imu.stamp_ns[0] + LEARNT_NS)
    rates, sd = np.where(asleep[:, None], 0.0, imu.gyro_radps), np.where(asleep, -1.0, imu.gyro_sd_radps)
    return imu._replace(gyro_radps=rates, gyro_sd_radps=sd), asleep


class Early:
    """Plays the switch of a sensor that is too early: off before the foot has landed, on after it has left."""

    def __init__(self, stamp_ns: Stamps, stance: Flags) -> None:
        """Take which samples (n,) are stance."""
        self._stamp_ns = stamp_ns
        edges = np.flatnonzero(np.diff(stance))
        asleep = stance.copy()
        for edge in edges:
            asleep[edge - 8 : edge + 1] |= not stance[edge]
            asleep[edge : edge + 5] |= stance[edge]
        self.asleep: Flags = asleep

    def run(self, stamp_ns: Stamps, _: Floats) -> tuple[Flags, Flags]:
        """Return which of the next samples are measured, as `MotionSwitch` does."""
        awake = ~self.asleep[np.searchsorted(self._stamp_ns, stamp_ns)]
        return awake, awake


def rolled_walk(share: float = 0.5) -> tuple[ImuBlock, Rotation, Flags]:
    """Return a straight walk whose foot rolls with its pitch, its attitude (n,) and stance: turns of no plane."""
    walk = ideal_walk(walk="straight")
    pitch_rad = 2.0 * np.arctan2(walk.motion.quat_xyzw[:, 1], walk.motion.quat_xyzw[:, 3])
    ahead, roll = np.array([1.0, 0.0, 0.0]), Rotation.from_rotvec(np.outer(share * pitch_rad, [1.0, 0.0, 0.0]))
    rate = walk.imu.gyro_radps - BIAS_RADPS
    gyro = roll.inv().apply(rate) + np.outer(share * rate[:, 1], ahead) + BIAS_RADPS
    accel = roll.inv().apply(walk.imu.accel_mps2)
    attitude = Rotation.from_quat(walk.motion.quat_xyzw) * roll
    return walk.imu._replace(gyro_radps=gyro, accel_mps2=accel), attitude, walk.motion.stance

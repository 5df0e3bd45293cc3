"""Simulated feet whose gyro is off."""

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.params import SimulationParams
from pdr_core.records import Floats, ImuBlock, inertial_block
from pdr_core.simulation.foot_motion import FootCourse
from pdr_core.simulation.gait import Gait, Stride
from pdr_core.simulation.walk import walked

BEGIN_NS = 1_700_000_000_000_000_000


def without_gyro(imu: ImuBlock) -> ImuBlock:
    n = len(imu.stamp_ns)
    return imu._replace(gyro_radps=np.full((n, 3), np.nan), gyro_sd_radps=np.full(n, -1.0))


def walk(
    strides: list[Stride], rate_hz: float = 100.0, mounting: Rotation | None = None, shock_mps2: float = 30.0
) -> ImuBlock:
    roll, pitch, yaw = (mounting or Rotation.identity()).as_euler("xyz")
    params = SimulationParams(
        motion="smooth",
        sample_rate_hz=rate_hz,
        shock_mps2=shock_mps2,
        mounting_roll_rad=float(roll),
        mounting_pitch_rad=float(pitch),
        mounting_yaw_rad=float(yaw),
    )
    return without_gyro(walked(FootCourse(strides), params, start_ns=BEGIN_NS).imu)


def row(gait: Gait, count: int, pause_s: float = 0.0) -> list[Stride]:
    """Strides of one gait, the last of which stands for longer."""
    return [*[Stride(gait)] * (count - 1), replace(Stride(gait), pause_s=pause_s)]


def dangling(seconds: float, rate_hz: float = 100.0) -> ImuBlock:
    """A foot that stands, and then swings below the knee: 0.5 m, 0.5 rad, every second; a free pendulum takes 1.4 s."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    swings = np.clip(time_s - 3.0, 0.0, 1.0)
    angle = 0.5 * swings * np.sin(2.0 * np.pi * time_s)
    rate = np.gradient(angle, time_s)
    tangential, radial = 0.5 * np.gradient(rate, time_s), 0.5 * rate**2
    force = np.column_stack([9.81 * np.sin(angle) + tangential, np.zeros_like(angle), 9.81 * np.cos(angle) + radial])
    return still_noise(time_s, force)


def still_noise(time_s: Floats, force_mps2: Floats) -> ImuBlock:
    n = len(time_s)
    noisy = force_mps2 + 0.05 * np.random.default_rng(1).standard_normal((n, 3))
    stamp_ns = BEGIN_NS + np.rint(time_s * 1e9).astype(np.int64)
    return without_gyro(inertial_block(stamp_ns, np.zeros((n, 3)), noisy, np.zeros(n), np.zeros(n)))

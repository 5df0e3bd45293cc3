"""The magnetic field that a simulated foot feels."""

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.records import Floats, ImuBlock
from pdr_core.simulation import SimulatedWalk

NORM_TESLA, DIP_RAD, NOISE_TESLA = 5e-5, np.radians(60.0), 5e-7


def earth_field(azimuth_rad: float) -> Floats:
    """Return a field [T] in the world frame, (3,)."""
    level = np.array([np.cos(azimuth_rad), np.sin(azimuth_rad), 0.0])
    return NORM_TESLA * (np.cos(DIP_RAD) * level - np.sin(DIP_RAD) * np.array([0.0, 0.0, 1.0]))


def in_field(walk: SimulatedWalk, world_tesla: Floats, offset_tesla: Floats | None = None, seed: int = 0) -> ImuBlock:
    """Return the samples of a walk in a field (3,) or (n, 3) of the world frame, with an offset in the foot's axes."""
    n = len(walk.imu.stamp_ns)
    felt = Rotation.from_quat(walk.motion.quat_xyzw).inv().apply(np.broadcast_to(world_tesla, (n, 3)))
    felt = felt + NOISE_TESLA * np.random.default_rng(seed).standard_normal((n, 3))
    felt = felt if offset_tesla is None else felt + offset_tesla
    return walk.imu._replace(field_tesla=felt, field_sd_tesla=np.full(n, NOISE_TESLA))

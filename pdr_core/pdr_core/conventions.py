"""The conventions every module obeys: SI units, ENU world, FLU body, quaternions as (x, y, z, w).

World frame (REP-103): x east, y north, z up. The yaw of an unaided track is arbitrary, so "east" then means the
direction of the foot's x axis at the start. Body frame: x forward, y left, z up. `R_world_from_foot` turns foot
coordinates into world coordinates. An accelerometer measures specific force: +g upwards at rest. Time is a header
stamp in integer nanoseconds.
"""

import math

import numpy as np

NANOSECONDS = 1_000_000_000
STANDARD_GRAVITY_MPS2 = 9.80665
GAP_NS = 100_000_000  # a longer time between two samples is a gap: nobody knows what the foot did in it
EARTH_FIELD_TESLA = (22e-6, 67e-6)  # weakest and strongest on the ground (World Magnetic Model 2025)
UNKNOWN_RATE_SD_RADPS = 10.0  # of a foot whose gyro is off
NO_STAMP = -(2**63)  # says "none"; stamps themselves may be negative, where a recording counts from a later moment


def gravity_mps2(latitude_rad: float, height_m: float = 0.0) -> float:
    """Return the magnitude of gravity [m/s^2] on and near the WGS 84 ellipsoid (Somigliana, free air)."""
    sin2 = math.sin(latitude_rad) ** 2
    surface = 9.7803253359 * (1.0 + 0.001931850400 * sin2) / math.sqrt(1.0 - 0.006694384442 * sin2)
    return surface - (3.0877e-6 - 4.3e-9 * sin2) * height_m + 7.2e-13 * height_m**2


def nanoseconds(time_s: float) -> int:
    """Return a time [s] in whole nanoseconds."""
    return round(time_s * NANOSECONDS)


def stamp_ns_from_seconds(time_s: np.ndarray) -> np.ndarray:
    """Quantise times [s], shape (n,), to stamps [ns], int64 (n,): done once, where a recording is opened."""
    return np.rint(np.asarray(time_s, dtype=np.float64) * NANOSECONDS).astype(np.int64)


def seconds_between(stamps_ns: np.ndarray, start_ns: int) -> np.ndarray:
    """Return stamps [ns], shape (n,), as seconds since `start_ns`, without losing the nanoseconds."""
    return (stamps_ns - np.int64(start_ns)) / NANOSECONDS

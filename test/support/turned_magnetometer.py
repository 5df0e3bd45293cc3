"""A magnetometer that is turned through all directions, with iron, swapped axes and noise: what its fields would be."""

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.maths.magnetic import magnetic_yaw_rad
from pdr_core.records import Floats, ImuBlock

NORM_TESLA, DIP_RAD = 50e-6, np.deg2rad(60.0)
EARTH_FIELD = NORM_TESLA * np.array([0.0, np.cos(DIP_RAD), -np.sin(DIP_RAD)])  # ENU, declination zero
BEGIN_NS = 10**18


class Iron(NamedTuple):
    """measured = distortion field + offset, the field in the axes of the gyro."""

    offset_tesla: Floats  # (3,)
    distortion: Floats  # (3, 3)


def some_iron(seed, strength=0.2, axes=None):
    """Hard iron of up to 30 uT an axis, soft iron that is not symmetric, and axes that are swapped or mirrored."""
    rng = np.random.default_rng(seed)
    distortion = np.eye(3) + strength * rng.uniform(-1.0, 1.0, (3, 3))
    return Iron(rng.uniform(-30e-6, 30e-6, 3), distortion @ (np.eye(3) if axes is None else axes))


def turning(seed, duration_s=60.0, rate_hz=100.0, rate_radps=1.5, axes=(1.0, 1.0, 1.0)):
    """Times and rates, (n, 3), of a hand that turns a sensor about changing axes and rests every 10 s."""
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, duration_s, 1.0 / rate_hz)
    slow_hz, phase = rng.uniform(0.05, 0.25, (3, 3)), rng.uniform(0.0, 2 * np.pi, (3, 3))
    waves = np.sin(2 * np.pi * t[:, None, None] * slow_hz + phase).sum(axis=1)
    rests = np.abs(np.sin(2 * np.pi * 0.05 * t))[:, None]
    return t, rate_radps * waves * rests * np.asarray(axes)


def turned(
    iron,
    seed=0,
    noise_tesla=0.7e-6,
    earth=EARTH_FIELD,
    bias_radps=0.01,
    gyro_noise_radps=0.003,
    accel_noise_mps2=0.05,
    **motion,
):
    """A recording: samples, and the true attitude of each, world from sensor."""
    t, rate = turning(seed, **motion)
    rng = np.random.default_rng(seed + 1000)
    attitude = [Rotation.random(random_state=seed)]
    middle = 0.5 * (rate[1:] + rate[:-1])
    for step in Rotation.from_rotvec(middle * (t[1] - t[0])):
        attitude.append(attitude[-1] * step)
    attitude = Rotation.concatenate(attitude)
    n = len(t)
    field = attitude.inv().apply(earth) @ iron.distortion.T + iron.offset_tesla
    field += noise_tesla * rng.standard_normal((n, 3))
    gyro = rate + bias_radps * np.array([1.0, -0.5, 0.7]) + gyro_noise_radps * rng.standard_normal((n, 3))
    accel = attitude.inv().apply([0.0, 0.0, 9.81]) + accel_noise_mps2 * rng.standard_normal((n, 3))
    stamps = BEGIN_NS + np.rint(t * 1e9).astype(np.int64)
    return ImuBlock(stamps, gyro, accel, np.zeros(n), np.zeros(n), field, np.zeros(n)), attitude


def heading_errors_rad(iron, found, tilts=((0.0, 0.0), (0.3, -0.4), (2.0, 0.5), (-1.0, 0.1))):
    """Errors, (tilts, 72), of the heading by a calibrated field at the true tilt, all around."""
    errors = []
    for roll, pitch in tilts:
        for yaw in np.linspace(-np.pi, np.pi, 72, endpoint=False):
            attitude = Rotation.from_euler("xyz", [roll, pitch, yaw])
            raw = iron.distortion @ attitude.inv().apply(EARTH_FIELD) + iron.offset_tesla
            errors.append(magnetic_yaw_rad(attitude.as_quat(), found.applied(raw)) - yaw)
    return ((np.array(errors) + np.pi) % (2.0 * np.pi) - np.pi).reshape(len(tilts), 72)

"""What an IMU on the foot measures: rate and specific force, bias, noise and range (Gui eq. 31-32)."""

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.records import Floats, ImuBlock, Stamps, inertial_block
from pdr_core.simulation.instability import scales, wandering
from pdr_core.simulation.magnetometer import Magnetometer
from pdr_core.simulation.motion import Motion
from pdr_core.simulation.response import OVERSAMPLED_HZ, Response, answer

EARTH_RATE_RADPS = 7.292115e-5  # of WGS 84
BIASES, GYRO_AXES, ACCEL_AXES = 1, 4, 5  # what is drawn from a seed beside the noise, each from a stream of its own
INSTABILITY = 22
WANDER_S = 100.0  # over which a bias is forgotten: MEMS gyros show their least Allan deviation after 10 to 100 s
Axes = tuple[float, float, float]


@dataclass(frozen=True)
class SensorModel:
    """Biases, noise densities, ranges and axes of a sensor."""

    gyro_bias_radps: Axes = (0.0, 0.0, 0.0)
    accel_bias_mps2: Axes = (0.0, 0.0, 0.0)
    gyro_noise_density: float = 0.0  # [rad/s/sqrt(Hz)]
    accel_noise_density: float = 0.0  # [m/s^2/sqrt(Hz)]
    gyro_bias_sd_radps: float = 0.0  # of what each seed adds to the bias of each axis
    accel_bias_sd_mps2: float = 0.0
    gyro_wander_radps: float = 0.0  # deviation of what the bias of each axis wanders by
    accel_wander_mps2: float = 0.0
    gyro_scale_sd: float = 0.0  # of what each axis shows too much, as a share
    accel_scale_sd: float = 0.0
    gyro_g_sensitivity: Axes = (0.0, 0.0, 0.0)  # [rad/s per m/s^2] of the rate each axis shows to the force along it
    gyro_range_radps: float = np.inf
    accel_range_mps2: float = np.inf
    gyro_response: Response = field(default_factory=Response)
    accel_response: Response = field(default_factory=Response)
    magnetometer: Magnetometer = field(default_factory=Magnetometer)

    @property
    def filters(self) -> bool:
        """It has a low-pass before it samples."""
        responses = (self.gyro_response, self.accel_response, self.magnetometer.response)
        return any(np.isfinite(response.bandwidth_hz) for response in responses)

    def oversampling(self, rate_hz: float) -> int:
        """Return how many true values a sample takes: one, or as many as its low-pass has to see."""
        return int(np.ceil(OVERSAMPLED_HZ / rate_hz)) if self.filters else 1

    def biases(self, seed: int) -> tuple[Floats, Floats]:
        """Return the biases [rad/s], [m/s^2] of the sensor with this seed, (3,) each."""
        drawn = np.random.default_rng([seed, BIASES]).standard_normal((2, 3))
        gyro = np.array(self.gyro_bias_radps) + self.gyro_bias_sd_radps * drawn[0]
        return gyro, np.array(self.accel_bias_mps2) + self.accel_bias_sd_mps2 * drawn[1]


def point_samples(motion: Motion, gravity_mps2: float) -> tuple[Floats, Floats]:
    """Return the rate and the specific force in the foot frame at each time, (n, 3) each (eq. 31-32).

    Eq. 31 writes w_ib, which holds the Earth's rate already; what it needs beside `earth_in_foot` is w_nb, the rate of
    the foot relative to the world frame, as here. Eq. 32 leaves out the Coriolis force, 1e-3 m/s^2 at most; so do we.
    """
    force = motion.acceleration_mps2 + np.array([0.0, 0.0, gravity_mps2])
    return motion.rate_radps, Rotation.from_quat(motion.quat_xyzw).inv().apply(force)


def earth_in_foot(motion: Motion, latitude_rad: float) -> Floats:
    """Return the rate of the Earth in the foot frame, (n, 3): C_n^b C_e^n w_ie of eq. 31.

    The world is east-north-up; its own turn about the Earth as the walker moves, v / R, is under 1e-6 rad/s.
    """
    world = EARTH_RATE_RADPS * np.array([0.0, np.cos(latitude_rad), np.sin(latitude_rad)])
    return Rotation.from_quat(motion.quat_xyzw).inv().apply(world)


def answered(
    gyro_radps: Floats, accel_mps2: Floats, rate_hz: float, model: SensorModel, seed: int
) -> tuple[Floats, Floats]:
    """Return what the axes of the sensor show of true rates and forces, (n, 3) each, that follow at `rate_hz`.

    Forces bend a gyro too: the diagonal of the matrix of Bancroft and Lachapelle (2012), Estimating MEMS gyroscope
    g-sensitivity errors in foot mounted navigation. A rest shows it as a bias; in a stride the mean force is another.
    """
    rngs = [np.random.default_rng([seed, stream]) for stream in (GYRO_AXES, ACCEL_AXES)]
    felt_radps = gyro_radps + np.array(model.gyro_g_sensitivity) * accel_mps2
    gyro = answer(felt_radps, rate_hz, model.gyro_response, model.gyro_range_radps, rngs[0])
    return gyro, answer(accel_mps2, rate_hz, model.accel_response, model.accel_range_mps2, rngs[1])


def sensed(
    stamp_ns: Stamps, gyro_radps: Floats, accel_mps2: Floats, rate_hz: float, model: SensorModel, seed: int
) -> ImuBlock:
    """Return what the sensor gives for the true rates and forces (n, 3) along its own axes: bias, noise, then range."""
    noise = np.random.default_rng(seed).standard_normal((2, len(stamp_ns), 3)) * np.sqrt(rate_hz)
    gyro_bias, accel_bias = model.biases(seed)
    gyro, accel = unstable(gyro_radps, accel_mps2, rate_hz, model, seed)
    gyro = gyro + gyro_bias + model.gyro_noise_density * noise[0]
    accel = accel + accel_bias + model.accel_noise_density * noise[1]
    gyro = np.clip(gyro, -model.gyro_range_radps, model.gyro_range_radps)
    accel = np.clip(accel, -model.accel_range_mps2, model.accel_range_mps2)
    return inertial_block(stamp_ns, gyro, accel, np.zeros(len(stamp_ns)), np.zeros(len(stamp_ns)))


def unstable(
    gyro_radps: Floats, accel_mps2: Floats, rate_hz: float, model: SensorModel, seed: int
) -> tuple[Floats, Floats]:
    """Return rates and forces, (n, 3) each, with what sensitivities are off and biases wander."""
    rng = np.random.default_rng([seed, INSTABILITY])
    shown = gyro_radps * scales(model.gyro_scale_sd, rng), accel_mps2 * scales(model.accel_scale_sd, rng)
    sds = model.gyro_wander_radps, model.accel_wander_mps2
    gyro, accel = (s + wandering(len(s), rate_hz, sd, WANDER_S, rng) for s, sd in zip(shown, sds, strict=True))
    return gyro, accel

"""What an IMU on the foot measures: rate and specific force, mounting, bias, noise and range (Gui eq. 31-32)."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.records import Floats, ImuBlock, Stamps, inertial_block
from pdr_core.simulation.motion import Motion

EARTH_RATE_RADPS = 7.292115e-5  # of WGS 84
BIASES = 1  # what is drawn from a seed beside the noise, each from a stream of its own
Axes = tuple[float, float, float]


@dataclass(frozen=True)
class SensorModel:
    """Biases, noise densities and ranges of a sensor."""

    gyro_bias_radps: Axes = (0.0, 0.0, 0.0)
    accel_bias_mps2: Axes = (0.0, 0.0, 0.0)
    gyro_noise_density: float = 0.0  # [rad/s/sqrt(Hz)]
    accel_noise_density: float = 0.0  # [m/s^2/sqrt(Hz)]
    gyro_bias_sd_radps: float = 0.0  # of what each seed adds to the bias of each axis
    accel_bias_sd_mps2: float = 0.0
    gyro_range_radps: float = np.inf
    accel_range_mps2: float = np.inf

    def biases(self, seed: int) -> tuple[Floats, Floats]:
        """Return the biases [rad/s], [m/s^2] of the sensor with this seed, (3,) each."""
        drawn = np.random.default_rng([seed, BIASES]).standard_normal((2, 3))
        gyro = np.array(self.gyro_bias_radps) + self.gyro_bias_sd_radps * drawn[0]
        return gyro, np.array(self.accel_bias_mps2) + self.accel_bias_sd_mps2 * drawn[1]


MPU_9250 = SensorModel(gyro_range_radps=34.9, accel_range_mps2=156.9)  # 2000 deg/s, 16 g: Gui Table 2
GUI_TABLE_1 = replace(
    MPU_9250,
    gyro_bias_radps=(0.02618, 0.03491, 0.02094),
    accel_bias_mps2=(0.1, 0.2, 0.15),
    gyro_noise_density=0.1,
    accel_noise_density=0.1,
)
SENSOR_MODELS = {
    "ideal": SensorModel(),
    # 0.1 deg/s and 10 mg after calibration, 0.01 deg/s/sqrt(Hz), 300 ug/sqrt(Hz): data sheet of the MPU-9250
    "consumer": replace(
        MPU_9250,
        gyro_bias_radps=(0.0017, -0.0012, 0.0017),
        accel_bias_mps2=(0.05, -0.05, 0.1),
        gyro_noise_density=1.75e-4,
        accel_noise_density=2.9e-3,
    ),
    # As printed. 0.1 rad/sqrt(s) is about 300 times what the data sheet of the sensor says; no foot filter survives it.
    "gui_table_1": GUI_TABLE_1,
    # 0.1 deg/sqrt(s), which may be meant: ten times the data sheet
    "gui_table_1_deg": replace(GUI_TABLE_1, gyro_noise_density=float(np.radians(0.1))),
}


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


def sensed(
    stamp_ns: Stamps, gyro_radps: Floats, accel_mps2: Floats, rate_hz: float, model: SensorModel, seed: int
) -> ImuBlock:
    """Return what the sensor gives for the true rates and forces (n, 3) along its own axes: bias, noise, then range."""
    noise = np.random.default_rng(seed).standard_normal((2, len(stamp_ns), 3)) * np.sqrt(rate_hz)
    gyro_bias, accel_bias = model.biases(seed)
    gyro = gyro_radps + gyro_bias + model.gyro_noise_density * noise[0]
    accel = accel_mps2 + accel_bias + model.accel_noise_density * noise[1]
    gyro = np.clip(gyro, -model.gyro_range_radps, model.gyro_range_radps)
    accel = np.clip(accel, -model.accel_range_mps2, model.accel_range_mps2)
    return inertial_block(stamp_ns, gyro, accel, np.zeros(len(stamp_ns)), np.zeros(len(stamp_ns)))

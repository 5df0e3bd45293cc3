"""What an IMU on the foot measures: specific force and rate, bias and noise (Gui eq. 31-32)."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.records import Floats, ImuBlock, Stamps
from pdr_core.simulation.foot_motion import FootMotion


@dataclass(frozen=True)
class SensorModel:
    """Biases and noise densities of a sensor."""

    gyro_bias_radps: tuple[float, float, float]
    accel_bias_mps2: tuple[float, float, float]
    gyro_noise_density: float  # [rad/s/sqrt(Hz)]
    accel_noise_density: float  # [m/s^2/sqrt(Hz)]


SENSOR_MODELS = {
    "ideal": SensorModel((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0),
    # 0.1 deg/s and 10 mg after calibration, 0.01 deg/s/sqrt(Hz), 300 ug/sqrt(Hz): data sheet of the MPU-9250
    "consumer": SensorModel((0.0017, -0.0012, 0.0017), (0.05, -0.05, 0.1), 1.75e-4, 2.9e-3),
    # As printed. 0.1 rad/sqrt(s) is about 300 times what the data sheet of the sensor says; no foot filter survives it.
    "gui_table_1": SensorModel((0.02618, 0.03491, 0.02094), (0.1, 0.2, 0.15), 0.1, 0.1),
}


def measure(
    motion: FootMotion, stamp_ns: Stamps, rate_hz: float, gravity_mps2: float, model: SensorModel, seed: int
) -> ImuBlock:
    """Return what the sensor gives at each stamp, (n,): point samples of the exact derivatives, bias and noise."""
    noise = np.random.default_rng(seed).standard_normal((2, len(stamp_ns), 3)) * np.sqrt(rate_hz)
    gyro = body_rate_radps(motion) + np.array(model.gyro_bias_radps) + model.gyro_noise_density * noise[0]
    accel = specific_force_mps2(motion, gravity_mps2) + np.array(model.accel_bias_mps2)
    accel += model.accel_noise_density * noise[1]
    return ImuBlock(stamp_ns, gyro, accel, np.zeros(len(stamp_ns)), np.zeros(len(stamp_ns)))


def orientation(motion: FootMotion) -> Rotation:
    """Return the attitude world from foot."""
    return Rotation.from_euler("ZY", np.column_stack([motion.yaw_rad, motion.pitch_rad]))


def body_rate_radps(motion: FootMotion) -> Floats:
    """Return the angular rate in the foot frame, (n, 3) (eq. 31 without the Earth's rotation)."""
    pitch, yaw_rate = motion.pitch_rad, motion.yaw_rate_radps
    return np.column_stack([-np.sin(pitch) * yaw_rate, motion.pitch_rate_radps, np.cos(pitch) * yaw_rate])


def specific_force_mps2(motion: FootMotion, gravity_mps2: float) -> Floats:
    """Return the specific force in the foot frame, (n, 3) (eq. 32)."""
    return orientation(motion).inv().apply(motion.acceleration_mps2 + np.array([0.0, 0.0, gravity_mps2]))

"""The sensors that can be simulated, by name."""

from dataclasses import replace

import numpy as np

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.simulation.imu_model import SensorModel
from pdr_core.simulation.magnetometer import Magnetometer
from pdr_core.simulation.response import Response

GAUSS = 1e-4  # [T]
ALIGNMENT_RAD = float(np.radians(0.1))
# 2000 deg/s, 16 g: Gui Table 2. Its magnetometer: 4900 uT, one sample good to its step of 0.6 uT at 14 bit (data sheet)
MPU_9250 = SensorModel(
    gyro_range_radps=34.9,
    accel_range_mps2=156.9,
    magnetometer=Magnetometer(noise_tesla=0.6e-6, range_tesla=4.9e-3),
)
# Xsens MTx, Qiu Table 1: 100 Hz. The table has no noise densities and no unit of the bias; the noise is that of the
# data sheet, 0.05 deg/s/sqrt(Hz), 0.002 m/s^2/sqrt(Hz) and 0.5 mG. The bias stability, 1 sigma, in m/s^2, deg/s and
# mG, is read as a constant bias that each seed draws.
QIU_TABLE_1 = SensorModel(
    gyro_noise_density=float(np.radians(0.05)),
    accel_noise_density=0.002,
    gyro_bias_sd_radps=float(np.radians(1.0)),
    accel_bias_sd_mps2=0.02,
    gyro_range_radps=float(np.radians(1200.0)),
    accel_range_mps2=50.0,
    gyro_response=Response(ALIGNMENT_RAD, linearity=0.001, bandwidth_hz=40.0),
    accel_response=Response(ALIGNMENT_RAD, linearity=0.002, bandwidth_hz=30.0),
    magnetometer=Magnetometer(
        hard_iron_sd_tesla=0.1e-3 * GAUSS,
        noise_tesla=0.5e-3 * GAUSS,
        range_tesla=750e-3 * GAUSS,
        response=Response(ALIGNMENT_RAD, linearity=0.002, bandwidth_hz=10.0),
    ),
)
GUI_TABLE_1 = replace(
    MPU_9250,
    gyro_bias_radps=(0.02618, 0.03491, 0.02094),
    accel_bias_mps2=(0.1, 0.2, 0.15),
    gyro_noise_density=0.1,
    accel_noise_density=0.1,
)
# 0.1 deg/s and 10 mg after calibration, 0.01 deg/s/sqrt(Hz), 300 ug/sqrt(Hz): data sheet of the MPU-9250
CONSUMER = replace(
    MPU_9250,
    gyro_bias_radps=(0.0017, -0.0012, 0.0017),
    accel_bias_mps2=(0.05, -0.05, 0.1),
    gyro_noise_density=1.75e-4,
    accel_noise_density=2.9e-3,
)
# Cheng's sensor. Noise 0.004 deg/s/sqrt(Hz) and 100 ug/sqrt(Hz), sensitivity of the gyro within 1 % (read as 2 sigma),
# 16 bit: data sheet DS-000176 of the ICM-20602. Bias stability 0.04 deg/s and 1 mg, scale of the accelerometer 0.3 %:
# Cheng Table 1, which prints the gyro's noise in ug. The constant biases, 1 deg/s and 25 mg, are those of its class.
ICM_20602 = SensorModel(
    gyro_noise_density=float(np.radians(0.004)),
    accel_noise_density=100e-6 * STANDARD_GRAVITY_MPS2,
    gyro_bias_sd_radps=float(np.radians(0.5)),
    accel_bias_sd_mps2=0.5 * 0.025 * STANDARD_GRAVITY_MPS2,
    gyro_wander_radps=float(np.radians(0.04)),
    accel_wander_mps2=1e-3 * STANDARD_GRAVITY_MPS2,
    gyro_scale_sd=0.005,
    accel_scale_sd=0.0015,
    gyro_range_radps=float(np.radians(500.0)),
    accel_range_mps2=8.0 * STANDARD_GRAVITY_MPS2,
    magnetometer=Magnetometer(noise_tesla=0.6e-6, range_tesla=4.9e-3),
)
SENSOR_MODELS = {
    "ideal": SensorModel(),
    "consumer": CONSUMER,
    # 0.1 deg/s/g, as the data sheet of the MPU-6000 has it, in the axis that the heading hangs on: walking turns the
    # track by 0.04 deg/s, which no rest shows. Where x and y answer too, they turn it by as much, to either side.
    "g_sensitive": replace(CONSUMER, gyro_g_sensitivity=(0.0, 0.0, float(np.radians(0.1)) / STANDARD_GRAVITY_MPS2)),
    # As printed. 0.1 rad/sqrt(s) is about 570 times what the data sheet of the sensor says; no foot filter survives it.
    "gui_table_1": GUI_TABLE_1,
    # 0.1 deg/sqrt(s), which may be meant: ten times the data sheet
    "gui_table_1_deg": replace(GUI_TABLE_1, gyro_noise_density=float(np.radians(0.1))),
    "qiu_table_1": QIU_TABLE_1,
    "icm_20602": ICM_20602,
}

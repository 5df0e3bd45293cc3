"""What sensors draw, by their data sheets, and what it costs to send a sample. The sources stand in docs/energy.md."""

from typing import NamedTuple


class AccelMode(NamedTuple):
    """A low-power mode of the accelerometer."""

    up_to_hz: float
    current_ma: float


class Part(NamedTuple):
    """A sensor: accelerometer, gyro and, where it has one, magnetometer. Typical currents."""

    gyro_ma: float  # while it is powered
    gyro_off_ma: float  # powered down; 0 where that is within the accelerometer's figure
    start_s: float  # from being switched on until the rates can be trusted
    accel_ma: float  # beside the gyro, or above the rates of the low-power modes
    accel_modes: tuple[AccelMode, ...]  # with the gyro off; by rising rate
    mag_ma: float

    def sensor_ma(self, gyro_on: bool, rate_hz: float) -> float:
        """Return the current [mA] of the whole sensor."""
        return self.mag_ma + (self.gyro_ma + self.accel_ma if gyro_on else self.gyro_off_ma + self.resting_ma(rate_hz))

    def resting_ma(self, rate_hz: float) -> float:
        """Return the current [mA] of the accelerometer while the gyro is off."""
        modes = (mode.current_ma for mode in self.accel_modes if rate_hz <= mode.up_to_hz)
        return next(modes, self.accel_ma)


PARTS = {
    "mpu9250": Part(3.2, 0.0, 0.035, 0.45, (AccelMode(0.98, 0.0084), AccelMode(31.25, 0.0198)), 0.28),
    "mpu6050": Part(
        3.3,  # 3.8 mA for both, of which the accelerometer alone is 0.5 mA
        0.0,
        0.03,
        0.5,
        (AccelMode(1.25, 0.01), AccelMode(5.0, 0.02), AccelMode(20.0, 0.07), AccelMode(40.0, 0.14)),
        0.0,
    ),
    "lsm6dso": Part(0.38, 0.0, 0.08, 0.17, (AccelMode(52.0, 0.026),), 0.0),  # 0.55 mA for both
    "bmi270": Part(0.475, 0.0, 0.002, 0.21, (), 0.0),  # 0.685 mA for both
    "l3gd20_lis3dh": Part(
        6.1,
        0.005,
        0.25,
        0.038,  # at 200 Hz
        (AccelMode(25.0, 0.004), AccelMode(50.0, 0.006), AccelMode(100.0, 0.01), AccelMode(200.0, 0.018)),
        0.0,
    ),
}


class Radio(NamedTuple):
    """A microcontroller that does nothing but send each sample."""

    sleep_ma: float
    busy_ma: float  # radio and processor
    packet_bytes: int  # of samples
    packet_s: float  # to send one and hear that it has arrived

    def sending_ma(self, sample_bytes: int, rate_hz: float) -> float:
        """Return the current [mA] at a rate."""
        busy_share = min(1.0, sample_bytes * rate_hz / self.packet_bytes * self.packet_s)
        return self.sleep_ma + busy_share * (self.busy_ma - self.sleep_ma)


# Bluetooth LE at 1 Mbit/s: 20 bytes of data in 37 bytes on the air, two pauses of 150 us, 10 bytes that acknowledge
NRF52832 = Radio(sleep_ma=0.002, busy_ma=9.2, packet_bytes=20, packet_s=(37 + 10) * 8e-6 + 2 * 150e-6)
STAMP_BYTES, AXES_BYTES = 4, 6


def sample_bytes(gyro_on: bool, magnetometer: bool) -> int:
    """Return the size of a sample: a stamp, and three numbers of 16 bit for each sensor that measures."""
    return STAMP_BYTES + AXES_BYTES * (1 + gyro_on + magnetometer)

"""Between sensor_msgs/Imu and blocks, many messages at a time."""

import numpy as np

from pdr_core.recording.stamped_cdr import decoded, encoded
from pdr_core.records import Floats, ImuBlock, inertial_block

NUMBERS = 37  # orientation 4 + 9, angular rate 3 + 9, acceleration 3 + 9: each with its covariance
ORIENTATION, RATE, ACCELERATION = 0, 13, 25
VARIANCES = [3, 7, 11]  # of a vector's axes, counted from the vector
ORIENTATION_COVARIANCE = 4


def imu_block_from_cdr(messages: list[bytes]) -> ImuBlock | None:
    """Return n messages as a block, None if they differ in layout or one of them cannot be decoded.

    A quantity whose covariance starts with -1 was not measured: its values are zero, its deviation is -1.
    """
    found = decoded(messages, NUMBERS)
    if found is None:
        return None
    stamp_ns, numbers = found
    gyro, gyro_sd = _measured(numbers, RATE)
    accel, accel_sd = _measured(numbers, ACCELERATION)
    return inertial_block(stamp_ns, gyro, accel, gyro_sd, accel_sd)


def cdr_from_imu_block(block: ImuBlock, frame_id: str) -> list[bytes]:
    """Return n messages without an orientation; OverflowError if a stamp does not fit into a ROS message."""
    numbers = np.zeros((len(block.stamp_ns), NUMBERS))
    numbers[:, ORIENTATION + ORIENTATION_COVARIANCE] = -1.0
    for start, vectors, sd in ((RATE, block.gyro_radps, block.gyro_sd_radps),
                               (ACCELERATION, block.accel_mps2, block.accel_sd_mps2)):  # fmt: skip
        numbers[:, start : start + 3] = vectors
        numbers[:, [start + axis for axis in VARIANCES]] = np.where(sd < 0.0, 0.0, sd**2)[:, None]
        numbers[sd < 0.0, start + 3] = -1.0
    return encoded(block.stamp_ns, numbers, frame_id)


def _measured(numbers: Floats, start: int) -> tuple[Floats, Floats]:
    """Return the vectors (n, 3) at `start` and their deviations (n,), told by the covariance that follows them."""
    absent = numbers[:, start + 3] == -1.0
    vectors = np.where(absent[:, None], 0.0, numbers[:, start : start + 3].astype(np.float64))
    return vectors, np.where(absent, -1.0, 0.0)

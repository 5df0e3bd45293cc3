"""Between sensor_msgs/Imu and blocks, many messages at a time: several times as fast as one by one."""

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.recording.stamped_cdr import LITTLE_ENDIAN, encoded, stamped_layout
from pdr_core.records import Floats, ImuBlock, inertial_block

NUMBERS = 37  # orientation 4 + 9, angular rate 3 + 9, acceleration 3 + 9: each with its covariance
ORIENTATION, RATE, ACCELERATION = 0, 13, 25
VARIANCES = [3, 7, 11]  # of a vector's axes, counted from the vector
ORIENTATION_COVARIANCE = 4


def imu_block_from_cdr(messages: list[bytes]) -> ImuBlock | None:
    """Return n messages as a block, None if they differ in layout or one of them cannot be decoded.

    A quantity whose covariance starts with -1 was not measured: its values are zero, its deviation is -1.
    """
    layout = _layout(messages[0])
    if layout is None or any(len(m) != layout.itemsize for m in messages):
        return None
    table = np.frombuffer(b"".join(messages), layout)
    if (table["kind"] != table["kind"][0]).any():
        return None
    stamp_ns = table["sec"].astype(np.int64) * NANOSECONDS + table["nanosec"]
    gyro, gyro_sd = _measured(table["numbers"], RATE)
    accel, accel_sd = _measured(table["numbers"], ACCELERATION)
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


def _layout(message: bytes) -> np.dtype | None:
    """Return where the fields of a message are, None if it is not as long as they ask for."""
    little = message[:2] == LITTLE_ENDIAN
    frame_bytes = int.from_bytes(message[12:16], "little" if little else "big")
    if frame_bytes > len(message):
        return None
    layout = stamped_layout("<" if little else ">", frame_bytes, NUMBERS)
    return layout if layout.itemsize == len(message) else None


def _measured(numbers: Floats, start: int) -> tuple[Floats, Floats]:
    """Return the vectors (n, 3) at `start` and their deviations (n,), told by the covariance that follows them."""
    absent = numbers[:, start + 3] == -1.0
    vectors = np.where(absent[:, None], 0.0, numbers[:, start : start + 3].astype(np.float64))
    return vectors, np.where(absent, -1.0, 0.0)

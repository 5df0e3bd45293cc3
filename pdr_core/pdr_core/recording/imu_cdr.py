"""Decodes sensor_msgs/Imu many messages at a time, several times as fast as one by one."""

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.records import Floats, ImuBlock

NUMBERS = 37  # orientation 4 + 9, angular rate 3 + 9, acceleration 3 + 9: each with its covariance
RATE, ACCELERATION = 13, 25
LITTLE_ENDIAN = b"\x00\x01"


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
    return ImuBlock(stamp_ns, gyro, accel, gyro_sd, accel_sd)


def _layout(message: bytes) -> np.dtype | None:
    """Return where the fields of a message are, None if it is not as long as they ask for."""
    order = "<" if message[:2] == LITTLE_ENDIAN else ">"
    frame_bytes = int.from_bytes(message[12:16], "little" if order == "<" else "big")
    numbers = 4 + (12 + frame_bytes + 7) // 8 * 8  # aligned to 8 after the 4 bytes that say how it is encoded
    if len(message) != numbers + 8 * NUMBERS:
        return None
    fields = {
        "kind": ("S2", 0),
        "sec": (f"{order}i4", 4),
        "nanosec": (f"{order}u4", 8),
        "numbers": (f"({NUMBERS},){order}f8", numbers),
    }
    formats, offsets = zip(*fields.values(), strict=True)
    return np.dtype({"names": list(fields), "formats": formats, "offsets": offsets, "itemsize": len(message)})


def _measured(numbers: Floats, start: int) -> tuple[Floats, Floats]:
    """Return the vectors (n, 3) at `start` and their deviations (n,), told by the covariance that follows them."""
    absent = numbers[:, start + 3] == -1.0
    vectors = np.where(absent[:, None], 0.0, numbers[:, start : start + 3].astype(np.float64))
    return vectors, np.where(absent, -1.0, 0.0)

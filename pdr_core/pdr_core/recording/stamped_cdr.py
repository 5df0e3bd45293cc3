"""CDR of messages that are a header and numbers: sensor_msgs/Imu, MagneticField, geometry_msgs/PointStamped.

Many messages at a time: several times as fast as one by one.
"""

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.records import Floats, Stamps

LITTLE_ENDIAN = b"\x00\x01"
EARLIEST_S, LATEST_S = -(2**31), 2**31 - 1


def stamped_layout(order: str, frame_bytes: int, count: int) -> np.dtype:
    """Return where the fields of a message are; `order` is '<' or '>', the frame's bytes include their final zero."""
    numbers = 4 + (12 + frame_bytes + 7) // 8 * 8  # aligned to 8 after the 4 bytes that say how it is encoded
    fields = {
        "kind": ("S2", 0),
        "sec": (f"{order}i4", 4),
        "nanosec": (f"{order}u4", 8),
        "frame_bytes": (f"{order}u4", 12),
        "frame": (f"S{frame_bytes}", 16),
        "numbers": (f"({count},){order}f8", numbers),
    }
    formats, offsets = zip(*fields.values(), strict=True)
    size = numbers + 8 * count
    return np.dtype({"names": list(fields), "formats": formats, "offsets": offsets, "itemsize": size})


def decoded(messages: list[bytes], count: int) -> tuple[Stamps, Floats] | None:
    """Return stamps (n,) and numbers (n, count), None if messages differ in layout or one cannot be decoded."""
    layout = _layout(messages[0], count)
    if layout is None or any(len(m) != layout.itemsize for m in messages):
        return None
    table = np.frombuffer(b"".join(messages), layout)
    if (table["kind"] != table["kind"][0]).any():
        return None
    return table["sec"].astype(np.int64) * NANOSECONDS + table["nanosec"], table["numbers"]


def _layout(message: bytes, count: int) -> np.dtype | None:
    """Return where the fields of a message are, None if it is not as long as they ask for."""
    little = message[:2] == LITTLE_ENDIAN
    frame_bytes = int.from_bytes(message[12:16], "little" if little else "big")
    if frame_bytes > len(message):
        return None
    layout = stamped_layout("<" if little else ">", frame_bytes, count)
    return layout if layout.itemsize == len(message) else None


def encoded(stamp_ns: Stamps, numbers: Floats, frame_id: str) -> list[bytes]:
    """Return n messages of (n, count) numbers; OverflowError if a stamp does not fit into a ROS message."""
    frame = frame_id.encode() + b"\0"
    layout = stamped_layout("<", len(frame), numbers.shape[1])
    seconds, nanoseconds = np.divmod(stamp_ns, NANOSECONDS)
    if len(seconds) and not EARLIEST_S <= seconds.min() <= seconds.max() <= LATEST_S:
        raise OverflowError("a ROS message holds stamps from the years 1901 to 2038 only")
    table = np.zeros(len(stamp_ns), layout)
    columns = (LITTLE_ENDIAN, seconds, nanoseconds, len(frame), frame, numbers)
    for name, column in zip(layout.names or (), columns, strict=True):
        table[name] = column
    content = table.tobytes()
    return [content[i : i + layout.itemsize] for i in range(0, len(content), layout.itemsize)]

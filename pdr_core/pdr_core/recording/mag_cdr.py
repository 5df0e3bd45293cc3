"""Between sensor_msgs/MagneticField and arrays, many messages at a time."""

from typing import NamedTuple

import numpy as np

from pdr_core.recording.stamped_cdr import decoded, encoded
from pdr_core.records import Floats, Stamps

NUMBERS = 12  # the field 3 + 9: its covariance
VARIANCES = [3, 7, 11]  # of the axes


class FieldBlock(NamedTuple):
    """n measurements of the magnetic field, in the axes of the sensor."""

    stamp_ns: Stamps  # (n,)
    field_tesla: Floats  # (n, 3)
    field_sd_tesla: Floats  # (n,) noise of one axis; 0 = unknown, -1: not measured


def field_block_from_cdr(messages: list[bytes]) -> FieldBlock | None:
    """Return n messages as a block, None if they differ in layout or one of them cannot be decoded.

    A field whose covariance starts with -1 was not measured: it is zero, its deviation is -1.
    """
    found = decoded(messages, NUMBERS)
    if found is None:
        return None
    stamp_ns, numbers = found[0], found[1].astype(np.float64)
    variance = numbers[:, VARIANCES[0]]
    there = variance != -1.0
    known = np.isfinite(variance) & (variance > 0.0)
    field_sd_tesla = np.where(there, np.sqrt(np.where(known, variance, 0.0)), -1.0)
    return FieldBlock(stamp_ns, np.where(there[:, None], numbers[:, :3], 0.0), field_sd_tesla)


def cdr_from_field_block(block: FieldBlock, frame_id: str) -> list[bytes]:
    """Return n messages; OverflowError if a stamp does not fit into a ROS message."""
    numbers = np.zeros((len(block.stamp_ns), NUMBERS))
    numbers[:, :3] = block.field_tesla
    numbers[:, VARIANCES] = np.maximum(block.field_sd_tesla, 0.0)[:, None] ** 2
    numbers[block.field_sd_tesla < 0.0, VARIANCES[0]] = -1.0
    return encoded(block.stamp_ns, numbers, frame_id)

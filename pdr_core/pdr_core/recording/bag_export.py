"""Writes sensors and their true positions as a bag that opens as the same recording."""

import re
from collections.abc import Iterator, Mapping, Sequence
from heapq import merge
from operator import itemgetter
from pathlib import Path

import numpy as np

from pdr_core.recording.bag_writer import BagWriter
from pdr_core.recording.imu_cdr import cdr_from_imu_block
from pdr_core.recording.mag_cdr import FieldBlock, cdr_from_field_block
from pdr_core.recording.session import Sensor
from pdr_core.recording.stamped_cdr import encoded
from pdr_core.records import Stamps, Truth
from pdr_core.records_external import FixBlock

IMU, MAGNETIC = "sensor_msgs/msg/Imu", "sensor_msgs/msg/MagneticField"
POINT = "geometry_msgs/msg/PointStamped"  # nobody knows the true attitude
TRUTH_FRAME = "ground_truth"
FIX, FIX_NUMBERS = "geometry_msgs/msg/PoseWithCovarianceStamped", 43  # place, attitude, covariance
FIX_FRAME, FIX_Z_W, FIX_VARIANCES = "map", [5, 6], [7, 14, 21]
NOTHING: Mapping[str, FixBlock] = {}
Message = tuple[int, str, str, bytes]  # time of recording [ns], topic, type, CDR


def write_bag(path: Path, sensors: Sequence[Sensor], beside: Mapping[str, FixBlock] = NOTHING) -> None:
    """Write a rosbag2 directory with MCAP storage, and somebody else's fixes by topic.

    OverflowError if a stamp does not fit into a ROS message.
    """
    streams = [_samples(sensor) for sensor in sensors]
    streams += [_truth(sensor.name, sensor.truth) for sensor in sensors if sensor.truth]
    streams += [_fixes(topic, fixes) for topic, fixes in beside.items()]
    with BagWriter(path, {}) as bag:
        for recorded_ns, topic, msgtype, cdr in merge(*streams, key=itemgetter(0)):
            bag.write(topic, msgtype, recorded_ns, cdr)


def namespace(sensor: str) -> str:
    """Return a sensor's name as ROS allows it in a topic."""
    return "/" + re.sub(r"(^|/)(?=\d)", r"\1_", re.sub(r"[^A-Za-z0-9_/]", "_", sensor))


def recording_times_ns(stamp_ns: Stamps, after_ns: int) -> Stamps:
    """Return strictly ascending times later than `after_ns`, as near to the stamps, (n,), as that allows.

    A bag is played in the order of these times, so rows that repeat or go back keep their place.
    """
    row = np.arange(len(stamp_ns))
    return np.maximum.accumulate(np.maximum(stamp_ns, after_ns + 1) - row) + row


def _samples(sensor: Sensor) -> Iterator[Message]:
    latest_ns = -1
    for piece in sensor.pieces():
        times_ns = recording_times_ns(piece.stamp_ns, latest_ns)
        latest_ns = int(times_ns[-1])
        topic, field_topic = f"{namespace(sensor.name)}/data_raw", f"{namespace(sensor.name)}/mag"
        there = piece.field_sd_tesla >= 0.0
        fields = FieldBlock(piece.stamp_ns[there], piece.field_tesla[there], piece.field_sd_tesla[there])
        messages, field_messages = cdr_from_imu_block(piece, sensor.name), cdr_from_field_block(fields, sensor.name)
        field_of = dict(zip(np.flatnonzero(there).tolist(), field_messages, strict=True))
        for i, (recorded_ns, cdr) in enumerate(zip(times_ns.tolist(), messages, strict=True)):
            yield recorded_ns, topic, IMU, cdr
            if i in field_of:
                yield recorded_ns, field_topic, MAGNETIC, field_of[i]


def _truth(sensor: str, truth: Truth) -> Iterator[Message]:
    """Yield positions; other kinds of truth have no stamps."""
    times_ns = recording_times_ns(truth.stamp_ns, -1).tolist()
    messages = encoded(truth.stamp_ns, truth.position_m, TRUTH_FRAME) if times_ns else []
    yield from ((t, f"{namespace(sensor)}/ground_truth", POINT, cdr) for t, cdr in zip(times_ns, messages, strict=True))


def _fixes(topic: str, fixes: FixBlock) -> Iterator[Message]:
    """Yield somebody else's positions; their attitude is none of ours."""
    numbers = np.zeros((len(fixes.stamp_ns), FIX_NUMBERS))
    numbers[:, :3], numbers[:, FIX_VARIANCES] = fixes.position_m, fixes.variance_m2
    half_rad = 0.5 * fixes.yaw_rad
    numbers[:, FIX_Z_W] = np.nan_to_num(np.column_stack([np.sin(half_rad), np.cos(half_rad)]))  # none: unknown
    times_ns = recording_times_ns(fixes.stamp_ns, -1).tolist()
    messages = encoded(fixes.stamp_ns, numbers, FIX_FRAME) if times_ns else []
    yield from ((t, topic, FIX, cdr) for t, cdr in zip(times_ns, messages, strict=True))

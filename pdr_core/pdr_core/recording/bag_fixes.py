"""Somebody else's positions beside the samples of sensors in a bag, and when they came."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.recording.bag_messages import BagReader
from pdr_core.recording.session import Arrivals, RecordingError
from pdr_core.records_external import FixBlock, known_variances, yaw_or_none

WITH_COVARIANCE = {"nav_msgs/msg/Odometry", "geometry_msgs/msg/PoseWithCovarianceStamped"}
KINDS = WITH_COVARIANCE | {"geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PointStamped"}


def arrivals(bag: BagReader, imu_topics: Sequence[str], topic: str) -> Arrivals:
    """Return the fixes of a topic beside the samples of Imu topics; RecordingError if it holds no positions."""
    from rosbags.typesys import Stores, get_typestore

    topics = bag.topics()
    if topics.get(topic) not in KINDS:
        known = ", ".join(sorted(name for name, kind in topics.items() if kind in KINDS)) or "none"
        raise RecordingError(f"--external {topic}: the recording holds no positions of that name; it has: {known}.")
    decode, rows, counts, damaged = get_typestore(Stores.ROS2_JAZZY).deserialize_cdr, [], [], 0
    samples = dict.fromkeys(imu_topics, 0)
    for name, cdr in bag.messages_of([*imu_topics, topic]):
        if name in samples:
            samples[name] += 1
        else:
            try:
                rows.append(row(decode(cdr, topics[topic])))
                counts.append(list(samples.values()))
            except Exception:  # damaged bytes make rosbags raise anything
                damaged += 1
    if damaged:
        bag.tell_unreadable(topic, damaged, 0)
    stamps = np.array([at_ns for at_ns, *_ in rows], np.int64)
    numbers = np.array([values for _, values in rows], np.float64).reshape(-1, 7)
    fixes = FixBlock(stamps, numbers[:, :3], numbers[:, 3:6], numbers[:, 6])
    return Arrivals(fixes, np.array(counts, np.int64).reshape(-1, len(samples)))


def row(message: Any) -> tuple[int, list[float]]:
    """Return stamp, place, variances and yaw of a message; variances of 0, a yaw of NaN where it does not say them."""
    stamp = message.header.stamp
    place = message.point if hasattr(message, "point") else message.pose
    covariance = getattr(place, "covariance", np.zeros(36))
    place, yaw_rad = getattr(place, "pose", place), float("nan")
    if hasattr(place, "position"):
        turn = place.orientation
        place, yaw_rad = place.position, yaw_or_none((turn.x, turn.y, turn.z, turn.w))
    variances = [float(covariance[7 * axis]) for axis in range(3)]
    return stamp.sec * NANOSECONDS + stamp.nanosec, [place.x, place.y, place.z, *known_variances(variances), yaw_rad]

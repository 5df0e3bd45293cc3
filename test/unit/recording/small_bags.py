"""Small bags for the tests of this folder."""

from pathlib import Path

import numpy as np
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

TYPES = get_typestore(Stores.ROS2_JAZZY)
MAG = "sensor_msgs/msg/MagneticField"
IMU, POINT, POSE = "sensor_msgs/msg/Imu", "geometry_msgs/msg/PointStamped", "geometry_msgs/msg/PoseStamped"
START_NS = 1_700_000_000_000_000_001
STEP_NS = 5_000_003


def stamp(i: int) -> int:
    return START_NS + i * STEP_NS


def header(i: int, frame: str = "foot"):
    time = TYPES.types["builtin_interfaces/msg/Time"](stamp(i) // 10**9, stamp(i) % 10**9)
    return TYPES.types["std_msgs/msg/Header"](time, frame)


def vector(*xyz: float):
    return TYPES.types["geometry_msgs/msg/Vector3"](*xyz)


def imu_cdr(i: int, frame: str = "foot", gyro_covariance: float = 0.0, little_endian: bool = True) -> bytes:
    covariance = np.array([gyro_covariance, *[0.0] * 8])
    quaternion = TYPES.types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
    message = TYPES.types[IMU](
        header(i, frame), quaternion, np.zeros(9), vector(i, 2.0, 3.0), covariance, vector(0.1, 0.2, i), np.zeros(9)
    )
    return bytes(TYPES.serialize_cdr(message, IMU, little_endian=little_endian))


def mag_cdr(i: float, variance: float = 0.0, little_endian: bool = True, frame: str = "foot") -> bytes:
    """A field at, or between, the stamps of samples; its x axis tells which."""
    covariance = np.array([variance, *[0.0] * 8])
    time_ns = stamp(0) + round(i * STEP_NS)
    time = TYPES.types["builtin_interfaces/msg/Time"](time_ns // 10**9, time_ns % 10**9)
    message = TYPES.types[MAG](TYPES.types["std_msgs/msg/Header"](time, frame), vector(i, 2e-5, -4e-5), covariance)
    return bytes(TYPES.serialize_cdr(message, MAG, little_endian=little_endian))


def point_cdr(i: int) -> bytes:
    point = TYPES.types["geometry_msgs/msg/Point"](float(i), 2.0, 3.0)
    return bytes(TYPES.serialize_cdr(TYPES.types[POINT](header(i, "map"), point), POINT))


def pose_cdr(i: int) -> bytes:
    types = TYPES.types
    pose = types["geometry_msgs/msg/Pose"](
        types["geometry_msgs/msg/Point"](1.0, float(i), 3.0), types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
    )
    return bytes(TYPES.serialize_cdr(types[POSE](header(i), pose), POSE))


def odometry_cdr(i: int) -> bytes:
    types = TYPES.types
    pose = types["geometry_msgs/msg/Pose"](
        types["geometry_msgs/msg/Point"](1.0, 2.0, float(i)), types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
    )
    twist = types["geometry_msgs/msg/Twist"](vector(0.0, 0.0, 0.0), vector(0.0, 0.0, 0.0))
    message = types["nav_msgs/msg/Odometry"](
        header(i),
        "foot",
        types["geometry_msgs/msg/PoseWithCovariance"](pose, np.zeros(36)),
        types["geometry_msgs/msg/TwistWithCovariance"](twist, np.zeros(36)),
    )
    return bytes(TYPES.serialize_cdr(message, "nav_msgs/msg/Odometry"))


def write_bag(path: Path, messages: list[tuple[str, str, bytes]], storage: str, mode=CompressionMode.NONE) -> Path:
    """Write (topic, type, CDR) messages, received an hour after their stamps; return the storage file."""
    plugin = {"mcap": StoragePlugin.MCAP, "sqlite3": StoragePlugin.SQLITE3}[storage]
    new = Writer(path, version=9, storage_plugin=plugin)
    new.set_compression(mode, CompressionFormat.ZSTD)
    with new as writer:
        connections = {}
        for i, (topic, msgtype, cdr) in enumerate(messages):
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, msgtype, typestore=TYPES)
            writer.write(connections[topic], stamp(i) + 3_600_000_000_000, cdr)
    return next(f for f in path.iterdir() if f.suffix != ".yaml")


def imu_messages(count: int, topic: str = "/imu/data_raw") -> list[tuple[str, str, bytes]]:
    return [(topic, IMU, imu_cdr(i)) for i in range(count)]

"""Opens rosbag2 recordings and ROS 1 bags: every sensor_msgs/Imu topic is a sensor, each ground_truth topic a truth."""

from collections.abc import Iterable
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from pdr_core.recording.bag_messages import BagReader
from pdr_core.recording.bag_storage import SUFFIXES, open_storage
from pdr_core.recording.ros1_storage import SUFFIX as ROS1
from pdr_core.recording.session import RecordingError, Sensor, Session, put_warning
from pdr_core.records import Notice, Truth

IMU = "sensor_msgs/msg/Imu"
POSES = {"nav_msgs/msg/Odometry", "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PointStamped"}
FORMATS = SUFFIXES | {ROS1: "ros1"}
TRUTH, RAW, COOKED = "/ground_truth", "/data_raw", "/data"


def open_bag_session(path: Path) -> Session:
    """Open a rosbag2 directory, .mcap, .db3 or .bag file; RecordingError if it holds no sensor_msgs/Imu topic."""
    notices: list[Notice] = []
    files = _files(path, notices) if path.is_dir() else [path]
    bag = BagReader([open_storage(file) for file in files], notices)
    topics = bag.topics()
    imus = sensor_names(topic for topic, msgtype in topics.items() if msgtype == IMU)
    if not imus:
        raise RecordingError(_nothing_inside(path, topics))
    truths = {t.removesuffix(TRUTH): t for t, msgtype in topics.items() if t.endswith(TRUTH) and msgtype in POSES}
    sensors = {name: Sensor(name, _truth(bag, t, truths), partial(bag.imu_blocks, t)) for name, t in imus.items()}
    name = path.name if path.is_dir() else path.stem
    return Session(name, path, FORMATS.get(files[0].suffix, "rosbag2"), sensors, notices)


def sensor_names(topics: Iterable[str]) -> dict[str, str]:
    """Return the Imu topics to read by sensor name: '/foot/data_raw' is 'foot', and stands before '/foot/data'."""
    names: dict[str, str] = {}
    for topic in sorted(topics, key=lambda t: (not t.endswith(RAW), t)):
        base = topic.removesuffix(RAW).removesuffix(COOKED)
        if topic.endswith(COOKED) and base + RAW in names.values():
            continue
        name = base.strip("/")
        names[name if name and name not in names else topic.strip("/")] = topic
    return names


def _files(path: Path, notices: list[Notice]) -> list[Path]:
    """Return the storage files in the order in which they were recorded; the directory itself if it is compressed."""
    metadata = _metadata(path)
    if metadata.get("compression_mode"):
        return [path]
    found = sorted((f for f in path.iterdir() if f.suffix in SUFFIXES), key=lambda f: (len(f.name), f.name))
    if not found:
        raise RecordingError(f"{path} holds no .mcap or .db3 file: give a rosbag2 directory or a single recording.")
    for listed in metadata.get("relative_file_paths") or []:
        if not (path / Path(str(listed)).name).exists():
            put_warning(notices, "missing_file", f"{listed} is missing from the bag.", 1, 0)
    return found


def _metadata(path: Path) -> dict[str, Any]:
    """Return the information in metadata.yaml, as far as there is any."""
    import yaml

    with suppress(OSError, ValueError, yaml.YAMLError):
        document = yaml.safe_load((path / "metadata.yaml").read_text())
        information = document.get("rosbag2_bagfile_information") if isinstance(document, dict) else None
        return information if isinstance(information, dict) else {}
    return {}


def _nothing_inside(path: Path, topics: dict[str, str]) -> str:
    if not topics:
        return f"{path} holds no readable topic: copy it again from where it came, or record it again."
    listed = ", ".join(f"{topic} ({msgtype})" for topic, msgtype in sorted(topics.items()))
    return f"{path} holds no sensor_msgs/Imu topic, only {listed}: record the IMU's topic too."


def _truth(bag: BagReader, imu_topic: str, truths: dict[str, str]) -> Truth | None:
    """Return the truth of the closest namespace that the Imu topic is in."""
    around = [namespace for namespace in truths if imu_topic.startswith(namespace + "/")]
    if not around:
        return None
    truth = bag.position_truth(truths[max(around, key=len)])
    return truth if len(truth.stamp_ns) else None

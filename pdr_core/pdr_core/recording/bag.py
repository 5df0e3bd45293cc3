"""Opens rosbag2 recordings and ROS 1 bags: every sensor_msgs/Imu topic is a sensor, each ground_truth topic a truth.

Topics are called as REP-145 has it: beside `imu/data_raw` or `imu/data` is `imu/mag`, the field at the same sensor.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from pdr_core.recording.bag_fixes import arrivals
from pdr_core.recording.bag_messages import BagReader
from pdr_core.recording.bag_storage import SUFFIXES, open_storage
from pdr_core.recording.ros1_storage import SUFFIX as ROS1
from pdr_core.recording.session import Arrivals, RecordingError, Sensor, Session, put_warning
from pdr_core.records import ImuBlock, Notice, Truth

IMU, MAGNETIC = "sensor_msgs/msg/Imu", "sensor_msgs/msg/MagneticField"
POSES = {"nav_msgs/msg/Odometry", "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PointStamped"}
FORMATS = SUFFIXES | {ROS1: "ros1"}
TRUTH, RAW, COOKED, MAG = "/ground_truth", "/data_raw", "/data", "/mag"


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
    fields = field_topics(list(imus.values()), [t for t, msgtype in topics.items() if msgtype == MAGNETIC])
    sensors = {name: Sensor(name, _truth(bag, t, truths), _reading(bag, t, fields)) for name, t in imus.items()}
    name = path.name if path.is_dir() else path.stem

    def with_fixes(sensors: Sequence[str], topic: str) -> Arrivals:
        return arrivals(bag, [imus[sensor] for sensor in sensors], topic)

    return Session(name, path, FORMATS.get(files[0].suffix, "rosbag2"), sensors, notices, arrivals=with_fixes)


def sensor_names(topics: Iterable[str]) -> dict[str, str]:
    """Return the Imu topics to read by sensor name: '/foot/data_raw' is 'foot', and stands before '/foot/data'."""
    names: dict[str, str] = {}
    for topic in sorted(topics, key=lambda t: (not t.endswith(RAW), t)):
        base = _base(topic)
        if topic.endswith(COOKED) and base + RAW in names.values():
            continue
        name = base.strip("/")
        names[name if name and name not in names else topic.strip("/")] = topic
    return names


def field_topics(imus: Sequence[str], fields: Sequence[str]) -> dict[str, str]:
    """Return the MagneticField topic of each Imu topic that has one: `mag` beside it, or the only one for the only."""
    if len(imus) == 1 and len(fields) == 1:
        return {imus[0]: fields[0]}
    return {imu: _base(imu) + MAG for imu in imus if _base(imu) + MAG in fields}


def _base(imu_topic: str) -> str:
    return imu_topic.removesuffix(RAW).removesuffix(COOKED)


def _reading(bag: BagReader, topic: str, fields: dict[str, str]) -> Callable[[int], Iterator[ImuBlock]]:
    return partial(bag.paired_blocks, topic, fields[topic]) if topic in fields else partial(bag.imu_blocks, topic)


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

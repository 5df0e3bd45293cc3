"""Whatever a recording came in, every sample that is written is what it was, to the last bit."""

import io

import numpy as np
import pytest
from export_cases import COUNT, OUTPUTS, block, converted
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import CompressionMode
from rosbags.typesys import Stores, get_typestore
from scipy.io import savemat
from small_bags import IMU, MAG, POINT, imu_cdr, imu_messages, mag_cdr, point_cdr, stamp, write_bag

from pdr_core.recording import RecordingError, open_recording

ROS1, ROS2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_JAZZY)
MAP = """name: mine
time: {column: ms, unit: ms}
sensors:
  shoe:
    gyro: {columns: [a, b, c], unit: deg/s}
    accel: {columns: [d, e, f], unit: g}
"""
MAT_MAP = MAP.replace("a, b, c", "m.0, m.1, m.2").replace("d, e, f", "m.3, m.4, m.5").replace("unit: ms", "unit: s")


def ros1_bag(path, compression):
    """Write the small bag as ROS 1 did, headers with `seq` included."""
    writer = Ros1Writer(path)
    if compression:
        writer.set_compression(Ros1Writer.CompressionFormat[compression])
    header = ROS1.types["std_msgs/msg/Header"]
    with writer:
        connections = {
            t: writer.add_connection(f"/imu/{n}", t, typestore=ROS1)
            for t, n in ((IMU, "data"), (MAG, "mag"), (POINT, "ground_truth"))
        }
        for i in range(COUNT):
            for msgtype, cdr in ((IMU, imu_cdr(i)), (MAG, mag_cdr(i)), (POINT, point_cdr(i))):
                message = ROS2.deserialize_cdr(cdr, msgtype)
                object.__setattr__(message, "header", header(i, message.header.stamp, message.header.frame_id))
                writer.write(connections[msgtype], stamp(i), ROS1.serialize_ros1(message, msgtype))
    return path


@OUTPUTS
@pytest.mark.parametrize("compression", ["", "LZ4", "BZ2"])
def test_a_ros1_bag(tmp_path, compression, name):
    _, after = converted(ros1_bag(tmp_path / "walk.bag", compression), tmp_path / name)
    assert block(after).stamp_ns.tolist() == [stamp(i) for i in range(COUNT)]
    assert block(after).gyro_radps.tolist() == [[i, 2.0, 3.0] for i in range(COUNT)]
    assert block(after).field_tesla.tolist() == [[i, 2e-5, -4e-5] for i in range(COUNT)]
    (sensor,) = after.sensors.values()
    assert sensor.truth.position_m.tolist() == [[i, 2.0, 3.0] for i in range(COUNT)]
    assert sensor.truth.stamp_ns.tolist() == [stamp(i) for i in range(COUNT)]


def test_a_cut_ros1_bag_is_refused_with_what_mends_it(tmp_path):
    path = ros1_bag(tmp_path / "walk.bag", "")
    path.write_bytes(path.read_bytes()[:-500])
    with pytest.raises(RecordingError, match="rosbag reindex"):
        open_recording(path)


@OUTPUTS
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("mode", [CompressionMode.FILE, CompressionMode.MESSAGE])
def test_a_bag_that_rosbag2_compressed(tmp_path, storage, mode, name):
    write_bag(tmp_path / "walk", imu_messages(COUNT), storage, mode)
    converted(tmp_path / "walk", tmp_path / name)


@pytest.mark.parametrize("compression", list(CompressionType))
def test_an_mcap_with_compressed_chunks_and_the_same_cut_off(tmp_path, compression):
    file = io.BytesIO()
    writer = McapWriter(file, chunk_size=4000, compression=compression)
    writer.start("ros2")
    channel = writer.register_channel("/imu/data", "cdr", writer.register_schema(IMU, "ros2msg", b""))
    for i in range(COUNT):
        writer.add_message(channel, stamp(i), imu_cdr(i), stamp(i))
    writer.finish()
    for cut, name in ((None, "whole"), (-len(file.getvalue()) // 2, "cut")):
        (tmp_path / f"{name}.mcap").write_bytes(file.getvalue()[:cut])
        session, after = converted(tmp_path / f"{name}.mcap", tmp_path / name)
        assert [n.kind for n in session.notices] == (["damaged_recording"] if cut else [])
        assert after.notices == []
        assert 0 < len(block(after).stamp_ns) <= COUNT - 10 if cut else len(block(after).stamp_ns) == COUNT


@OUTPUTS
@pytest.mark.parametrize("suffix", [".csv", ".mat"])
def test_a_users_columns(tmp_path, suffix, name):
    rng = np.random.default_rng(1)
    time, values = np.cumsum(rng.uniform(0.0, 0.01, COUNT)).round(6), rng.normal(size=(COUNT, 6))
    path = tmp_path / f"mine{suffix}"
    if suffix == ".mat":
        savemat(path, {"ms": time, "m": values})
        path.with_suffix(".yaml").write_text(MAT_MAP)
    else:
        rows = [",".join(map(repr, row)) for row in np.column_stack([time * 1e3, values]).tolist()]
        path.write_text("\n".join(["ms,a,b,c,d,e,f", *rows]) + "\n")
        path.with_suffix(".yaml").write_text(MAP)
    converted(path, tmp_path / name)

import io
from pathlib import Path

import numpy as np
import pytest
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import CompressionMode
from rosbags.typesys import Stores, get_typestore
from scipy.io import savemat
from small_bags import IMU, MAG, POINT, START_NS, STEP_NS, imu_cdr, imu_messages, mag_cdr, point_cdr, stamp, write_bag

from pdr_core.recording import RecordingError, Sensor, Session, open_recording
from pdr_core.recording.bag_export import namespace, recording_times_ns
from pdr_core.recording.export import write_recording
from pdr_core.recording.imu_cdr import cdr_from_imu_block, imu_block_from_cdr
from pdr_core.recording.mag_cdr import FieldBlock, cdr_from_field_block, field_block_from_cdr
from pdr_core.records import Truth, TruthKind, inertial_block, joined, part

COUNT = 60
ROW = np.arange(COUNT)
OUTPUTS = pytest.mark.parametrize("name", ["out", "out.mcap", "out.csv"])
ROS1, ROS2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_JAZZY)
MAP = """name: mine
time: {column: ms, unit: ms}
sensors:
  shoe:
    gyro: {columns: [a, b, c], unit: deg/s}
    accel: {columns: [d, e, f], unit: g}
"""
MAT_MAP = MAP.replace("a, b, c", "m.0, m.1, m.2").replace("d, e, f", "m.3, m.4, m.5").replace("unit: ms", "unit: s")


def block(session, name=None):
    sensor = session.sensors[name] if name else next(iter(session.sensors.values()))
    return joined(list(sensor.pieces(17)))


def check_same(one, other):
    for a, b in zip(one, other, strict=True):
        np.testing.assert_array_equal(a, b)


def converted(source, output, **options):
    """Convert, open what came out, and check that every sample is what it was, to the last bit."""
    session = open_recording(source)
    write_recording(session, list(session.sensors.values()), output, **options)
    after = open_recording(output)
    assert len(after.sensors) == len(session.sensors)
    for name in session.sensors:
        check_same(block(after, name), block(session, name))
    return session, after


def in_memory(samples, truth=None, name="imu"):
    """A session of one sensor that never was a file."""
    return Session("made", Path("made"), "made", {name: Sensor(name, truth, lambda _: iter([samples]))})


def noise(count, seed=3):
    rng = np.random.default_rng(seed)
    stamps = START_NS + np.arange(count) * STEP_NS
    return inertial_block(
        stamps, rng.normal(size=(count, 3)), rng.normal(size=(count, 3)), np.zeros(count), np.zeros(count)
    )


def with_field(samples, there, sd=0.0):
    """Samples of which those that are flagged have a field."""
    field = np.where(there[:, None], np.random.default_rng(5).normal(0.0, 5e-5, (len(there), 3)), 0.0)
    return samples._replace(field_tesla=field, field_sd_tesla=np.where(there, sd, -1.0))


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


@OUTPUTS
@pytest.mark.parametrize(
    "there",
    [np.ones(COUNT, bool), ROW % 9 == 4, ROW >= 40, np.random.default_rng(1).random(COUNT) < 0.5],
    ids=["always", "slow", "late", "at_random"],
)
def test_the_field_of_those_that_have_one(tmp_path, name, there):
    samples = with_field(noise(COUNT), there)
    sensor = Sensor("imu", None, lambda _: (part(samples, a, a + 25) for a in range(0, COUNT, 25)))
    write_recording(in_memory(samples), [sensor], tmp_path / name)
    after = open_recording(tmp_path / name)
    for size in (1, 17, 65536):
        check_same(joined(list(after.sensors["imu"].pieces(size))), samples)
    assert after.notices == []


@OUTPUTS
def test_without_any_field_nothing_is_written_of_one(tmp_path, name):
    session = in_memory(noise(COUNT))
    write_recording(session, list(session.sensors.values()), tmp_path / name)
    files = [f for f in tmp_path.rglob("*") if f.is_file()]
    assert files
    assert not any(word in f.read_bytes() for f in files for word in (b"mag", b"MagneticField"))


@pytest.mark.parametrize("name", ["out", "out.mcap"])
def test_the_noise_of_the_field_stays_in_a_bag(tmp_path, name):
    sd = np.random.default_rng(6).uniform(1e-9, 1e-6, COUNT)
    session = in_memory(with_field(noise(COUNT), np.arange(COUNT) % 3 > 0, sd))
    write_recording(session, list(session.sensors.values()), tmp_path / name)
    check_same(block(open_recording(tmp_path / name)), block(session))


@OUTPUTS
def test_rows_that_repeat_or_go_back_keep_their_place(tmp_path, name):
    samples = with_field(noise(COUNT), np.ones(COUNT, bool))
    stamps = samples.stamp_ns.copy()
    stamps[10:13] = stamps[10]
    stamps[20:] -= 10**10
    stamps[30], stamps[31] = -5, stamps[30]
    session = in_memory(samples._replace(stamp_ns=stamps))
    write_recording(session, list(session.sensors.values()), tmp_path / name)
    check_same(block(open_recording(tmp_path / name)), block(session))


def test_recording_times_ascend_and_stay_near():
    stamps = np.array([5, 5, 3, 10, 11, 11, 12])
    assert recording_times_ns(stamps, -1).tolist() == [5, 6, 7, 10, 11, 12, 13]
    assert recording_times_ns(stamps, 8).tolist() == [9, 10, 11, 12, 13, 14, 15]


@OUTPUTS
def test_a_truth_of_its_own_stamps_goes_along(tmp_path, name):
    truth = Truth(TruthKind.POSITION, START_NS - 7 + np.arange(9) * 33, np.random.default_rng(2).normal(size=(9, 3)))
    session = in_memory(noise(COUNT), truth)
    write_recording(session, list(session.sensors.values()), tmp_path / name)
    after = open_recording(tmp_path / name).sensors["imu"].truth
    assert after.stamp_ns.tolist() == truth.stamp_ns.tolist()
    np.testing.assert_array_equal(after.position_m, truth.position_m)
    assert session.notices == []


@OUTPUTS
@pytest.mark.parametrize(("kind", "rows"), [(TruthKind.STRIDES, np.array([[0.0, 0.0], [1.25, -0.5]])),
                                            (TruthKind.CLOSED_LOOP, np.empty((0, 3)))])  # fmt: skip
def test_a_truth_without_stamps_goes_along_in_text_and_is_told_to_be_lost_in_a_bag(tmp_path, name, kind, rows):
    session = in_memory(noise(COUNT), Truth(kind, np.empty(0, np.int64), rows))
    write_recording(session, list(session.sensors.values()), tmp_path / name)
    after = open_recording(tmp_path / name).sensors["imu"].truth
    if name.endswith(".csv"):
        assert after.kind is kind
        np.testing.assert_array_equal(after.position_m, rows)
        assert session.notices == []
    else:
        assert after is None
        assert [n.kind for n in session.notices] == ["truth_left_out"]


def test_two_sensors_go_into_a_bag_but_not_into_one_csv(tmp_path):
    write_bag(tmp_path / "walk", imu_messages(5, "/left/imu/data") + imu_messages(5, "/right/imu/data_raw"), "mcap")
    _, after = converted(tmp_path / "walk", tmp_path / "out")
    assert sorted(after.sensors) == ["left/imu", "right/imu"]
    with pytest.raises(RecordingError, match=r"one sensor; choose from .*left/imu"):
        converted(tmp_path / "walk", tmp_path / "out.csv")


def test_a_sensor_gets_a_name_that_ros_allows():
    assert [namespace(n) for n in ("left foot", "2nd/3", "left/imu")] == ["/left_foot", "/_2nd/_3", "/left/imu"]


def test_what_was_not_measured_is_still_not_measured():
    samples = noise(4)._replace(gyro_sd_radps=np.array([0.0, -1.0, 0.2, 0.0]))
    read = imu_block_from_cdr(cdr_from_imu_block(samples, "foot"))
    assert read.gyro_sd_radps.tolist() == [0.0, -1.0, 0.0, 0.0]
    np.testing.assert_array_equal(read.accel_mps2, samples.accel_mps2)


def test_what_is_written_is_what_ros_would_write():
    samples = noise(2)._replace(accel_sd_mps2=np.array([0.0, 0.5]))
    written = cdr_from_imu_block(samples, "a frame")
    assert len(written) == 2
    for i, cdr in enumerate(written):
        message = ROS2.deserialize_cdr(cdr, IMU)
        assert (message.header.frame_id, message.orientation_covariance[0]) == ("a frame", -1.0)
        assert message.linear_acceleration.y == samples.accel_mps2[i, 1]
        assert (
            message.linear_acceleration_covariance.tolist()
            == (np.eye(3) * samples.accel_sd_mps2[i] ** 2).ravel().tolist()
        )
        assert bytes(ROS2.serialize_cdr(message, IMU)) == cdr


def test_the_field_is_written_as_ros_would_write_it():
    samples = with_field(noise(3), np.array([True, True, False]), np.array([0.0, 2e-7, 0.0]))
    fields = FieldBlock(samples.stamp_ns, samples.field_tesla, samples.field_sd_tesla)
    written = cdr_from_field_block(fields, "a frame")
    assert len(written) == 3
    for i, cdr in enumerate(written):
        message = ROS2.deserialize_cdr(cdr, MAG)
        assert (message.header.frame_id, message.magnetic_field.z) == ("a frame", samples.field_tesla[i, 2])
        diagonal = message.magnetic_field_covariance[[0, 4, 8]].tolist()
        assert diagonal == [[0.0] * 3, [2e-7**2] * 3, [-1.0, 0.0, 0.0]][i]
        assert bytes(ROS2.serialize_cdr(message, MAG)) == cdr
        check_same(field_block_from_cdr([cdr]), [column[i : i + 1] for column in fields])


@OUTPUTS
def test_nothing_is_left_where_reading_fails(tmp_path, name):
    def read(_):
        yield noise(COUNT)
        raise ZeroDivisionError

    sensor = Sensor("imu", None, read)
    with pytest.raises(ZeroDivisionError):
        write_recording(Session("made", tmp_path / "made", "made", {"imu": sensor}), [sensor], tmp_path / name)
    assert list(tmp_path.iterdir()) == []


@OUTPUTS
def test_what_exists_is_replaced_only_if_that_is_wanted(tmp_path, name):
    (tmp_path / "from").mkdir()
    source = write_bag(tmp_path / "from" / "walk", imu_messages(COUNT), "mcap").parent
    converted(source, tmp_path / name)
    before = sorted(p.name for p in tmp_path.iterdir())
    with pytest.raises(RecordingError, match="exists already: choose another name, or replace it with --force"):
        converted(source, tmp_path / name)
    shorter = write_bag(tmp_path / "from" / "short", imu_messages(3), "mcap").parent
    _, after = converted(shorter, tmp_path / name, overwrite=True)
    assert len(block(after).stamp_ns) == 3
    assert sorted(p.name for p in tmp_path.iterdir()) == before


def test_a_folder_that_holds_more_than_a_bag_is_never_replaced(tmp_path):
    source = write_bag(tmp_path / "walk", imu_messages(3), "mcap").parent
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "thesis.odt").write_text("years of work")
    with pytest.raises(RecordingError, match="holds more than a bag"):
        converted(source, tmp_path / "out", overwrite=True)
    assert (tmp_path / "out" / "thesis.odt").exists()
    with pytest.raises(RecordingError, match="is the recording itself"):
        converted(source, source, overwrite=True)


def test_stamps_that_ros_cannot_say_are_refused(tmp_path):
    samples = noise(2)
    session = in_memory(samples._replace(stamp_ns=np.array([0, 2**32 * 10**9])))
    with pytest.raises(RecordingError, match=r"1901 to 2038 only; write a \.csv"):
        write_recording(session, list(session.sensors.values()), tmp_path / "out")


@pytest.mark.parametrize("name", ["walk.bag", "walk.db3", "walk.mat", "walk.txt"])
def test_formats_that_we_do_not_write_are_refused(tmp_path, name):
    session = in_memory(noise(2))
    with pytest.raises(RecordingError, match=r"choose a name ending in \.mcap or \.csv"):
        write_recording(session, list(session.sensors.values()), tmp_path / name)

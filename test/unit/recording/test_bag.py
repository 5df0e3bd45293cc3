import numpy as np
import pytest
from rosbags.rosbag2 import CompressionMode
from small_bags import IMU, POINT, POSE, imu_cdr, imu_messages, odometry_cdr, point_cdr, pose_cdr, stamp, write_bag

from pdr_core.recording import RecordingError, open_recording
from pdr_core.recording.bag import sensor_names
from pdr_core.records import TruthKind, joined

STORAGES = pytest.mark.parametrize("storage", ["mcap", "sqlite3"])


def samples(session, name="imu", max_samples=65536):
    return joined(list(session.sensors[name].pieces(max_samples)))


def check_samples(block, count):
    assert block.stamp_ns.dtype == np.int64
    assert block.stamp_ns.tolist() == [stamp(i) for i in range(count)]
    assert block.gyro_radps.tolist() == [[i, 2.0, 3.0] for i in range(count)]
    assert block.accel_mps2.tolist() == [[0.1, 0.2, i] for i in range(count)]
    assert not block.gyro_sd_radps.any()
    assert not block.accel_sd_mps2.any()


@STORAGES
def test_every_sample_is_read_at_its_header_stamp(tmp_path, storage):
    write_bag(tmp_path / "walk", imu_messages(100), storage)
    session = open_recording(tmp_path / "walk")
    assert (session.name, session.format, list(session.sensors)) == ("walk", storage, ["imu"])
    check_samples(samples(session), 100)
    assert session.notices == []
    assert session.sensors["imu"].truth is None


@STORAGES
def test_a_bag_without_metadata_and_a_bare_file_read_alike(tmp_path, storage):
    file = write_bag(tmp_path / "walk", imu_messages(10), storage)
    (tmp_path / "walk" / "metadata.yaml").unlink()
    check_samples(samples(open_recording(tmp_path / "walk")), 10)
    check_samples(samples(open_recording(file)), 10)


def test_damaged_metadata_does_not_matter(tmp_path):
    write_bag(tmp_path / "walk", imu_messages(10), "mcap")
    (tmp_path / "walk" / "metadata.yaml").write_bytes(b"rosbag2_bagfile_information: [\xff")
    check_samples(samples(open_recording(tmp_path / "walk")), 10)


def test_pieces_are_bounded_and_can_be_read_again(tmp_path):
    write_bag(tmp_path / "walk", imu_messages(25), "mcap")
    sensor = open_recording(tmp_path / "walk").sensors["imu"]
    assert [len(p.stamp_ns) for p in sensor.pieces(10)] == [10, 10, 5]
    check_samples(joined(list(sensor.pieces(10))), 25)


def test_a_split_bag_is_read_in_order_and_a_missing_part_is_told(tmp_path):
    messages = imu_messages(30)
    for part in (0, 2, 10):
        file = write_bag(tmp_path / f"p{part}", messages[part * 2 : part * 2 + 2], "mcap")
        (tmp_path / "walk").mkdir(exist_ok=True)
        file.rename(tmp_path / "walk" / f"walk_{part}.mcap")
    names = [f"walk_{part}.mcap" for part in (0, 2, 7, 10)]
    text = f"rosbag2_bagfile_information: {{relative_file_paths: {names}}}".replace("'", '"')
    (tmp_path / "walk" / "metadata.yaml").write_text(text)
    session = open_recording(tmp_path / "walk")
    assert samples(session).stamp_ns.tolist() == [stamp(i) for i in (0, 1, 4, 5, 20, 21)]
    assert [(n.kind, "walk_7.mcap" in n.text) for n in session.notices] == [("missing_file", True)]


def test_sensors_are_named_after_their_topics():
    assert sensor_names(["/imu/data_raw"]) == {"imu": "/imu/data_raw"}
    assert sensor_names(["/left/imu/data", "/right/imu/data_raw", "/right/imu/data"]) == {
        "left/imu": "/left/imu/data",
        "right/imu": "/right/imu/data_raw",
    }
    assert sensor_names(["/imu", "/imu/data"]) == {"imu": "/imu", "imu/data": "/imu/data"}
    assert sensor_names(["/data_raw"]) == {"data_raw": "/data_raw"}


def test_a_covariance_of_minus_one_says_that_the_gyro_was_not_measured(tmp_path):
    cdr = [imu_cdr(1), imu_cdr(2, gyro_covariance=-1.0)]
    write_bag(tmp_path / "walk", [("/imu/data", IMU, c) for c in cdr], "mcap")
    block = samples(open_recording(tmp_path / "walk"))
    assert block.gyro_sd_radps.tolist() == [0.0, -1.0]
    assert block.gyro_radps.tolist() == [[1.0, 2.0, 3.0], [0.0, 0.0, 0.0]]
    assert block.accel_sd_mps2.tolist() == [0.0, 0.0]


def test_messages_of_different_layout_mix_and_undecodable_ones_are_counted(tmp_path):
    cdr = [imu_cdr(0), imu_cdr(1, frame="other"), b"\x00\x01\x00\x00junk", imu_cdr(3, little_endian=False), b""]
    write_bag(tmp_path / "walk", [("/imu/data", IMU, c) for c in cdr], "mcap")
    session = open_recording(tmp_path / "walk")
    for _ in range(2):
        block = samples(session)
    assert block.stamp_ns.tolist() == [stamp(0), stamp(1), stamp(3)]
    assert block.accel_mps2[:, 2].tolist() == [0.0, 1.0, 3.0]
    assert [(n.kind, n.count) for n in session.notices] == [("unreadable_message", 2)]


@pytest.mark.parametrize(
    ("msgtype", "cdr", "expected"),
    [
        (POINT, point_cdr, [[0.0, 2.0, 3.0], [1.0, 2.0, 3.0]]),
        (POSE, pose_cdr, [[1.0, 0.0, 3.0], [1.0, 1.0, 3.0]]),
        ("nav_msgs/msg/Odometry", odometry_cdr, [[1.0, 2.0, 0.0], [1.0, 2.0, 1.0]]),
    ],
)
def test_a_ground_truth_topic_is_the_truth(tmp_path, msgtype, cdr, expected):
    truth = [("/ground_truth", msgtype, cdr(i)) for i in range(2)]
    write_bag(tmp_path / "walk", imu_messages(3) + truth, "mcap")
    found = open_recording(tmp_path / "walk").sensors["imu"].truth
    assert found.kind is TruthKind.POSITION
    assert found.stamp_ns.tolist() == [stamp(0), stamp(1)]
    assert found.position_m.tolist() == expected


def test_each_foot_gets_the_truth_of_its_namespace(tmp_path):
    messages = imu_messages(2, "/left/imu/data") + imu_messages(2, "/right/imu/data")
    messages += [("/left/ground_truth", POINT, point_cdr(5)), ("/right/ground_truth", POINT, point_cdr(7))]
    write_bag(tmp_path / "walk", messages, "sqlite3")
    sensors = open_recording(tmp_path / "walk").sensors
    assert sensors["left/imu"].truth.position_m[0, 0] == 5.0
    assert sensors["right/imu"].truth.position_m[0, 0] == 7.0


def test_the_closest_truth_is_taken(tmp_path):
    messages = imu_messages(2, "/left/imu/data") + imu_messages(2, "/right/imu/data")
    messages += [("/ground_truth", POINT, point_cdr(5)), ("/left/ground_truth", POINT, point_cdr(7))]
    write_bag(tmp_path / "walk", messages, "mcap")
    sensors = open_recording(tmp_path / "walk").sensors
    assert sensors["left/imu"].truth.position_m[0, 0] == 7.0
    assert sensors["right/imu"].truth.position_m[0, 0] == 5.0


def test_a_file_of_a_split_bag_may_lack_a_topic(tmp_path):
    (tmp_path / "walk").mkdir()
    parts = [imu_messages(3), imu_messages(2, "/other/data")]
    for i, messages in enumerate(parts):
        write_bag(tmp_path / f"p{i}", messages, "mcap").rename(tmp_path / "walk" / f"walk_{i}.mcap")
    check_samples(samples(open_recording(tmp_path / "walk")), 3)


@pytest.mark.parametrize("mode", [CompressionMode.FILE, CompressionMode.MESSAGE])
@STORAGES
def test_a_compressed_bag_is_read(tmp_path, storage, mode):
    write_bag(tmp_path / "walk", imu_messages(10), storage, mode)
    check_samples(samples(open_recording(tmp_path / "walk")), 10)


def test_messages_of_both_byte_orders_mix(tmp_path):
    cdr = [imu_cdr(0), imu_cdr(1, little_endian=False)]
    write_bag(tmp_path / "walk", [("/imu/data_raw", IMU, c) for c in cdr], "mcap")
    check_samples(samples(open_recording(tmp_path / "walk")), 2)


@STORAGES
def test_a_bag_without_an_imu_says_what_it_holds(tmp_path, storage):
    write_bag(tmp_path / "walk", [("/where", POINT, point_cdr(0))], storage)
    with pytest.raises(RecordingError, match=r"no sensor_msgs/Imu topic, only /where \(geometry_msgs/msg/Point"):
        open_recording(tmp_path / "walk")


def test_a_folder_that_is_no_bag_is_an_error(tmp_path):
    with pytest.raises(RecordingError, match=r"holds no .mcap or .db3 file: give a rosbag2 directory"):
        open_recording(tmp_path)

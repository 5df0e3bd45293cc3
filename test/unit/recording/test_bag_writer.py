import pytest
from rosbags.rosbag2 import Reader
from rosbags.typesys import get_types_from_msg
from small_bags import IMU, imu_cdr, stamp

from pdr_core.recording import RecordingError, open_recording
from pdr_core.recording.bag_writer import BagWriter

STEP = "pdr_msgs/msg/Step"
STEP_TEXT = "std_msgs/Header header\nuint32 index\nfloat64[9] covariance\nuint8 WALKING=3\n"


def written(path, count=5):
    with BagWriter(path, {STEP: STEP_TEXT}) as writer:
        for i in range(count):
            writer.write("/imu/data_raw", IMU, stamp(i), imu_cdr(i))
            writer.write("/steps", STEP, stamp(i), bytes(range(100)))
    return path


def test_what_is_written_is_read_back_byte_by_byte(tmp_path):
    with Reader(written(tmp_path / "out")) as reader:
        found = [(c.topic, t, bytes(cdr)) for c, t, cdr in reader.messages()]
    expected = [("/imu/data_raw", stamp(i), imu_cdr(i)) for i in range(5)]
    expected += [("/steps", stamp(i), bytes(range(100))) for i in range(5)]
    assert sorted(found) == sorted(expected)


def test_the_bag_is_mcap_and_carries_its_own_definitions(tmp_path):
    with Reader(written(tmp_path / "out")) as reader:
        steps = next(c for c in reader.connections if c.topic == "/steps")
    assert steps.msgtype == STEP
    embedded = get_types_from_msg(steps.msgdef.data, STEP)
    assert embedded[STEP] == get_types_from_msg(STEP_TEXT, STEP)[STEP]
    assert "std_msgs/msg/Header" in embedded
    assert [f.suffix for f in sorted((tmp_path / "out").iterdir())] == [".yaml", ".mcap"]


def test_it_knows_which_topics_have_a_message(tmp_path):
    with BagWriter(tmp_path / "out", {}) as writer:
        assert writer.topics == set()
        writer.write("/imu/data_raw", IMU, stamp(0), imu_cdr(0))
        assert writer.topics == {"/imu/data_raw"}


def test_an_imu_topic_opens_as_a_recording(tmp_path):
    block = next(open_recording(written(tmp_path / "out")).sensors["imu"].pieces())
    assert block.stamp_ns.tolist() == [stamp(i) for i in range(5)]


def test_nothing_is_overwritten(tmp_path):
    written(tmp_path / "out")
    with pytest.raises(RecordingError, match="exists already: remove it or choose another name"):
        BagWriter(tmp_path / "out", {})


def test_a_run_that_fails_leaves_what_can_still_be_read(tmp_path):
    def fail(writer):
        for i in range(5000):
            writer.write("/imu/data_raw", IMU, stamp(i), imu_cdr(i))
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError), BagWriter(tmp_path / "out", {}) as writer:
        fail(writer)
    session = open_recording(tmp_path / "out")
    assert sum(len(p.stamp_ns) for p in session.sensors["imu"].pieces()) > 2500
    assert [n.kind for n in session.notices] == ["damaged_recording"]

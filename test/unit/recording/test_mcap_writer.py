import pytest
from mcap.reader import make_reader
from rosbags.rosbag2 import Reader
from small_bags import IMU, imu_cdr, stamp

from pdr_core.recording import open_recording
from pdr_core.recording.mcap_salvage import mcap_attachments
from pdr_core.recording.mcap_writer import McapWriter

STEP = "pdr_msgs/msg/Step"
DEFINITIONS = {STEP: "std_msgs/Header header\nuint32 index\nfloat64[9] covariance\nuint8 WALKING=3\n"}
NOTE = b"gate: 30.0\n"


def put(writer, i):
    writer.write("/imu/data_raw", IMU, stamp(i), imu_cdr(i))
    writer.write("/steps", STEP, stamp(i), bytes(range(100)))


def written(path, count=50, every=10):
    """A finished file whose chunks hold `every` messages of each topic."""
    with McapWriter(path, DEFINITIONS) as writer:
        for i in range(count):
            put(writer, i)
            if i % every == every - 1:
                writer.flush()
            if i == count // 2:
                writer.attach("note.yaml", "text/yaml", stamp(i), NOTE)
    return path


def indices(path):
    """The samples that the door finds, each by its number."""
    session = open_recording(path)
    found = [int(g) for piece in session.sensors["imu"].pieces() for g in piece.gyro_radps[:, 0]]
    return found, [notice.kind for notice in session.notices]


def test_other_readers_find_every_message_as_it_was_written(tmp_path):
    path = written(tmp_path / "walk.mcap")
    with Reader(path) as reader:
        found = [(c.topic, t, bytes(cdr)) for c, t, cdr in reader.messages()]
    expected = [("/imu/data_raw", stamp(i), imu_cdr(i)) for i in range(50)]
    expected += [("/steps", stamp(i), bytes(range(100))) for i in range(50)]
    assert sorted(found) == sorted(expected)
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        late = [(channel.topic, m.log_time) for _, channel, m in reader.iter_messages("/steps", starting_at=stamp(40))]
        summary = reader.get_summary()
        assert [attached.data for attached in reader.iter_attachments()] == [NOTE]
    assert late == [("/steps", stamp(i)) for i in range(40, 50)]
    assert summary.statistics.message_count == 100
    assert summary.statistics.chunk_count == 6
    assert (summary.statistics.message_start_time, summary.statistics.message_end_time) == (stamp(0), stamp(49))
    assert {schema.name for schema in summary.schemas.values()} == {IMU, STEP}


def test_our_own_door_reads_it_without_a_complaint(tmp_path):
    assert indices(written(tmp_path / "walk.mcap")) == (list(range(50)), [])


def test_what_was_flushed_is_there_though_the_end_never_came(tmp_path):
    path = tmp_path / "walk.mcap"
    writer = McapWriter(path, DEFINITIONS).__enter__()
    writer.attach("note.yaml", "text/yaml", 0, b"first")
    writer.attach("note.yaml", "text/yaml", 1, NOTE)
    for i in range(37):
        put(writer, i)
        if i % 10 == 9:
            writer.flush()
    crashed = tmp_path / "crashed.mcap"
    crashed.write_bytes(path.read_bytes())  # as a SIGKILL leaves it
    assert indices(crashed) == (list(range(30)), ["damaged_recording"])
    assert mcap_attachments(crashed) == {"note.yaml": NOTE}
    assert writer.size_bytes == crashed.stat().st_size
    writer.__exit__(None, None, None)
    assert indices(path) == (list(range(37)), [])


def test_a_file_cut_anywhere_gives_every_chunk_before_the_cut(tmp_path):
    whole = written(tmp_path / "walk.mcap").read_bytes()
    with (tmp_path / "walk.mcap").open("rb") as file:
        chunks = make_reader(file).get_summary().chunk_indexes
    starts = [chunk.chunk_start_offset for chunk in chunks]
    ends = [chunk.chunk_start_offset + chunk.chunk_length for chunk in chunks]
    counts = [10, 20, 26, 30, 40, 50]  # the attachment in the middle closes a chunk too
    for end, count in zip(ends, counts, strict=True):
        for cut in (end, end + 3):
            (tmp_path / "cut.mcap").write_bytes(whole[:cut])
            assert indices(tmp_path / "cut.mcap")[0] == list(range(count))
    (tmp_path / "cut.mcap").write_bytes(whole[: (starts[3] + ends[3]) // 2])
    assert indices(tmp_path / "cut.mcap")[0][:26] == list(range(26))


def test_it_counts_and_knows_what_it_can_write(tmp_path):
    with McapWriter(tmp_path / "walk.mcap", DEFINITIONS) as writer:
        put(writer, 0)
        put(writer, 1)
        assert writer.counts == {"/imu/data_raw": 2, "/steps": 2}
        assert all(writer.knows(msgtype) for msgtype in (STEP, IMU, "tf2_msgs/msg/TFMessage"))
        assert not writer.knows("pdr_msgs/msg/Other")


def test_nothing_is_overwritten(tmp_path):
    path = written(tmp_path / "walk.mcap")
    with pytest.raises(FileExistsError):
        McapWriter(path, {})


def test_a_file_without_a_message_is_complete_too(tmp_path):
    with McapWriter(tmp_path / "walk.mcap", {}):
        pass
    with (tmp_path / "walk.mcap").open("rb") as file:
        assert make_reader(file).get_summary().statistics.message_count == 0

import io

import pytest
from mcap.writer import CompressionType, Writer
from small_bags import IMU, POINT, imu_cdr, imu_messages, point_cdr, stamp, write_bag

from pdr_core.recording import RecordingError, open_recording
from pdr_core.records import joined

COUNT = 400


def read(path):
    """Return the stamps of the samples that can be read, each checked, and the kinds of the notices; None: refused."""
    try:
        session = open_recording(path)
    except RecordingError:
        return None
    block = joined(list(session.sensors["imu"].pieces()))
    for t, gyro, accel in zip(block.stamp_ns, block.gyro_radps, block.accel_mps2, strict=True):
        i = gyro[0]
        assert (t, *gyro, *accel) == (stamp(int(i)), i, 2.0, 3.0, 0.1, 0.2, i)
    return block.stamp_ns.tolist(), [n.kind for n in session.notices]


def check_cuts(whole: bytes, path, cuts):
    """Cut the file at each position: a prefix of the walk and a notice, or a refusal. Return the counts."""
    counts = []
    for cut in cuts:
        path.write_bytes(whole[:cut])
        found = read(path)
        counts.append(len(found[0]) if found else 0)
        if found:
            stamps, kinds = found
            assert stamps == [stamp(i) for i in range(len(stamps))]
            assert kinds == ["damaged_recording"] or (kinds == [] and len(stamps) == COUNT)
    return counts


def mcap_bytes(compression: CompressionType, chunk_size: int, finish: bool = True, count: int = COUNT) -> bytes:
    file = io.BytesIO()
    writer = Writer(file, chunk_size=chunk_size, compression=compression)
    writer.start("ros2")
    schema = writer.register_schema("sensor_msgs/msg/Imu", "ros2msg", b"")
    channel = writer.register_channel("/imu/data", "cdr", schema)
    for i in range(count):
        writer.add_message(channel, stamp(i), imu_cdr(i), stamp(i))
    if finish:
        writer.finish()
    return file.getvalue()


@pytest.mark.parametrize("compression", list(CompressionType))
@pytest.mark.parametrize("chunk_size", [10_000, 1_000_000])
def test_a_cut_mcap_gives_what_is_before_the_cut(tmp_path, compression, chunk_size):
    whole = mcap_bytes(compression, chunk_size)
    cuts = [*range(0, len(whole), max(1, len(whole) // 60)), *range(len(whole) - 40, len(whole))]
    counts = check_cuts(whole, tmp_path / "cut.mcap", cuts)
    assert counts == sorted(counts)
    assert counts[-1] == COUNT
    if compression is CompressionType.NONE:
        assert counts[30] >= 0.45 * COUNT


@pytest.mark.parametrize("compression", list(CompressionType))
def test_a_chunk_cut_in_two_gives_its_first_half(tmp_path, compression):
    whole = mcap_bytes(compression, 10_000_000, count=4000)
    chunk = 8 + 9 + int.from_bytes(whole[9:17], "little")  # after magic and header
    cut = chunk + 9 + int.from_bytes(whole[chunk + 1 : chunk + 9], "little") // 2
    (tmp_path / "cut.mcap").write_bytes(whole[:cut])
    stamps, kinds = read(tmp_path / "cut.mcap")
    assert 1000 < len(stamps) < 3000
    assert kinds == ["damaged_recording"]


def test_other_topics_stay_apart_in_a_damaged_bag(tmp_path):
    messages = [m for i in range(200) for m in (("/where", POINT, point_cdr(i)), ("/imu/data", IMU, imu_cdr(i)))]
    for storage in ("mcap", "sqlite3"):
        file = write_bag(tmp_path / storage, messages, storage)
        file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
        stamps, kinds = read(file)
        assert stamps == [stamp(i) for i in range(len(stamps))]
        assert len(stamps) > 40
        assert kinds == ["damaged_recording"]


def test_the_page_that_an_sqlite_bag_breaks_off_in_is_not_trusted(tmp_path):
    for count in (20, 40):
        whole = write_bag(tmp_path / f"{count}", imu_messages(count), "sqlite3").read_bytes()
        for cut in range(len(whole) - 4200, len(whole), 83):
            (tmp_path / "cut.db3").write_bytes(whole[:cut])
            stamps, kinds = read(tmp_path / "cut.db3") or ([], [])
            assert stamps == [stamp(i) for i in range(len(stamps))]
            assert not stamps or kinds == ["damaged_recording"] or len(stamps) == count


def test_an_mcap_without_summary_is_read_whole(tmp_path):
    whole = mcap_bytes(CompressionType.NONE, 1000, finish=False)
    (tmp_path / "crashed.mcap").write_bytes(whole)
    stamps, kinds = read(tmp_path / "crashed.mcap")
    assert len(stamps) > COUNT - 10
    assert kinds == ["damaged_recording"]


def test_an_mcap_rotten_in_the_middle_gives_what_is_before(tmp_path):
    whole = bytearray(mcap_bytes(CompressionType.ZSTD, 10_000))
    chunk = whole.index(b"\x28\xb5\x2f\xfd", len(whole) // 2)
    whole[chunk + 30 : chunk + 60] = bytes(30)
    (tmp_path / "rotten.mcap").write_bytes(whole)
    stamps, kinds = read(tmp_path / "rotten.mcap")
    assert 0 < len(stamps) < COUNT
    assert kinds == ["damaged_recording"]


def test_a_cut_sqlite_bag_gives_what_is_before_the_cut(tmp_path):
    whole = write_bag(tmp_path / "walk", imu_messages(COUNT), "sqlite3").read_bytes()
    cuts = [*range(0, len(whole), 1777), *range(len(whole) - 10, len(whole))]
    counts = check_cuts(whole, tmp_path / "cut.db3", cuts)
    assert max(counts[: len(counts) // 2]) > 0.3 * COUNT
    assert counts[-1] > 0.9 * COUNT


def test_a_cut_part_of_a_directory_costs_only_its_own_end(tmp_path):
    first = write_bag(tmp_path / "a", imu_messages(COUNT), "mcap").read_bytes()
    second = write_bag(tmp_path / "b", imu_messages(COUNT)[:50], "mcap").read_bytes()
    (tmp_path / "walk").mkdir()
    (tmp_path / "walk" / "walk_0.mcap").write_bytes(first[: len(first) // 2])
    (tmp_path / "walk" / "walk_1.mcap").write_bytes(second)
    stamps, kinds = read(tmp_path / "walk")
    assert stamps[-50:] == [stamp(i) for i in range(50)]
    assert len(stamps) > 50 + COUNT // 4
    assert kinds == ["damaged_recording"]


@pytest.mark.parametrize("suffix", [".mcap", ".db3", ".mat", ".csv"])
def test_garbage_is_refused(tmp_path, suffix):
    path = tmp_path / f"garbage{suffix}"
    path.write_bytes(bytes(range(256)) * 40)
    assert read(path) is None

"""The field of a bag's magnetometer topics finds its samples."""

from pathlib import Path

import pytest
from small_bags import IMU, MAG, imu_cdr, imu_messages, mag_cdr, stamp, write_bag

from pdr_core.recording import open_recording
from pdr_core.recording.bag import field_topics
from pdr_core.recording.bag_messages import AT_ONCE, BagReader
from pdr_core.recording.storage import Storage
from pdr_core.records import joined

COUNT = 600


def mag_messages(indices, topic="/imu/mag", **kind):
    return [(topic, MAG, mag_cdr(i, **kind)) for i in indices]


def in_order(*streams):
    """Merge messages as they would be recorded: by the place that they tell, those of the first stream first."""
    placed = [(place, k, message) for k, stream in enumerate(streams) for place, message in stream]
    return [message for _, _, message in sorted(placed, key=lambda p: p[:2])]


def read(path, size=65536, name="imu"):
    """Return by sample the index of its field, None where it has none, and the session."""
    session = open_recording(path)
    block = joined(list(session.sensors[name].pieces(size)))
    there = zip(block.field_tesla[:, 0], block.field_sd_tesla, strict=True)
    return [float(i) if sd >= 0.0 else None for i, sd in there], session


def test_the_topics_are_called_as_rep_145_has_it():
    assert field_topics(["/imu/data_raw"], ["/imu/mag", "/other/mag"]) == {"/imu/data_raw": "/imu/mag"}
    assert field_topics(["/left/data", "/right/data_raw"], ["/left/mag", "/right/mag"]) == {
        "/left/data": "/left/mag",
        "/right/data_raw": "/right/mag",
    }
    assert field_topics(["/imu"], ["/imu/mag", "/b"]) == {"/imu": "/imu/mag"}
    assert field_topics(["/imu/data"], ["/compass"]) == {"/imu/data": "/compass"}, "the only one for the only one"
    assert field_topics(["/imu/data"], ["/compass", "/drone/mag"]) == {}
    assert field_topics(["/left/data", "/right/data"], ["/mag"]) == {}


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("topic", ["/imu/mag", "/compass"])
@pytest.mark.parametrize("size", [1, 7, 100, 65536])
def test_every_sample_gets_the_field_of_its_stamp(tmp_path, storage, topic, size):
    messages = [m for pair in zip(imu_messages(COUNT), mag_messages(range(COUNT), topic), strict=True) for m in pair]
    write_bag(tmp_path / "walk", messages, storage)
    fields, session = read(tmp_path / "walk", size)
    assert fields == list(range(COUNT))
    assert all(0 < len(p.stamp_ns) <= size for p in session.sensors["imu"].pieces(size))
    assert session.notices == []


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("late", [0.0, 100.0, -100.0])
def test_a_slow_magnetometer_between_the_stamps_recorded_earlier_or_later(tmp_path, storage, late):
    """100 samples are half a second."""
    at = [3.3 + 8 * k for k in range(COUNT // 8)]
    mags = [(i + late, message) for i, message in zip(at, mag_messages(at), strict=True)]
    write_bag(tmp_path / "walk", in_order(list(enumerate(imu_messages(COUNT))), mags), storage)
    fields, session = read(tmp_path / "walk", size=1)
    assert fields == [i + 0.3 if i % 8 == 3 else None for i in range(COUNT)]
    assert session.notices == []


def test_two_feet_do_not_mix(tmp_path):
    messages = imu_messages(9, "/left/data_raw") + imu_messages(9, "/right/data_raw")
    messages += mag_messages(range(0, 9, 2), "/right/mag") + mag_messages(range(1, 9, 2), "/left/mag")
    write_bag(tmp_path / "walk", messages, "mcap")
    assert read(tmp_path / "walk", name="left")[0] == [None, 1, None, 3, None, 5, None, 7, None]
    assert read(tmp_path / "walk", name="right")[0] == [0, None, 2, None, 4, None, 6, None, 8]


def test_what_was_not_measured_is_none_and_its_noise_is_told(tmp_path):
    mags = [("/imu/mag", MAG, mag_cdr(i, variance)) for i, variance in enumerate((0.0, -1.0, 4e-14, float("nan")))]
    mags.append(("/imu/mag", MAG, mag_cdr(4)[:28] + b"\xff" * 8 + mag_cdr(4)[36:]))
    write_bag(tmp_path / "walk", imu_messages(5) + mags, "mcap")
    block = joined(list(open_recording(tmp_path / "walk").sensors["imu"].pieces()))
    assert block.field_sd_tesla.tolist() == [0.0, -1.0, 2e-7, 0.0, -1.0]
    assert block.field_tesla.tolist() == [[0, 2e-5, -4e-5], [0, 0, 0], [2, 2e-5, -4e-5], [3, 2e-5, -4e-5], [0, 0, 0]]


def test_fields_that_cannot_be_decoded_are_counted_and_the_samples_stay(tmp_path):
    cdr = [mag_cdr(0), mag_cdr(1, frame="other"), b"junk", mag_cdr(3, little_endian=False), b""]
    messages = [m for i, c in enumerate(cdr) for m in (("/imu/data", IMU, imu_cdr(i)), ("/imu/mag", MAG, c))]
    write_bag(tmp_path / "walk", messages, "mcap")
    fields, session = read(tmp_path / "walk")
    assert fields == [0, 1, None, 3, None]
    (notice,) = session.notices
    assert (notice.kind, notice.count, notice.text[:9]) == ("unreadable_message", 2, "/imu/mag:")


def test_a_magnetometer_by_another_clock_is_told_once(tmp_path):
    mags = mag_messages(range(10**6, 10**6 + COUNT))
    messages = [m for pair in zip(imu_messages(COUNT), mags, strict=True) for m in pair]
    write_bag(tmp_path / "walk", messages, "mcap")
    for _ in range(2):
        fields, session = read(tmp_path / "walk")
    assert set(fields) == {None}
    assert [(n.kind, n.count) for n in session.notices] == [("field_silent", 1)]
    assert session.notices[0].text.startswith("/imu/mag: ")


def test_a_split_bag_pairs_across_its_files(tmp_path):
    messages = [m for pair in zip(imu_messages(30), mag_messages(range(30)), strict=True) for m in pair]
    (tmp_path / "walk").mkdir()
    for n, (start, stop) in enumerate([(0, 21), (21, 22), (22, 60)]):  # a sample and its field are in two files
        file = write_bag(tmp_path / f"p{n}", messages[start:stop], "mcap")
        file.rename(tmp_path / "walk" / f"walk_{n}.mcap")
    fields, session = read(tmp_path / "walk")
    assert fields == list(range(30))
    assert session.notices == []


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_bag_cut_off_gives_samples_and_fields_up_to_there(tmp_path, storage):
    messages = [m for pair in zip(imu_messages(COUNT), mag_messages(range(COUNT)), strict=True) for m in pair]
    file = write_bag(tmp_path / "walk", messages, storage)
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    fields, session = read(file)
    block = joined(list(session.sensors["imu"].pieces()))
    assert block.stamp_ns.tolist() == [stamp(i) for i in range(len(fields))]
    assert COUNT // 5 < len(fields) < COUNT
    assert fields[:-1] == list(range(len(fields) - 1))
    assert [n.kind for n in session.notices] == ["damaged_recording"]


def test_reading_is_never_far_ahead_of_what_is_given_out():
    read_on, given = 0, 0

    def messages(_):
        nonlocal read_on
        for i in range(5000):
            read_on += 1
            yield ("/imu/data", imu_cdr(i)) if i % 2 else ("/imu/mag", mag_cdr(i))

    bag = BagReader([Storage(Path("walk.mcap"), {}, messages)], [])
    for piece in bag.paired_blocks("/imu/data", "/imu/mag", 100):
        given += len(piece.stamp_ns)
        assert read_on / 2 - given < 2 * AT_ONCE, "a second, and what is read at once"
    assert given == 2500

"""What a recording holds beside its inertial samples goes along: field, truth, order, names."""

import numpy as np
import pytest
from export_cases import COUNT, OUTPUTS, block, check_same, converted, in_memory, noise, with_field
from small_bags import START_NS, imu_messages, write_bag

from pdr_core.recording import RecordingError, Sensor, open_recording
from pdr_core.recording.bag_export import namespace, recording_times_ns
from pdr_core.recording.export import write_recording
from pdr_core.records import Truth, TruthKind, joined, part

ROW = np.arange(COUNT)


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

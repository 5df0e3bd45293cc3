import numpy as np
import pytest
from small_bags import POINT, imu_messages, point_cdr, stamp, write_bag

from pdr_core.recording import RecordingError
from pdr_core.recording.positions import open_positions
from pdr_core.records import TruthKind

POINTS = [[0.5, 2.0, 3.0], [1.25, 2.0, 3.0]]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("track.tum", "# t x y z q\n1.000000001 0.5 2 3 0 0 0 1\n2 1.25 2 3 0 0 0 1\n"),
        ("track.csv", "t_s,x_m,y_m,z_m\n1.000000001,0.5,2,3\n2,1.25,2,3\n"),
        ("track.csv", "step,z_m,y_m,x_m,t_ns\n1,3,2,0.5,1000000001\n2,3,2,1.25,2000000000\n"),
        ("track.csv", "t_ns,x_m,y_m,z_m\n7,nan,nan,nan\n1000000001,0.5,2,3\n2000000000,1.25,2,3\n"),
    ],
)
def test_files_of_positions(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    found = open_positions(tmp_path / name)
    assert found.kind is TruthKind.POSITION
    assert found.stamp_ns.tolist() == [1_000_000_001, 2_000_000_000]
    np.testing.assert_array_equal(found.position_m, POINTS)


def test_the_truth_of_a_recording(tmp_path):
    truth = [("/imu/ground_truth", POINT, point_cdr(i)) for i in range(4)]
    found = open_positions(write_bag(tmp_path / "walk", imu_messages(5) + truth, "mcap"))
    assert found.stamp_ns.tolist() == [stamp(i) for i in range(4)]


def test_a_recording_without_positions_says_what_to_give(tmp_path):
    file = write_bag(tmp_path / "walk", imu_messages(5), "mcap")
    with pytest.raises(RecordingError, match=r"holds no positions with stamps: give a \.tum file"):
        open_positions(file)


def test_of_several_sensors_one_must_be_named(tmp_path):
    messages = imu_messages(2, "/left/imu/data") + imu_messages(2, "/right/imu/data")
    messages += [("/left/ground_truth", POINT, point_cdr(5)), ("/right/ground_truth", POINT, point_cdr(7))]
    file = write_bag(tmp_path / "walk", messages, "mcap")
    assert open_positions(file, sensor="right/imu").position_m.tolist() == [[7.0, 2.0, 3.0]]
    with pytest.raises(RecordingError, match="choose one by --sensor"):
        open_positions(file)
    with pytest.raises(RecordingError, match="no positions of 'middle'"):
        open_positions(file, sensor="middle")

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pdr_core.recording import RecordingError
from pdr_core.recording.stamps import stamp_ns_from_text, text_from_stamp_ns
from pdr_core.recording.tum import Trajectory, append_tum, in_frame, read_tum, write_tum_header
from pdr_core.records_external import ExternalFrame

STAMPS = st.integers(-(2**63) + 1, 2**63 - 1)


@given(STAMPS)
def test_a_stamp_survives_the_way_through_text(stamp_ns):
    assert stamp_ns_from_text(text_from_stamp_ns(stamp_ns)) == stamp_ns


@pytest.mark.parametrize("text", ["", "soon", "nan", "inf", "1e30", "1,5"])
def test_text_that_is_no_time_is_an_error(text):
    with pytest.raises(ValueError, match="time"):
        stamp_ns_from_text(text)


@given(arrays(np.float64, (3, 7), elements=st.floats(-1e4, 1e4)), st.lists(STAMPS, min_size=3, max_size=3))
def test_what_is_written_in_pieces_is_read_back(tmp_path_factory, poses, stamps):
    path = tmp_path_factory.mktemp("tum") / "track.tum"
    whole = Trajectory(np.array(stamps, np.int64), poses[:, :3], poses[:, 3:])
    with path.open("w") as file:
        write_tum_header(file)
        append_tum(file, Trajectory(*(c[:2] for c in whole)))
        append_tum(file, Trajectory(*(c[2:] for c in whole)))
    read = read_tum(path)
    assert read.stamp_ns.tolist() == stamps
    np.testing.assert_allclose(read.position_m, whole.position_m, rtol=0, atol=1e-9)
    np.testing.assert_allclose(read.quat_xyzw, whole.quat_xyzw, rtol=0, atol=1e-9)


def test_the_file_is_what_other_tools_read(tmp_path):
    path = tmp_path / "track.tum"
    with path.open("w") as file:
        write_tum_header(file)
        append_tum(file, Trajectory(np.array([1_700_000_000_000_000_001]), np.ones((1, 3)), np.array([[0, 0, 0, 1.0]])))
    lines = path.read_text().splitlines()
    assert lines[0].startswith("# ")
    assert lines[1].split()[0] == "1700000000.000000001"
    assert np.loadtxt(path).shape == (8,)


def test_an_empty_trajectory_has_no_poses(tmp_path):
    (tmp_path / "track.tum").write_text("# nothing\n")
    read = read_tum(tmp_path / "track.tum")
    assert (len(read.stamp_ns), read.position_m.shape, read.quat_xyzw.shape) == (0, (0, 3), (0, 4))


@pytest.mark.parametrize("text", ["1 2 3\n", "1 2 3 4 5 6 7 x\n", "soon 2 3 4 5 6 7 8\n"])
def test_a_file_that_is_no_trajectory_is_an_error(tmp_path, text):
    (tmp_path / "track.tum").write_text(text)
    with pytest.raises(RecordingError, match="not a TUM trajectory"):
        read_tum(tmp_path / "track.tum")


def test_a_missing_file_is_an_error(tmp_path):
    with pytest.raises(RecordingError, match=r"none\.tum does not exist: check the path"):
        read_tum(tmp_path / "none.tum")


def test_a_trajectory_in_another_frame_is_turned_and_shifted():
    ours = Trajectory(
        np.array([1, 2]), np.array([[1.0, 0.0, 0.5], [0.0, 2.0, 0.5]]), np.array([[0.0, 0.0, 0.0, 1.0]] * 2)
    )
    frame = ExternalFrame(np.pi / 2.0, np.array([10.0, 20.0, 1.0]), 0, np.zeros((4, 4)), np.zeros(2))
    theirs = in_frame(ours, frame)
    np.testing.assert_allclose(theirs.position_m, [[10.0, 21.0, 1.5], [8.0, 20.0, 1.5]])
    np.testing.assert_allclose(theirs.quat_xyzw, [[0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)]] * 2)
    assert len(in_frame(Trajectory(np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros((0, 4))), frame).quat_xyzw) == 0

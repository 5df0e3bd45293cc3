"""An export that fails leaves nothing, destroys nothing, and says what mends it."""

import numpy as np
import pytest
from export_cases import COUNT, OUTPUTS, block, converted, in_memory, noise
from small_bags import imu_messages, write_bag

from pdr_core.recording import RecordingError, Sensor, Session
from pdr_core.recording.export import write_recording


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

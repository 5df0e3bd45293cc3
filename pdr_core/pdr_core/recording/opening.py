"""The one door to recordings."""

from pathlib import Path

from pdr_core.recording.bag import open_bag_session
from pdr_core.recording.session import RecordingError, Session
from pdr_core.recording.table_session import open_table_session

BAGS = {".mcap", ".db3", ".bag"}
TABLES = {".mat", ".csv", ".tsv", ".txt"}


def open_recording(path: Path | str, column_map: Path | None = None) -> Session:
    """Open a recording of any known format; RecordingError says in one sentence what to do where that fails.

    `path` is a rosbag2 directory, a bare .mcap or .db3 file, a ROS 1 .bag, or a text or .mat file. `column_map` is a
    YAML file that names the columns of a text or .mat file; without it `<recording>.yaml` or `pdr_columns.yaml` beside
    the recording is used, and without those the formats that pdr knows.
    """
    session = _opened(Path(path), column_map)
    if all(next(sensor.pieces(1), None) is None for sensor in session.sensors.values()):
        why = "; ".join(notice.text.rstrip(".") for notice in session.notices)
        advice = why or "record it again, or copy it again from where it came"
        raise RecordingError(f"{path} holds no readable sample: {advice}.")
    return session


def _opened(path: Path, column_map: Path | None) -> Session:
    if not path.exists():
        raise RecordingError(f"{path} does not exist: check the path.")
    if column_map and not column_map.exists():  # asked of bags too, which need none
        raise RecordingError(f"column map {column_map} cannot be read: it does not exist.")
    if path.is_file() and path.stat().st_size == 0:
        raise RecordingError(f"{path} is empty: record it again, or copy it again from where it came.")
    suffix = path.suffix.lower()
    if path.is_dir() or suffix in BAGS:
        return open_bag_session(path)
    if suffix in TABLES:
        return open_table_session(path, column_map)
    known = ", ".join(sorted(BAGS | TABLES))
    raise RecordingError(f"{path} is of an unknown format: give a rosbag2 directory or a file that ends in {known}.")

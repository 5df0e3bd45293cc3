"""Text as loggers and spreadsheets of other countries write it, and what is said where it cannot be read."""

import numpy as np
import pytest

from pdr_core.recording import RecordingError, open_recording
from pdr_core.records import joined, length
from support.walks import COLUMN_MAP, straight_walk, write_csv


@pytest.fixture
def walk(tmp_path):
    """A file with points and commas, its map beside it, and its samples."""
    path = write_csv(tmp_path / "walk.csv", straight_walk(2).imu)
    return path, joined(list(open_recording(path).sensors["imu"].pieces()))


@pytest.mark.parametrize("delimiter", [";", "\t"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "utf-8-sig"])
def test_decimal_commas_and_the_encodings_of_spreadsheets(walk, delimiter, encoding):
    path, samples = walk
    text = path.read_text().replace(",", delimiter).replace(".", ",")
    path.write_text(text, encoding=encoding)
    read = joined(list(open_recording(path).sensors["imu"].pieces()))
    for one, other in zip(read, samples, strict=True):
        np.testing.assert_array_equal(one, other)
    assert length(read) > 100


def refused(path):
    with pytest.raises(RecordingError) as caught:
        open_recording(path)
    return str(caught.value)


def test_times_that_are_dates_are_named(walk):
    path, _ = walk
    head, *rows = path.read_text().splitlines()
    path.write_text("\n".join([head, *(f"2026-01-01T10:00:00,{row.split(',', 1)[1]}" for row in rows)]))
    assert "holds no readable sample: walk.csv: rows whose time is no number were left out." in refused(path)


def test_lines_before_the_names_are_named(walk):
    path, _ = walk
    path.write_text("# logger 1\n" + path.read_text())
    assert "no columns match 't' of '# logger 1'; these are all columns of its first line" in refused(path)


def test_a_name_that_is_wrong_is_one_of_the_map(walk):
    path, _ = walk
    path.with_suffix(".yaml").write_text(COLUMN_MAP.replace("az", "a_z"))
    assert refused(path).endswith("'az'; correct the map.")

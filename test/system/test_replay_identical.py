"""A recording played through the processes twice, at any pace, gives the same trajectory to the last bit."""

import os

import pytest

from support.processes import pdr
from support.walks import straight_walk, write_csv

full = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")
pytestmark = pytest.mark.usefixtures("ros_environment")


def trajectories(folder, rate_hz, strides, paces):
    """The trajectory files of one walk, one for each pace."""
    recording = write_csv(folder / "walk.csv", straight_walk(strides, rate_hz=rate_hz).imu)
    texts = []
    for run, pace in enumerate(paces):
        out = folder / f"run{run}"
        answer = pdr("replay", recording, "--rate", pace, "--out", out)
        assert answer.returncode == 0, answer.stderr
        texts.append((out / "trajectory.tum").read_bytes())
    return texts


def check_identical(texts, estimates):
    assert texts[0].count(b"\n") >= estimates
    assert [run for run, text in enumerate(texts) if text != texts[0]] == []


def test_the_pace_changes_no_bit(tmp_path):
    check_identical(trajectories(tmp_path, 200.0, 3, (5, 0)), 2000)


@full
@pytest.mark.parametrize("rate_hz", [200.0, 1000.0])
def test_twice_at_every_pace_changes_no_bit(rate_hz, tmp_path):
    check_identical(trajectories(tmp_path, rate_hz, 3, 2 * (0.5, 1, 5, 0)), 2000)

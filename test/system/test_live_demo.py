import json
import re

import pytest

from pdr_core.recording import open_recording
from pdr_core.records import TruthKind, joined
from support.processes import pdr

ATE_BOUND_M = 0.1  # measured: 0.01
STRIDES = 10  # six forward, four turns on the spot
FILES = ("recording", "trajectory.tum", "strides.csv", "result.json", "report.html")
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def demo(tmp_path_factory):
    """A short demonstration: what it said and where its files are."""
    out = tmp_path_factory.mktemp("demo") / "out"
    return pdr("demo", "--length", 6, "--out", out), out


@pytest.fixture(scope="module")
def result(demo):
    return json.loads((demo[1] / "result.json").read_text())


def test_it_ends_well_and_leaves_its_files(demo):
    answer, out = demo
    assert answer.returncode == 0, answer.stderr
    assert "Traceback" not in answer.stderr
    assert [name for name in FILES if not (out / name).exists()] == []


def test_it_says_how_far_off_it_was(demo):
    said = demo[0].stdout
    assert re.search(r"Walked 7\.\d+ m in 10 strides within \d+ s\.", said)
    assert re.search(r"It was on average 0\.\d\d m off the true path, and 0\.\d\d m \(\d+\.\d %", said)
    assert str(demo[1] / "report.html") in said


def test_the_estimate_is_near_the_truth(result):
    assert result["truth"]["kind"] == "position"
    assert 0.0 < result["truth"]["ate2_m"] < ATE_BOUND_M
    assert result["strides"] == STRIDES
    assert result["distance_m"] == pytest.approx(7.2, rel=0.03)
    assert [n for n in result["notices"] if n["level"] == "ERROR"] == []


def test_the_recording_holds_every_sample_and_the_truth(demo, result):
    session = open_recording(demo[1] / "recording")
    (sensor,) = session.sensors.values()
    samples = joined(list(sensor.pieces()))
    assert len(samples.stamp_ns) == result["samples"] == len(sensor.truth.stamp_ns)
    assert sensor.truth.kind is TruthKind.POSITION
    assert session.notices == []


def test_a_second_demonstration_does_not_overwrite_the_first(demo):
    answer = pdr("demo", "--length", 6, "--out", demo[1])
    assert answer.returncode == 2
    assert answer.stderr.startswith("pdr: ")
    assert "exists already" in answer.stderr
    assert answer.stderr.count("\n") == 1


def test_with_a_magnetometer_every_sample_has_its_field(tmp_path):
    answer = pdr("demo", "--magnetometer", "--length", 1.2, "--rate", 8, "--out", tmp_path / "out")
    assert answer.returncode == 0, answer.stderr
    (sensor,) = open_recording(tmp_path / "out" / "recording").sensors.values()
    assert (joined(list(sensor.pieces())).field_sd_tesla >= 0.0).all()

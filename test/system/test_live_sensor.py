"""`pdr live` on somebody else's driver, in a process that shares nothing with us but the ROS graph."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from pdr_bringup_scripts.live.live_recording import messages
from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.recording import open_recording
from pdr_core.recording.tum import read_tum
from pdr_core.records import joined, length
from pdr_nodes.convert import stance_block
from support.live_command import live_until_done, patience
from support.processes import END_S, check_refused, pdr
from support.walks import straight_walk, write_csv

STRIDES, SPEED = 4, 2
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def walk(tmp_path_factory):
    return write_csv(tmp_path_factory.mktemp("walk") / "walk.csv", straight_walk(STRIDES).imu)


@pytest.fixture(scope="module", params=["RELIABLE", "BEST_EFFORT"])
def run(request, walk, tmp_path_factory):
    """A live run that Ctrl-C ends: its folder, its exit code and what it said."""
    folder = tmp_path_factory.mktemp("live")
    driver = (walk, "/your/imu", request.param, SPEED, "mag")
    topics = "--imu", "your/imu", "--mag", "/your/imu_mag"
    return folder / "out", *live_until_done(folder, [driver], *topics, *patience(folder))


def test_ctrl_c_ends_it_well(run):
    out, code, said, complained = run
    assert (code, "Traceback" in complained) == (0, False), complained
    assert said.startswith("Walked ")
    assert str(out / "report.html") in said
    assert (out / "report.html").stat().st_size > 1000


def test_what_is_estimated_is_what_was_recorded(run):
    out = run[0]
    answer = pdr("run", out / "recording", "--out", out / "again")
    assert answer.returncode == 0, answer.stderr
    live, again = (read_tum(folder / "trajectory.tum") for folder in (out, out / "again"))
    np.testing.assert_array_equal(live.stamp_ns, again.stamp_ns)
    np.testing.assert_array_equal(live.position_m, again.position_m)
    results = [json.loads((folder / "result.json").read_text()) for folder in (out, out / "again")]
    assert results[0]["strides"] == results[1]["strides"]
    assert results[0]["samples"] == results[1]["samples"]
    kinds = [{n["kind"]: n["count"] for n in result["notices"] if n["level"] != "OK"} for result in results]
    assert kinds[0] == kinds[1]


def test_the_samples_come_through_as_they_were(run, walk):
    (live,) = open_recording(run[0] / "recording").sensors.values()
    (source,) = open_recording(walk).sensors.values()
    heard, sent = joined(list(live.pieces())), joined(list(source.pieces()))
    rows = np.searchsorted(sent.stamp_ns, heard.stamp_ns)
    np.testing.assert_array_equal(heard.gyro_radps, sent.gyro_radps[rows])
    np.testing.assert_array_equal(heard.accel_mps2, sent.accel_mps2[rows])
    assert len(rows) > 0.8 * len(sent.stamp_ns)  # what is lost, is lost before it reaches us


def test_the_magnetometer_is_recorded(run):
    heard = list(messages(run[0] / "recording", "imu/mag"))
    assert len(heard) > 0.8 * 100 * 10
    assert heard[0].header.frame_id == "somebodys_imu"


def test_each_sample_had_the_field_that_is_recorded_with_it(run):
    (sensor,) = open_recording(run[0] / "recording").sensors.values()
    alone = FootInertial(Params())
    recorded = joined([*(alone.run(piece).judged for piece in sensor.pieces()), alone.finish().judged]).imu
    live = joined([stance_block(m) for m in messages(run[0] / "recording", "stance")]).imu
    np.testing.assert_array_equal(live.stamp_ns, recorded.stamp_ns)
    np.testing.assert_array_equal(live.field_tesla, recorded.field_tesla)
    assert np.mean(live.field_sd_tesla >= 0.0) > 0.9


def test_a_magnetometer_that_says_nothing_is_told(tmp_path):
    params = tmp_path / "mine.yaml"
    walk = "{walk: straight, walk_length_m: 2.4, sample_rate_hz: 100.0}"
    params.write_text(f"/**: {{ros__parameters: {{driver: {{rate_factor: 4.0}}, simulation: {walk}}}}}\n")
    command = [sys.executable, "-m", "pdr_nodes.imu_driver_node", "--ros-args", "--params-file", str(params)]
    driver = subprocess.Popen(command)
    try:
        answer = pdr("live", "--mag", "/imu/mag", "--duration", 8, "--out", tmp_path / "out")
    finally:
        driver.kill()
        driver.wait(END_S)
    assert answer.returncode == 0, answer.stderr
    assert "no messages on /imu/mag: this walk is estimated without the magnetic field" in answer.stderr
    (sensor,) = open_recording(tmp_path / "out" / "recording").sensors.values()
    verdicts = list(messages(tmp_path / "out" / "recording", "stance"))
    assert len(verdicts) == length(joined(list(sensor.pieces()))) > 500


def test_ctrl_c_before_the_nodes_are_there_loses_nothing(walk, tmp_path):
    driver = (walk, "/quick/imu", "RELIABLE", 50)
    code, _, complained = live_until_done(tmp_path, [driver], "--imu", "/quick/imu")
    assert code == 0, complained
    (sensor,) = open_recording(tmp_path / "out" / "recording").sensors.values()
    verdicts = list(messages(tmp_path / "out" / "recording", "stance"))
    assert len(verdicts) == length(joined(list(sensor.pieces()))) > 100


def test_nothing_to_hear_is_one_sentence(tmp_path):
    answer = pdr("live", "--imu", "/nowhere", "--duration", 0.5, "--out", tmp_path / "out")
    assert (answer.returncode, answer.stdout) == (2, "")
    assert answer.stderr.startswith("pdr: no messages on /nowhere yet: nobody publishes ")
    assert answer.stderr.count("\n") == 1
    assert not (tmp_path / "out" / "recording").exists()


def test_the_failure_of_our_driver_is_told(tmp_path):
    params = tmp_path / "mine.yaml"
    params.write_text("/**: {ros__parameters: {driver: {recording: nothere.csv}}}\n")
    answer = pdr("live", "--driver", "replayed", "--params", params, "--out", tmp_path / "out")
    assert (answer.returncode, answer.stdout) == (2, "")
    assert "imu_driver has failed: nothere.csv does not exist" in answer.stderr
    assert not (tmp_path / "out" / "recording").exists()


def test_a_magnetometer_without_its_topic_is_refused(tmp_path):
    params = tmp_path / "mine.yaml"
    params.write_text("/**: {ros__parameters: {node: {magnetometer: true}}}\n")
    answer = pdr("live", "--params", params, "--out", tmp_path / "out")
    check_refused(answer, "node.magnetometer is true: say by --mag on which topic")
    feet = ("--left", "/l", "--right", "/r", "--left-mag", "/m")
    check_refused(
        pdr("live", *feet, "--params", params, "--out", tmp_path / "out"), "say by --right-mag on which topic"
    )


@pytest.mark.parametrize("mag", [(), ("--mag", "/imu/mag")])
def test_a_driver_of_ours_is_started_and_ends_the_run(mag, tmp_path):
    params = tmp_path / "mine.yaml"
    walk = "{walk: straight, walk_length_m: 2.4, sample_rate_hz: 100.0}"
    params.write_text(f"/**: {{ros__parameters: {{driver: {{rate_factor: 4.0}}, simulation: {walk}}}}}\n")
    answer = pdr("live", "--driver", "simulated", *mag, "--params", params, "--out", tmp_path / "out")
    assert answer.returncode == 0, answer.stderr
    verdicts = [stance_block(m) for m in messages(tmp_path / "out" / "recording", "stance")]
    assert {bool(block.imu.field_sd_tesla[0] >= 0.0) for block in verdicts} == {bool(mag)}
    assert "in 2 strides" in answer.stdout
    assert "off the true path" in answer.stdout


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (("--imu", "/pdr/imu/data"), "a topic of our own nodes"),
        (("--imu", "/imu/data", "--namespace", "two feet"), "no namespace"),
        (("--imu", "my imu"), "no ROS topic"),
        (("--imu", "/imu", "--mag", "imu"), "cannot be both"),
        (("--mag", "/pdr/imu/mag"), "a topic of our own nodes"),
        (("--driver", "replayed"), "driver.recording"),
        (("--duration", "inf"), "--duration inf"),
        (("--duration", "0"), "--duration"),
        (("--driver", "teapot"), "driver.device = 'teapot'"),
        (("--left", "/l"), "--left is one of two feet: give --right its topic too; a foot alone is --imu"),
        (("--right", "/r"), "give --left its topic too"),
        (("--left", "/l", "--right", "/r", "--imu", "/i"), "--left is one of two feet: leave out --imu"),
        (("--left", "/l", "--right", "/r", "--pipeline", "chest"), "leave out --pipeline chest"),
        (("--left", "/l", "--right", "/r", "--mag", "/m"), "--left-mag, the other foot on --right-mag: leave out"),
        (("--left", "/l", "--right", "/r", "--driver", "simulated"), "`pdr demo --dual`"),
        (("--left", "/l", "--right", "l"), "/l cannot be both --left and --right"),
        (("--left", "/pdr/left/imu/data", "--right", "/r"), "a topic of our own nodes"),
        (("--right-mag", "/m"), "--right-mag goes with --left and --right: the magnetometer of one sensor is --mag"),
        (("--pipeline", "hand"), "--pipeline hand: there is none of that name; choose from foot, chest"),
    ],
)
def test_what_cannot_be_meant_is_refused(arguments, word, tmp_path):
    answer = pdr("live", *arguments, "--out", tmp_path / "out")
    assert answer.returncode == 2
    assert word in answer.stderr
    assert not Path(tmp_path / "out").exists()

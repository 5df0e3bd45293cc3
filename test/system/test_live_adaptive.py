"""`pdr demo --adaptive`: the gyro of a live driver is switched; the track is that of the core on the same samples."""

import json
import re

import numpy as np
import pytest

from pdr_bringup_scripts.live.live_recording import messages
from pdr_core.intake import Ingestion
from pdr_core.params_file import load_params
from pdr_core.pipeline import AdaptiveFoot
from pdr_core.rate_limit import RateLimit
from pdr_core.recording import open_recording
from pdr_core.records import joined, length
from pdr_core.stance import StanceDetection
from pdr_nodes.convert import nav_block
from support.moved import moved_again
from support.processes import check_refused, pdr

LENGTH_M = 60.0
END_BOUND_PERCENT = 3.0  # measured: 0.6
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def demo(tmp_path_factory):
    """A short demonstration that has calibrated after 20 m: what it said and where its files are."""
    out = tmp_path_factory.mktemp("adaptive") / "out"
    quick = tmp_path_factory.mktemp("params") / "quick.yaml"
    quick.write_text(
        "/**: {ros__parameters: {power: {calibration_m: 20.0, examine_every_s: 10.0}, heading: {constraint: hde}}}"
    )
    answer = pdr("demo", "--adaptive", "--length", LENGTH_M, "--params", quick, "--out", out)
    assert answer.returncode == 0, answer.stderr
    return answer, out


@pytest.fixture(scope="module")
def result(demo):
    return json.loads((demo[1] / "result.json").read_text())


@pytest.fixture(scope="module")
def raw(demo):
    """The samples of the driver as they were recorded."""
    (sensor,) = open_recording(demo[1] / "recording").sensors.values()
    return joined(list(sensor.pieces()))


def test_live_is_offline(demo, raw):
    params, bag = load_params(demo[1] / "nodes" / "parameters.yaml"), demo[1] / "recording"
    intake, foot = Ingestion(params.intake), AdaptiveFoot(params)
    stance = StanceDetection(params.stance, params.place, params.detectors)
    judged = joined([stance.run(intake.run(raw)), stance.run(intake.finish()), stance.finish()])
    navs = [moved.output.nav for moved in moved_again(foot, judged, list(messages(bag, "walk")))]
    offline = RateLimit(params.node.odom_rate_hz).thinned(joined([*navs, foot.finish().nav]))
    live = joined([nav_block(message) for message in messages(bag, "odom")])
    for name, of_nodes, of_core in zip(live._fields, live, offline, strict=True):
        np.testing.assert_array_equal(of_nodes, of_core, err_msg=name)
    assert length(live) > 3000


def test_the_driver_has_obeyed(raw, result):
    off = raw.gyro_sd_radps < 0.0
    assert 0.1 < off.mean() < 0.6
    slow_ns, fast_ns = np.diff(raw.stamp_ns)[off[1:]], np.diff(raw.stamp_ns)[~off[1:]]
    assert (np.median(slow_ns), np.median(fast_ns)) == (20_000_000, 10_000_000)
    modes = result["energy"]["modes"]
    assert [m["mode"] for m in modes[:2]] == ["initialising", "dead_reckoning"]
    assert {m["answer"] for m in modes} == {"acknowledged"}
    assert "fault" not in {m["mode"] for m in modes}


def test_the_charge_is_that_of_the_timeline(raw, result):
    energy = result["energy"]
    off_s = np.diff(raw.stamp_ns)[raw.gyro_sd_radps[1:] < 0.0].sum() * 1e-9
    settling_s = energy["switch_ons"] * 0.05
    assert energy["duration_s"] - energy["gyro_on_s"] == pytest.approx(off_s - settling_s, abs=0.5)
    assert 0.0 < energy["sensor_saved_share"] < 1.0


def test_the_track_is_near_the_truth(result):
    assert result["truth"]["end_error_percent"] < END_BOUND_PERCENT
    assert result["distance_m"] == pytest.approx(LENGTH_M, rel=0.05)
    assert [n["kind"] for n in result["notices"] if n["level"] != "OK"] == ["heading_on"]


def test_the_heading_constraint_has_held_its_strides(result):
    held = [n["count"] for n in result["notices"] if n["kind"] == "heading_held"]
    assert sum(held) > 10


def test_it_says_what_the_driver_was_asked_and_draws_it(demo):
    said, page = demo[0].stdout, (demo[1] / "report.html").read_text()
    assert re.search(r"gyro off, 50 Hz +acknowledged, holds \d\.\d\d s later +dead reckoning: L0 is walked", said)
    assert re.search(r"The gyro was on for \d+\.\d % of the time; the sensor \(mpu9250\) drew", said)
    for words in ("When the gyro was on", "What the driver was asked", "gyro off, 50 Hz", "of the charge saved"):
        assert words in page
    assert page.count("acknowledged, holds") == said.count("acknowledged, holds")


def test_two_feet_are_not_switched(tmp_path):
    check_refused(pdr("demo", "--adaptive", "--dual", "--out", tmp_path / "out"), "--dual")

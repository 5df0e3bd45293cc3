"""`pdr live --pipeline chest` on the driver of a card, and on one of ours: what `pdr run` makes of the same samples."""

import json

import numpy as np
import pytest

from pdr_bringup_scripts.live.live_recording import chest_outputs
from pdr_core.params import Params
from pdr_core.pipeline import ChestCard
from pdr_core.rate_limit import RateLimit
from pdr_core.recording import open_recording
from pdr_core.recording.tum import read_tum
from pdr_core.records import joined, part
from support.chest import RATE_HZ, walk
from support.live_command import live_until_done
from support.processes import pdr
from support.walks import BEGIN_NS, write_csv

SECONDS, SPEED = 22, 2
TOLERANCE = 1e-9
CARD = ("--imu", "/card/imu", "--pipeline", "chest")
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def samples():
    """A stand, one side of a rectangle and a stop."""
    imu = part(walk(3).imu, 0, SECONDS * RATE_HZ)
    return imu._replace(stamp_ns=imu.stamp_ns + BEGIN_NS)


@pytest.fixture(scope="module")
def run(samples, tmp_path_factory):
    """A run that Ctrl-C ends: its folder, its exit code and what it said."""
    folder = tmp_path_factory.mktemp("card")
    driver = (write_csv(folder / "card.csv", samples), "/card/imu", "RELIABLE", SPEED)
    return folder / "out", *live_until_done(folder, [driver], *CARD)


@pytest.fixture(scope="module")
def again(run):
    """What `pdr run` makes of the recording."""
    answer = pdr("run", run[0] / "recording", "--pipeline", "chest", "--out", run[0] / "again")
    assert answer.returncode == 0, answer.stderr
    return run[0] / "again"


def test_ctrl_c_ends_it_well(run):
    out, code, said, complained = run
    assert (code, "Traceback" in complained) == (0, False), complained
    assert said.startswith("Walked ")
    assert " steps within " in said
    assert f"Open {out / 'report.html'} in a browser" in said
    assert "When the chest stood" in (out / "report.html").read_text()


def test_what_is_estimated_is_what_was_recorded(run, again):
    live, offline = (read_tum(folder / "trajectory.tum") for folder in (run[0], again))
    rows = RateLimit(Params().node.odom_rate_hz).allowed(offline.stamp_ns)
    np.testing.assert_array_equal(live.stamp_ns, offline.stamp_ns[rows])
    np.testing.assert_allclose(live.position_m, offline.position_m[rows], rtol=0.0, atol=TOLERANCE)
    np.testing.assert_allclose(live.quat_xyzw, offline.quat_xyzw[rows], rtol=0.0, atol=TOLERANCE)


def test_the_rests_are_those_of_run(run):
    heard = joined([output.judged for output in chest_outputs(run[0] / "recording")])
    (recorded,) = open_recording(run[0] / "recording").sensors.values()
    card = ChestCard(Params())
    known = card.run(joined(list(recorded.pieces()))).judged
    np.testing.assert_array_equal(heard.imu.stamp_ns, known.imu.stamp_ns)
    first = int(np.argmax(known.stance))  # before its first rest the card has no velocity either
    np.testing.assert_array_equal(heard.stance[first:], known.stance[first:])
    assert 0.2 < heard.stance.mean() < 0.8


def test_the_result_is_the_same(run, again):
    live, offline = (json.loads((folder / "result.json").read_text()) for folder in (run[0], again))
    assert live["strides"] == offline["strides"] > 6
    assert live["samples"] == offline["samples"]
    assert live["distance_m"] == pytest.approx(offline["distance_m"], abs=1e-6)
    assert {n["kind"]: n["count"] for n in live["notices"]} == {n["kind"]: n["count"] for n in offline["notices"]}
    assert (live["pipeline"], offline["pipeline"]) == ("chest, live", "chest")


def test_without_the_option_run_names_it(run):
    answer = pdr("run", run[0] / "recording")
    assert answer.returncode == 0, answer.stderr
    assert "Error: no stance for " in answer.stdout
    assert "Worn on the chest it needs `--pipeline chest`" in answer.stdout


def test_the_samples_come_through_as_they_were(run, samples):
    (recorded,) = open_recording(run[0] / "recording").sensors.values()
    heard = joined(list(recorded.pieces()))
    rows = np.searchsorted(samples.stamp_ns, heard.stamp_ns)
    np.testing.assert_array_equal(heard.accel_mps2, samples.accel_mps2[rows])
    assert len(rows) > 0.8 * len(samples.stamp_ns)  # what is lost, is lost before it reaches us


def test_a_driver_of_ours_simulates_a_chest_and_its_truth(tmp_path):
    params = tmp_path / "mine.yaml"
    walk = "{walk: straight, walk_length_m: 6.0, sample_rate_hz: 100.0, magnetometer: true}"
    params.write_text(f"/**: {{ros__parameters: {{driver: {{rate_factor: 4.0}}, simulation: {walk}}}}}\n")
    options = ("--driver", "simulated", "--mag", "/imu/mag", "--params", params, "--out", tmp_path / "out")
    answer = pdr("live", "--pipeline", "chest", *options)
    assert answer.returncode == 0, answer.stderr
    assert "off the true path" in answer.stdout
    (sensor,) = open_recording(tmp_path / "out" / "recording").sensors.values()
    assert (joined(list(sensor.pieces())).field_sd_tesla >= 0.0).all()

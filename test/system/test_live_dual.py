"""Two feet through nine processes, live: the feet and the person are where they are offline, from the same samples."""

import json
import re
from functools import partial

import numpy as np
import pytest

from pdr_bringup_scripts.live.live_recording import messages
from pdr_bringup_scripts.simulated import pieces
from pdr_core.params import Params
from pdr_core.params_file import load_params
from pdr_core.pipeline import BothFeet, FootInertial
from pdr_core.rate_limit import RateLimit
from pdr_core.recording import Sensor, Session, open_recording
from pdr_core.recording.export import write_recording
from pdr_core.recording.tum import read_tum
from pdr_core.records import ImuBlock, joined, length
from pdr_nodes.convert import nav_block
from support.feet import both_walk
from support.processes import pdr

TOLERANCE = 1e-9
FEET = ("left", "right")
ATE_BOUND_M = 0.1  # measured: 0.03 of each foot, 0.04 of the person
FILES = ("trajectory.tum", "result.json", "report.html")
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def demo(tmp_path_factory):
    """A short demonstration: what it said and where its files are."""
    out = tmp_path_factory.mktemp("dual") / "out"
    straight = tmp_path_factory.mktemp("params") / "straight.yaml"
    walk = "simulation: {walk: straight, sensor_model: g_sensitive}"
    straight.write_text(f"/**: {{ros__parameters: {{{walk}, node: {{odom_rate_hz: 100.0}}}}}}")
    answer = pdr("demo", "--dual", "--length", 36, "--params", straight, "--out", out)
    assert answer.returncode == 0, answer.stderr
    return answer, out


@pytest.fixture(scope="module")
def offline(demo):
    """What is made offline of the samples that were recorded: of each foot, what it would say, and of the body."""
    folder = demo[1]
    params = load_params(folder / "nodes" / "heading_fusion" / "parameters.yaml")
    both, sensors = BothFeet(params, FEET), open_recording(folder / "recording").sensors
    outputs = [both.run(foot, joined(list(sensors[f"{foot}/imu"].pieces()))) for foot in FEET] + [both.finish()]
    navs = {foot: [nav.nav for output in outputs for name, nav in output.feet if name == foot] for foot in FEET}
    said = {f"{foot}/odom": RateLimit(params.node.odom_rate_hz).thinned(joined(navs[foot])) for foot in FEET}
    return said | {"odom": joined([output.body for output in outputs if length(output.body)])}


@pytest.mark.parametrize("topic", ["odom", "left/odom", "right/odom"])
def test_live_is_offline(demo, offline, topic):
    live = joined([nav_block(message) for message in messages(demo[1] / "recording", topic)])
    np.testing.assert_array_equal(live.stamp_ns, offline[topic].stamp_ns)
    for name, of_nodes, of_core in zip(live._fields, live, offline[topic], strict=True):
        np.testing.assert_allclose(of_nodes, of_core, rtol=0.0, atol=TOLERANCE, err_msg=name)
    assert length(live) > 2000


@pytest.mark.parametrize("foot", FEET)
def test_the_feet_told_each_other_something(demo, offline, foot):
    """Else the test above would show little."""
    samples = joined(list(open_recording(demo[1] / "recording").sensors[f"{foot}/imu"].pieces()))
    alone = RateLimit(100.0).thinned(FootInertial(Params()).run(samples).nav)
    apart_m = alone.position_m - offline[f"{foot}/odom"].position_m[: length(alone)]
    assert np.abs(apart_m).max() > 0.01


@pytest.mark.parametrize("whose", ["left", "right", "body"])
def test_feet_and_person_are_near_the_truth(demo, whose):
    result = json.loads((demo[1] / whose / "result.json").read_text())
    assert [name for name in FILES if not (demo[1] / whose / name).exists()] == []
    assert result["truth"]["ate2_m"] < ATE_BOUND_M
    assert [n for n in result["notices"] if n["level"] == "ERROR"] == []
    together = json.loads((demo[1] / "result.json").read_text())
    assert (together["sensors"] | {"body": together["body"]})[whose] == result


def test_it_says_how_far_each_was_off(demo):
    said = demo[0].stdout
    for whose in ("left", "right", "body"):
        assert re.search(rf"{whose}: Walked \d+\.\d+ m in \d+ strides .* It was on average 0\.0\d m off", said)


def test_a_real_walk_through_the_nodes_is_what_run_makes_of_it(recordings, tmp_path):
    recording = recordings / "gaitmap_dual_foot" / "imu_sample.csv"
    for command in ("replay", "run"):
        answer = pdr(command, recording, "--out", tmp_path / command)
        assert answer.returncode == 0, answer.stderr
    for live, offline in (("left", "left_sensor"), ("right", "right_sensor"), ("body", "body")):
        said, known = (read_tum(tmp_path / d / "trajectory.tum") for d in (f"replay/{live}", f"run/{offline}"))
        rows = RateLimit(Params().node.odom_rate_hz).allowed(known.stamp_ns) if live != "body" else slice(None)
        np.testing.assert_array_equal(said.stamp_ns, known.stamp_ns[rows])
        np.testing.assert_allclose(said.position_m, known.position_m[rows], rtol=0.0, atol=TOLERANCE)
        assert len(said.stamp_ns) > 7000


def test_a_foot_whose_recording_ends_before_the_others_costs_neither_anything(tmp_path):
    """The longer one waits for answers, and nobody for as long as a foot is waited for that may come back.

    It has more samples left than are sent ahead of the answers: no node takes the pause of its driver for the end.
    """
    ends_s = {"left": 8.0, "right": 22.0}
    walk, recording = both_walk(22.0), tmp_path / "feet.mcap"
    rows = {foot: (imu.stamp_ns - imu.stamp_ns[0]) * 1e-9 <= ends_s[foot] for foot, imu in walk.items()}
    kept = {foot: ImuBlock._make(column[rows[foot]] for column in imu) for foot, imu in walk.items()}
    sensors = [Sensor(foot, None, partial(pieces, imu)) for foot, imu in kept.items()]
    write_recording(Session("feet", recording, "simulated", {one.name: one for one in sensors}), sensors, recording)
    answer = pdr("replay", recording, "--rate", 0, "--out", tmp_path / "out")
    assert answer.returncode == 0, answer.stderr
    for foot, imu in kept.items():
        track = read_tum(tmp_path / "out" / foot / "trajectory.tum")
        np.testing.assert_array_equal(track.stamp_ns, imu.stamp_ns)
    body = read_tum(tmp_path / "out" / "body" / "trajectory.tum")
    assert body.stamp_ns[-1] == kept["right"].stamp_ns[-1]
    assert pdr("run", recording, "--out", tmp_path / "run").returncode == 0
    for whose in (*FEET, "body"):
        said, known = (read_tum(tmp_path / folder / whose / "trajectory.tum") for folder in ("out", "run"))
        np.testing.assert_array_equal(said.stamp_ns, known.stamp_ns)
        np.testing.assert_allclose(said.position_m, known.position_m, rtol=0.0, atol=TOLERANCE, err_msg=whose)
    for folder in ("out", "run"):  # and what the right foot walked alone counts in full
        result = json.loads((tmp_path / folder / "result.json").read_text())["body"]
        assert result["distance_m"] == pytest.approx(np.hypot(*body.position_m[-1, :2]), abs=1.4)  # the last stride
        assert "left has no samples for 14 s" in str(result["notices"])

"""Two feet beside somebody who follows the body, from the command line: compared, aided and laid on a map."""

import json
from pathlib import Path

import numpy as np
import pytest

from pdr_core.evaluation.body_truth import truth_between
from pdr_core.recording import open_recording
from pdr_core.recording.tum import read_tum
from pdr_core.records import Floats, Truth
from pdr_core.records_external import about_up
from pdr_core.simulation.external_source import ExternalSource
from support.processes import check_refused, pdr

SOURCE, WHO = ExternalSource(), ("left", "right", "body")


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("bag") / "walk"
    walk = ("--walk", "rectangle", "--length", 100, "--rate", 100, "--sensor", "consumer", "--seed", 2)
    made = pdr("simulate", "--feet", "--external", *walk, "--out", out)
    assert made.returncode == 0, made.stderr
    return out


@pytest.fixture(scope="module")
def truths(bag: Path) -> dict[str, Truth]:
    """Where both feet and the body between them were, in the frame of who follows."""
    found = {name: sensor.truth for name, sensor in open_recording(bag).sensors.items()}
    found["body"] = truth_between(found["left"], found["right"])
    R, shift_m = about_up(SOURCE.yaw_rad), np.array(SOURCE.shift_m)
    return {who: Truth(t.kind, t.stamp_ns, t.position_m @ R.T + shift_m) for who, t in found.items()}


def place_m(truth: Truth, at_ns: Floats) -> Floats:
    """Return where one was at stamps (n,), (n, 2)."""
    return np.column_stack([np.interp(at_ns, truth.stamp_ns, axis_m) for axis_m in truth.position_m.T[:2]])


def run(bag: Path, out: Path, *options: object) -> dict:
    answer = pdr("run", bag, "--out", out, "--json", *options)
    assert answer.returncode == 0, answer.stderr
    return json.loads(answer.stdout)


def worst_m(out: Path, truths: dict[str, Truth]) -> dict[str, float]:
    """Return how far feet and body are off on the map at most."""
    tracks = {who: read_tum(out / who / "trajectory_map.tum") for who in WHO}
    off_m = {who: t.position_m[:, :2] - place_m(truths[who], t.stamp_ns) for who, t in tracks.items()}
    return {who: float(np.linalg.norm(one, axis=1).max()) for who, one in off_m.items()}


@pytest.fixture(scope="module")
def compared(bag: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[dict, Path]:
    out = tmp_path_factory.mktemp("compared")
    return run(bag, out, "--external", "/robot/pose"), out


def test_compared_the_body_is_laid_beside_theirs_and_nothing_is_changed(bag: Path, compared, tmp_path: Path) -> None:
    found, _ = compared
    alone = run(bag, tmp_path)
    for one, other in ((found["sensors"], alone["sensors"]), ({"body": found["body"]}, {"body": alone["body"]})):
        assert {n: r["end_position_m"] for n, r in one.items()} == {n: r["end_position_m"] for n, r in other.items()}
    assert found["body"]["external"]["topic"] == "/robot/pose"
    assert found["body"]["external"]["aided"] is False
    assert found["body"]["external"]["frame"]["yaw_rad"] == pytest.approx(SOURCE.yaw_rad, abs=0.15)
    assert found["body"]["external"]["frame"]["clock_s"] == pytest.approx(SOURCE.clock_s, abs=0.3)
    assert "external" not in alone["body"]
    assert not (tmp_path / "body" / "trajectory_map.tum").exists()
    assert found["body"]["pipeline"] == "compared_feet"


def test_aided_feet_and_body_are_where_they_say(bag: Path, compared, truths: dict[str, Truth], tmp_path: Path) -> None:
    aided = run(bag, tmp_path, "--feet", "left,right", "--external", "/robot/pose", "--aid")
    assert aided["body"]["external"]["aided"] is True
    assert {n["kind"] for n in aided["body"]["notices"]} >= {"external_aligned"}
    assert aided["body"]["pipeline"] == aided["sensors"]["left"]["pipeline"] == "aided_feet"
    off_m, without_m = worst_m(tmp_path, truths), worst_m(compared[1], truths)
    print(f"aided {off_m}, without {without_m}", end=" ")
    assert max(off_m.values()) < 1.0
    assert json.loads((tmp_path / "result.json").read_text()) == aided


def test_two_known_points_lay_feet_and_body_on_the_map(bag: Path, truths: dict[str, Truth], tmp_path: Path) -> None:
    truth = truths["body"]
    first_ns, last_ns = (int(truth.stamp_ns[i]) for i in (0, -1))
    told = []
    for at_s in (1.0, 0.4e-9 * (last_ns - first_ns)):
        ((x, y),) = place_m(truth, np.array([first_ns + 1e9 * at_s]))
        told += ["--at", f"{at_s:.2f}:{x:.3f},{y:.3f}"]
    found = run(bag, tmp_path, *told)
    assert found["body"]["external"]["pairs"] == 2
    assert {n["kind"] for n in found["body"]["notices"]} >= {"known_point", "known_points"}
    off_m = worst_m(tmp_path, truths)
    print(off_m, end=" ")
    assert max(off_m.values()) < 1.0


def test_the_files_on_the_map_are_named_where_they_are(bag: Path, tmp_path: Path) -> None:
    said = pdr("run", bag, "--external", "/robot/pose", "--out", tmp_path).stdout
    assert "body: Walked" in said
    assert "/robot/pose was compared with the track" in said
    assert said.count("trajectory_map.tum") == 2  # in the folders of the feet, and in that of the body


def test_one_foot_is_asked_for_by_its_name(bag: Path, tmp_path: Path) -> None:
    found = run(bag, tmp_path, "--sensor", "left", "--external", "/robot/pose")
    assert found["pipeline"] == "compared_foot"
    assert found["external"]["pairs"] > 50
    assert (tmp_path / "trajectory_map.tum").exists()


def test_known_points_beyond_the_walk_are_refused(bag: Path) -> None:
    check_refused(pdr("run", bag, "--at", "1:0,0", "--at", "9999:1,1"), "--at 9999: the recording of left lasts")

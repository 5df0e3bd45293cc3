"""A bag that holds somebody else's odometry: compared with it and aided by it, from the command line."""

import json
from pathlib import Path

import numpy as np
import pytest

from pdr_core.recording import open_recording
from pdr_core.recording.tum import read_tum
from support.processes import check_refused, pdr


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("bag") / "walk"
    made = pdr("simulate", "--motion", "smooth", "--length", 100, "--rate", 100, "--external", "--out", out)
    assert made.returncode == 0, made.stderr
    return out


def run(bag: Path, *options: object) -> dict:
    answer = pdr("run", bag, "--external", "/robot/pose", "--json", *options)
    assert answer.returncode == 0, answer.stderr
    return json.loads(answer.stdout)


def test_compared_and_aided_it_says_how_both_lie(bag: Path, tmp_path: Path) -> None:
    compared, aided = run(bag), run(bag, "--aid", "--out", tmp_path / "result")
    alone = json.loads(pdr("run", bag, "--json").stdout)
    assert compared["end_position_m"] == alone["end_position_m"]
    assert "external" not in alone
    assert aided["end_position_m"] != alone["end_position_m"]
    for found, aids in ((compared, False), (aided, True)):
        assert found["external"]["topic"] == "/robot/pose"
        assert found["external"]["aided"] is aids
        assert 0.1 < found["external"]["ate_m"] < 1.0
        assert found["external"]["frame"]["yaw_rad"] == pytest.approx(2.0, abs=0.15)
        assert found["external"]["frame"]["clock_s"] == pytest.approx(0.4, abs=0.3)
    assert {n["kind"] for n in aided["notices"]} >= {"external_aligned"}
    assert json.loads((tmp_path / "result" / "result.json").read_text())["external"] == aided["external"]


def test_in_words_it_is_a_sentence(bag: Path) -> None:
    said = pdr("run", bag, "--external", "/robot/pose").stdout
    assert "/robot/pose was compared with the track" in said
    assert "its clock is ahead by 0." in said


def test_what_cannot_be_had_is_said(bag: Path, tmp_path: Path) -> None:
    nobody = pdr("run", bag, "--external", "/nobody")
    check_refused(nobody, "--external /nobody", "it has: /imu/ground_truth, /robot/pose")
    check_refused(pdr("run", bag, "--aid"), "--aid says what --external is for")
    check_refused(
        pdr("run", bag, "--external", "/robot/pose", "--smooth"), "goes with feet as they walk", "leave out --smooth"
    )
    csv = tmp_path / "walk.csv"
    assert pdr("convert", bag, csv).returncode == 0
    check_refused(pdr("run", csv, "--external", "/robot/pose"), "has no topics")
    check_refused(pdr("simulate", "--external", "--out", tmp_path / "w.csv"), "holds no topics of others")


def test_two_known_points_lay_a_walk_on_the_map(bag: Path, tmp_path: Path) -> None:
    """Where the true track was at two times, seen from a map that is turned by a right angle and shifted."""
    truth = next(one.truth for one in open_recording(bag).sensors.values())
    seconds = (truth.stamp_ns - truth.stamp_ns[0]) * 1e-9
    end_s = float(seconds[-1])
    at = {}
    for at_s in (1.0, 0.4 * end_s, end_s - 1.0):
        x, y = (float(np.interp(at_s, seconds, truth.position_m[:, axis])) for axis in (0, 1))
        at[at_s] = (-y + 20.0, x - 5.0)
    told = [part for s, (x, y) in at.items() for part in ("--at", f"{s:.2f}:{x:.3f},{y:.3f}")]
    answer = pdr("run", bag, *told, "--out", tmp_path / "result")
    assert answer.returncode == 0, answer.stderr
    assert "3 known points lie" in answer.stdout
    on_map, ours = (read_tum(tmp_path / "result" / name) for name in ("trajectory_map.tum", "trajectory.tum"))
    np.testing.assert_array_equal(on_map.stamp_ns, ours.stamp_ns)
    assert on_map.position_m[-1, :2] == pytest.approx(at[end_s - 1.0], abs=1.0)
    found = json.loads((tmp_path / "result" / "result.json").read_text())
    assert found["external"]["pairs"] == 3
    assert {n["kind"] for n in found["notices"]} >= {"known_point", "known_points"}


def test_known_points_that_cannot_be_are_refused(bag: Path) -> None:
    check_refused(pdr("run", bag, "--at", "somewhere"), "--at somewhere: give seconds")
    check_refused(pdr("run", bag, "--at", "1:0,0", "--at", "9999:1,1"), "--at 9999: the recording of", "lasts")
    check_refused(pdr("run", bag, "--at", "3:0,0", "--at", "9:5,0", "--at", "3:1,1"), "--at 3 is given twice")
    check_refused(pdr("run", bag, "--at", "1:0,0", "--external", "/robot/pose"), "leave out --external")
    one = pdr("run", bag, "--at", "1:0,0")
    assert "two known points" in one.stdout

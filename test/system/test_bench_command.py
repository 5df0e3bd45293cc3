import json
import re
from dataclasses import replace
from inspect import signature

import numpy as np
import pytest

from pdr_bringup_scripts.benches import cheng_tables, dual_tables, gui_tables
from pdr_bringup_scripts.benches.jobs import BENCHES
from pdr_bringup_scripts.benches.qiu_tables import FILES, as_json, show, write_files
from pdr_bringup_scripts.commands.bench import bench
from pdr_core.bench.cheng_tables import ChengBench, GainPoint
from pdr_core.bench.cheng_walks import by_every_method, walk
from pdr_core.bench.dual_walks import DualTrial, DualWalk, FootTrack
from pdr_core.bench.gui_variants import TABLE_3, VARIANTS
from pdr_core.bench.gui_walks import GuiWalk, by_every_variant
from pdr_core.bench.qiu_tables import Cost, means
from pdr_core.bench.qiu_walks import Measured, compared, trials
from pdr_core.evaluation.course_plots import CourseTrack
from support.processes import check_refused, pdr


def test_the_bench_prints_tables():
    run = pdr("bench", "--seeds", 2, "--length", 4.8)
    assert run.returncode == 0, run.stderr
    for text in ("Mechanisation alone", "Gui Table 1", "Consistency, true verdicts: 2 walks of 4.8 m", "too careful"):
        assert text in run.stdout
    assert "\x1b" not in run.stdout
    assert max(map(len, run.stdout.splitlines())) <= 120


def test_the_bench_prints_json():
    found = json.loads(pdr("bench", "--seeds", 2, "--length", 4.8, "--json").stdout)
    assert {row["rate_hz"] for row in found["mechanisation"]} >= {50.0, 1000.0}
    assert {row["sensor_model"] for row in found["table_1"]} >= {"gui_table_1", "gui_table_1_deg"}
    found = json.loads(pdr("bench", "--stress", "--seeds", 2, "--json").stdout)
    assert found["summary"][0]["walks"] == len(found["walks"]) == 2


def test_the_help_says_how_many_walks_there_are_and_which_have_a_page():
    seeds, out = (signature(bench).parameters[name].default.help for name in ("seeds", "out"))
    assert "default: 100, --stress 500, --gui 50" in seeds
    assert "--qiu" not in seeds  # those of the paper
    assert [name for name, one in BENCHES.items() if one.seeds and f"{name} {one.seeds}" not in seeds] == []
    assert [name for name, one in BENCHES.items() if name and one.has_page != (name in out)] == []


def test_the_length_of_a_stress_walk_cannot_be_chosen():
    answer = pdr("bench", "--stress", "--length", 5)
    check_refused(answer, "--stress", "leave out --length")
    assert "--external" not in answer.stderr, "that one takes a length"


def test_qius_walks_are_those_of_the_paper(tmp_path):
    check_refused(pdr("bench", "--qiu", "--length", 5), "--qiu", "leave out --length")
    check_refused(pdr("bench", "--qiu", "--seeds", 5), "--qiu", "leave out --seeds")
    check_refused(pdr("bench", "--qiu", "--dual"), "choose one")
    check_refused(pdr("bench", "--out", tmp_path / "page"), "--qiu", "--dual", "leave out --out")
    assert not (tmp_path / "page").exists()


def test_guis_walks_are_their_own(tmp_path):
    check_refused(pdr("bench", "--gui", "--length", 5), "--gui", "leave out --length")
    check_refused(pdr("bench", "--gui", "--qiu"), "--gui", "choose one")
    check_refused(pdr("bench", "--gui", "--stress", "--out", tmp_path / "page"), "--gui", "choose one")
    assert not (tmp_path / "page").exists()


def test_the_walks_of_the_energy_curve_are_their_own(tmp_path):
    check_refused(pdr("bench", "--energy", "--length", 5), "--energy", "leave out --length")
    check_refused(pdr("bench", "--energy", "--dual", "--out", tmp_path / "page"), "--energy", "choose one")
    assert not (tmp_path / "page").exists()


def test_chengs_walks_are_their_own():
    check_refused(pdr("bench", "--cheng", "--length", 5), "--cheng", "leave out --length")
    check_refused(pdr("bench", "--cheng", "--gui"), "--cheng", "choose one")


def test_the_page_and_the_tables_of_chengs_walks(tmp_path, capsys):
    one, gain = walk(1, 1), GainPoint("improved", 0.5, 0.1, 0.1, 1.0)
    found = list(by_every_method(one))
    other = [replace(gain, gain_per_s=k, tilt_error_deg=0.1 + k**2) for k in (0.0, 0.2, 0.9)]
    long = [replace(found[0].result, case=0, end_error_m=4.5)]
    bench = ChengBench([f.result for f in found], other, long, found)
    cheng_tables.show(bench)
    shown = capsys.readouterr().out
    assert max(map(len, shown.splitlines())) <= 120
    for text in ("1 (32 m)", "ICFWSLC, ahead", "2.48", "1 of 1", "default 0.52/s"):
        assert text in shown
    cheng_tables.write_files(tmp_path, bench)
    page = (tmp_path / "cheng.html").read_text()
    for name in ("plan-0", "falls-0", "velocity-0", "attitude-0", "gain-time", "gain-theory", "gain-tilt", "gain-end"):
        assert f'id="{name}"' in page
    figures = json.loads((tmp_path / "cheng.json").read_text())
    assert figures["table_2"][0]["end_error_m"] == found[0].result.end_error_m
    assert figures["default_gain_per_s"] == 0.52


@pytest.fixture(scope="module")
def gui_walk():
    """A short walk of one seed by every variant."""
    return list(by_every_variant(GuiWalk("short", "rectangle", 12.0), 1))


def test_guis_tables_show_the_figures(gui_walk, capsys):
    gui_tables.show([one.result for one in gui_walk])
    shown = capsys.readouterr().out
    assert max(map(len, shown.splitlines())) <= 120
    assert "Gui Table 3: positioning error %" in shown
    assert "short (12.0 m)" in shown
    for one in gui_walk:
        r = one.result
        row = next(line for line in reversed(shown.splitlines()) if line.split("  ")[1] == r.variant)
        assert f"({r.end_x_m:.2f}, {r.end_y_m:.2f})" in row
        assert f" {r.end_error_m:.2f} " in row


def test_guis_page_and_json_hold_every_walk(gui_walk, tmp_path):
    results = [one.result for one in gui_walk]
    gui_tables.write_files(tmp_path, results, gui_walk)
    assert {path.name for path in tmp_path.iterdir()} == set(gui_tables.FILES.split(", "))
    page = (tmp_path / "gui.html").read_text()
    drawn = [json.loads(text) for text in re.findall(r'<script type="application/json">(.*?)</script>', page)]
    plan, attitude, velocity = ([trace["name"] for trace in figure["data"]] for figure in drawn)
    assert plan == ["Truth", *VARIANTS]
    assert attitude == velocity == ["Truth", *TABLE_3] * 3
    assert drawn[0]["data"][1]["x"][-1] == pytest.approx(results[0].end_x_m, rel=1e-4)
    assert drawn[2]["layout"]["yaxis"]["title"]["text"] == "East [m/s]"
    found = json.loads((tmp_path / "gui.json").read_text())
    assert found == json.loads(gui_tables.as_json(results))
    assert [row["variant"] for row in found["table_3"]] == list(VARIANTS)
    assert found["walks"][0]["end_error_m"] == results[0].end_error_m


@pytest.fixture(scope="module")
def qiu_walks():
    """A walk of each table without a step, which ends 3 m and 7 degrees off."""
    walks = []
    for trial in {t.table: t for t in reversed(trials())}.values():
        true_m = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.2 if trial.table == "stairs" else 0.0]])
        truth = CourseTrack("Truth", np.array([0.0, 1.0]), true_m, np.array([0.0, -900.0]))
        off_m, off_deg = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.12]]), np.array([0.0, 7.0])
        estimate = CourseTrack("ESKF", truth.time_s, true_m + off_m, truth.heading_deg + off_deg)
        walks.append(Measured(compared(trial, "ESKF", [], estimate, truth), estimate, truth, []))
    return walks


def test_qius_tables_show_the_figures(qiu_walks, capsys):
    cost = Cost("3", "noise", replace(means([qiu_walks[0].result]), end_error_percent=9.87))
    show(qiu_walks, [cost])
    shown = capsys.readouterr().out
    assert max(map(len, shown.splitlines())) <= 120
    rows = [line.split() for line in shown.splitlines() if line.strip()]
    assert ["1", "0", "(57)", "0.00", "-100.00", "-173.0", "10", "0.70"] in rows
    assert ["1", "0", "(321)", "0.00", "-100.00", "3.00", "0.71"] in rows
    assert ["1", "0", "(14)", "3.320", "3.200", "+3.75"] in rows
    assert any(row[0] == "noise" and "9.87" in row for row in rows)
    assert "Table 4" in shown


def test_qius_page_and_json_hold_every_walk(qiu_walks, tmp_path):
    write_files(tmp_path, qiu_walks, [])
    page = (tmp_path / "qiu.html").read_text()
    drawn = [json.loads(text) for text in re.findall(r'<script type="application/json">(.*?)</script>', page)]
    assert len(drawn) == 2 * 4 + 1  # plan and heading of each, and the height of the stairs
    headings = [d for d in drawn if d["layout"]["yaxis"]["title"]["text"] == "Heading [°]"]
    assert [trace["name"] for trace in headings[0]["data"]] == ["Truth", "ESKF"]
    assert all(d["data"][0]["y"] == [0.0, -900.0] for d in headings)
    assert all(d["data"][1]["y"] == [0.0, -893.0] for d in headings)
    assert set(FILES.split(", ")) == {path.name for path in tmp_path.iterdir()}
    found = json.loads((tmp_path / "qiu.json").read_text())
    assert found == json.loads(as_json(qiu_walks, []))
    assert {walk["table"]: walk["height_error_percent"] for walk in found["walks"]}["3"] is None
    assert all(walk["error_per_turn_deg"] > 0.0 for walk in found["walks"])


@pytest.fixture(scope="module")
def dual_walks():
    """Four straight walks, mirrored and alike, whose feet end 2 m to the sides alone and 0.5 m together."""

    def track(end_m, heading_deg):
        truth_m = np.array([[0.0, 0.0], [76.0, 0.0]])
        turned_rad = np.radians([0.5 * heading_deg, heading_deg])
        return FootTrack(truth_m + np.array([[0.0, 0.0], end_m]), truth_m, np.array([4.0, 60.0]), turned_rad)

    walks = []
    for errors, sign in (("mirrored", -1.0), ("alike", 1.0)):
        for seed, own_m in enumerate((-0.1, 0.1)):
            alone = {"left": track([0.0, 2.0 + own_m], 3.0), "right": track([0.0, sign * 2.0 + own_m], sign * 3.0)}
            together = {"left": track([0.0, 0.5 + own_m], 0.5), "right": track([0.0, sign * 0.5], sign * 0.5)}
            walks.append(DualWalk(DualTrial("straight", 76.0, errors, seed), alone, together))
    return walks


def test_the_tables_of_both_feet_show_the_figures(dual_walks, capsys):
    dual_tables.show(dual_walks)
    shown = capsys.readouterr().out
    assert max(map(len, shown.splitlines())) <= 120
    cells = [line.split() for line in shown.splitlines()]
    assert ["straight,", "76", "m", "mirrored", "2", "2.00", "0.50", "0.25", "2.10", "0.60"] in cells
    assert ["mirrored", "left", "+2.00", "±", "0.14", "+0.50", "±", "0.14", "0.20"] in cells
    assert ["alike", "right", "+2.00", "±", "0.14", "+0.50", "±", "0.00", "0.00"] in cells


def test_the_page_of_both_feet_draws_tracks_ends_and_drift(dual_walks, tmp_path):
    dual_tables.write_files(tmp_path, dual_walks)
    assert set(dual_tables.FILES.split(", ")) == {path.name for path in tmp_path.iterdir()}
    page = (tmp_path / "dual.html").read_text()
    drawn = [json.loads(text) for text in re.findall(r'<script type="application/json">(.*?)</script>', page)]
    assert len(drawn) == 2 * 3
    plan, ends, drift = ({t["name"]: t for t in figure["data"]} for figure in drawn[:3])
    assert plan["left, alone"]["y"] == [0.0, 2.0]
    assert [t["showlegend"] for t in drawn[0]["data"] if t["name"] == "truth"] == [True, False]
    assert plan["truth"]["y"] == [0.0, 0.0]
    assert sorted(ends["right, alone"]["y"]) == pytest.approx([-2.1, -1.9])
    assert drift["left, alone"]["y"] == pytest.approx([1.5, 3.0])
    assert drift["direction, alone"]["y"] == pytest.approx([0.0, 0.0])  # mirrored errors cancel
    assert len(", ".join(drift)) < 100  # the legend is in one line, and ends before the buttons
    found = json.loads((tmp_path / "dual.json").read_text())
    assert found == json.loads(dual_tables.as_json(dual_walks))
    assert [row["ratio"] for row in found["rows"]] == pytest.approx([0.25, 0.25])

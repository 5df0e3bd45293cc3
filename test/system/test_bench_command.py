import json
import re
from dataclasses import replace

import numpy as np
import pytest

from pdr_bringup_scripts.qiu_tables import FILES, as_json, show, write_files
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


def test_the_length_of_a_stress_walk_cannot_be_chosen():
    check_refused(pdr("bench", "--stress", "--length", 5), "--stress", "leave out --length")


def test_qius_walks_are_those_of_the_paper(tmp_path):
    check_refused(pdr("bench", "--qiu", "--length", 5), "--qiu", "leave out --length")
    check_refused(pdr("bench", "--qiu", "--seeds", 5), "--qiu", "leave out --stress and --seeds")
    check_refused(pdr("bench", "--out", tmp_path / "page"), "--qiu", "leave out --out")
    assert not (tmp_path / "page").exists()


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

"""`pdr compare`, as it is typed."""

import csv
import json

import pytest

from support.processes import check_refused, pdr
from support.walks import straight_walk, write_csv

TWO_FEET = """name: two
time: {column: t, unit: ns}
sensors:
  left:
    gyro: {columns: [none, none, none], unit: rad/s}
    accel: {columns: [ax, ay, az], unit: m/s^2}
  right:
    gyro: {columns: [wx, wy, wz], unit: rad/s}
    accel: {columns: [ax, ay, az], unit: m/s^2}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two simulated walks, and a file that is none."""
    folder = tmp_path_factory.mktemp("compare")
    for seed in (1, 2):
        run = pdr("simulate", "--length", 12, "--rate", 100, "--seed", seed, "--out", folder / f"walk{seed}.csv")
        assert run.returncode == 0, run.stderr
    (folder / "broken.csv").write_text("this is no recording\n")
    return folder


@pytest.fixture(scope="module")
def figures(all_of_them, folder):  # noqa: ARG001
    return json.loads((folder / "out" / "compare.json").read_text())["figures"]


@pytest.fixture(scope="module")
def all_of_them(folder):
    walks = [folder / f"walk{seed}.csv" for seed in (1, 2)]
    run = pdr("compare", "--detectors", "all", *walks, "--out", folder / "out", cwd=folder)
    assert run.returncode == 0, run.stderr
    return run


def test_a_row_for_each_recording_and_detector(all_of_them):
    rows = [line.split() for line in all_of_them.stdout.splitlines()]
    found = {(row[0], row[1]) for row in rows if len(row) == 6 and row[0] in ("walk1", "walk2")}
    assert {detector for _, detector in found} >= {"adaptive", "glrt", "three_conditions"}
    assert len(found) == 14
    assert "\x1b" not in all_of_them.stdout
    assert "…" not in all_of_them.stdout
    for text in ("Over all recordings", "median m", "switched off", "rolling contact"):
        assert text in all_of_them.stdout


def test_page_and_figures_are_written(all_of_them, figures, folder):
    assert all_of_them.stderr.endswith(f"Written to {folder / 'out'}: compare.html, compare.csv, compare.json\n")
    with (folder / "out" / "compare.csv").open() as file:
        assert len(list(csv.DictReader(file))) == len(figures) == 14
    page = (folder / "out" / "compare.html").read_text()
    assert page.count('<script type="application/json">') == 4
    assert 4_000_000 < len(page) < 8_000_000


def test_the_default_comes_out_as_in_a_run(figures, folder):
    run = json.loads(pdr("run", folder / "walk1.csv", "--json").stdout)
    (row,) = (row for row in figures if (row["recording"], row["detector"]) == ("walk1", "adaptive"))
    assert (row["ate2_m"], row["ate3_m"]) == (run["truth"]["ate2_m"], run["truth"]["ate3_m"])
    assert row["strides"] == run["strides"]


def test_a_broken_file_does_not_lose_the_others(folder):
    names = ("broken.csv", "walk1.csv", "gone.mcap")
    run = pdr("compare", "--detectors", "glrt", "--time-gates", "none,kmeans", "--json", *names, cwd=folder)
    assert run.returncode == 2
    told = run.stderr.splitlines()[-2:]  # a slow machine tells before how far it is
    assert [line.startswith("pdr: ") for line in told] == [True, True]
    assert ["broken.csv" in told[0], "gone.mcap" in told[1]] == [True, True]
    found = json.loads(run.stdout)["figures"]
    assert [(row["recording"], row["gate"]) for row in found] == [("walk1", "none"), ("walk1", "kmeans")]


@pytest.mark.parametrize("option", ["--detectors", "--time-gates", "--orientations"])
def test_an_unknown_name_is_one_sentence(folder, option):
    check_refused(pdr("compare", option, "magic", "walk1.csv", cwd=folder), f"{option} magic", "choose from all, ")


def test_nothing_that_can_be_read_is_one_sentence(folder):
    check_refused(pdr("compare", "broken.csv", cwd=folder), "broken.csv")


def test_what_could_not_be_read_is_a_warning(folder, tmp_path):
    assert pdr("convert", folder / "walk1.csv", tmp_path / "whole.mcap").returncode == 0
    whole = (tmp_path / "whole.mcap").read_bytes()
    (tmp_path / "cut.mcap").write_bytes(whole[: len(whole) // 2])
    run = pdr("compare", "--detectors", "glrt", tmp_path / "cut.mcap")
    assert run.returncode == 0
    assert run.stderr.startswith("Warning: cut: cut.mcap is damaged: ")
    assert "glrt" in run.stdout


def test_a_foot_without_samples_loses_neither_the_other_nor_the_warnings(tmp_path):
    rows = write_csv(tmp_path / "feet.csv", straight_walk(3).imu).read_text().splitlines()
    rows = [f"{rows[0]},none", *(f"{row},nan" for row in rows[1:]), "cut"]
    (tmp_path / "feet.csv").write_text("\n".join(rows) + "\n")
    (tmp_path / "feet.yaml").write_text(TWO_FEET)
    run = pdr("compare", "--detectors", "glrt", "--json", tmp_path / "feet.csv")
    assert [row["recording"] for row in json.loads(run.stdout)["figures"]] == ["feet right"]
    warning, problem = run.stderr.splitlines()
    assert warning.startswith("Warning: feet: ")
    assert problem.startswith("pdr: feet left holds no usable sample")


def test_without_truth_there_is_no_table_of_names(folder, tmp_path):
    walk = write_csv(tmp_path / "unknown.csv", straight_walk(3).imu)
    run = pdr("compare", "--detectors", "glrt", walk, folder / "walk1.csv", "--json")
    found = json.loads(run.stdout)
    assert [row["truth"] for row in found["figures"]] == ["none", "position"]
    assert found["ablation"][0]["recordings"] == 1
    run = pdr("compare", "--detectors", "glrt", walk, walk, "--out", tmp_path / "out")
    assert run.returncode == 0, run.stderr
    assert "closure 2-D m" in run.stdout
    assert "Over all" not in run.stdout
    assert "switched off" not in run.stdout


def test_recordings_of_the_same_name_keep_their_folders(folder, tmp_path):
    (tmp_path / "walk1.csv").write_bytes((folder / "walk1.csv").read_bytes())
    for companion in folder.glob("walk1*"):
        (tmp_path / companion.name).write_bytes(companion.read_bytes())
    paths = [folder / "walk1.csv", tmp_path / "walk1.csv"]
    run = pdr("compare", "--detectors", "glrt", *paths)
    assert run.returncode == 0, run.stderr
    assert all(str(path) in run.stdout for path in paths)


def test_methods_of_orientation_are_compared_instead(folder, tmp_path):
    run = pdr("compare", "--orientations", "all", folder / "walk1.csv", "--out", tmp_path / "out")
    assert run.returncode == 0, run.stderr
    rows = [line.split() for line in run.stdout.splitlines()]
    methods = ["error_state", "quaternion_ekf", "gradient_descent", "complementary"]
    assert [row[1] for row in rows if row[:1] == ["walk1"]] == methods
    told = run.stderr.splitlines()[-2:]  # a slow machine tells before how far it is
    assert told[0].startswith("walk1, factored_quaternion: factored quaternions need a magnetometer")
    assert told[1] == f"Written to {tmp_path / 'out'}: orientations.html, orientations.json"
    (found,) = json.loads((tmp_path / "out" / "orientations.json").read_text())
    assert list(found["scores"]) == methods
    assert "Plotly" in (tmp_path / "out" / "orientations.html").read_text()

"""`pdr simulate`, `pdr convert` and `pdr evaluate`, as they are typed."""

import json
import re

import pytest

from support.processes import check_refused, pdr
from support.walks import straight_walk, walk_with_dips, write_csv


def done(*arguments, **options):
    answer = pdr(*arguments, **options)
    assert answer.returncode == 0, answer.stderr
    return answer


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A simulated walk, the same as CSV, and what `pdr run` makes of both."""
    folder = tmp_path_factory.mktemp("files")
    walk = ("simulate", "--walk", "straight", "--length", 3, "--rate", 100, "--seed", 5)
    for name in ("walk", "walk.csv"):
        done(*walk, "--out", folder / name)
        done("run", folder / name, "--out", folder / f"result of {name}")
    return folder


def test_a_simulated_walk_is_the_same_in_both_formats(folder):
    bag, text = (folder / f"result of {name}" / "trajectory.tum" for name in ("walk", "walk.csv"))
    assert bag.read_bytes() == text.read_bytes()
    assert bag.read_text().count("\n") > 800


def test_its_truth_went_along(folder):
    for name in ("walk", "walk.csv"):
        truth = json.loads((folder / f"result of {name}" / "result.json").read_text())["truth"]
        assert truth["kind"] == "position"
        assert 0.0 < truth["ate2_m"] < 0.1


def test_the_same_seed_is_the_same_walk_and_another_is_another(folder, tmp_path):
    walk = ("simulate", "--walk", "straight", "--length", 3, "--rate", 100)
    for seed in (5, 6):
        done(*walk, "--seed", seed, "--out", tmp_path / f"{seed}.csv")
    assert (tmp_path / "5.csv").read_bytes() == (folder / "walk.csv").read_bytes()
    assert (tmp_path / "6.csv").read_bytes() != (folder / "walk.csv").read_bytes()


def test_both_feet_are_written_and_read(tmp_path):
    both = ("simulate", "--feet", "--walk", "corridor", "--length", 20, "--rate", 100)
    done(*both, "--out", tmp_path / "feet")
    said = done("run", tmp_path / "feet", "--out", tmp_path / "result").stdout
    assert f"Written to {tmp_path / 'result'}: result.json; in left, right: trajectory.tum, strides.csv" in said
    assert "in body: trajectory.tum, result.json, report.html\n" in said
    assert sorted(path.name for path in (tmp_path / "result").iterdir()) == ["body", "left", "result.json", "right"]
    assert not (tmp_path / "result" / "body" / "strides.csv").exists()
    for foot in ("left", "right"):
        found = json.loads((tmp_path / "result" / foot / "result.json").read_text())
        assert found["truth"]["kind"] == "position"
        assert 0.0 < found["truth"]["ate2_m"] < 0.2
    refused = pdr(*both, "--out", tmp_path / "feet.csv")
    check_refused(refused, "a CSV file holds one sensor; choose from left, right, or write a bag")
    check_refused(pdr(*both, "--motion", "gui", "--out", tmp_path / "gui"), "both feet move smoothly")


def test_a_parameter_that_is_not_allowed_is_refused(tmp_path):
    answer = pdr("simulate", "--rate", 5, "--out", tmp_path / "walk")
    assert (answer.returncode, answer.stdout) == (2, "")
    assert "sample_rate_hz = 5.0: must be float, within 20" in answer.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_users_csv_runs_alike_before_and_after(tmp_path):
    own = write_csv(tmp_path / "own.csv", straight_walk(2).imu)
    columns = own.with_suffix(".yaml").rename(tmp_path / "columns of mine.yml")
    done("run", own, "--columns", columns, "--out", tmp_path / "before")
    said = done("convert", own, tmp_path / "bag", "--columns", columns).stdout
    assert said == f"Written to {tmp_path / 'bag'}: 900 samples of imu, 9.0 s.\n"
    done("run", tmp_path / "bag", "--out", tmp_path / "after")
    before, after = (tmp_path / name / "trajectory.tum" for name in ("before", "after"))
    assert before.read_bytes() == after.read_bytes()


def test_a_recording_is_written_at_a_lower_rate(folder, tmp_path):
    answer = done("convert", folder / "walk", tmp_path / "slow", "--rate", 45)
    assert "imu: 50.0 of 100.0 Hz, one sample in 2.\n" in answer.stderr
    whole, slow = (json.loads(done("run", walk, "--json").stdout) for walk in (folder / "walk", tmp_path / "slow"))
    assert whole["samples"] == 2 * slow["samples"]
    assert slow["strides"] == whole["strides"]
    assert slow["truth"]["ate2_m"] < 0.02
    check_refused(pdr("convert", folder / "walk", tmp_path / "no", "--rate", 90), "imu has 100.0 Hz: give a --rate of")


def test_another_detector_and_a_gate_are_named_on_the_command_line(folder, tmp_path):
    for name, gate in (("mbgtd", "kmeans"), ("three_conditions", "gait_phases")):
        done("run", folder / "walk", "--detector", name, "--time-gate", gate, "--out", tmp_path / name)
        stance = json.loads((tmp_path / name / "result.json").read_text())["config"]["stance"]
        assert (stance["detector"], stance["time_gate"]) == (name, gate)
    usual, other = (f / "trajectory.tum" for f in (folder / "result of walk", tmp_path / "mbgtd"))
    assert usual.read_bytes() != other.read_bytes()


@pytest.mark.parametrize("smooth", [(), ("--smooth",)])
def test_a_first_pass_tells_the_time_gate_what_it_would_learn_too_late(tmp_path, smooth):
    walk, tracks = write_csv(tmp_path / "dips.csv", walk_with_dips(12)[0]), {}
    params = tmp_path / "no clips.yaml"
    params.write_text("/**: {ros__parameters: {intake: {clip_smallest_radps: 1000000.0}}}\n")
    common = ("--params", params, "--json")
    for gate in ("kmeans", "kmeans_offline"):
        run = done("run", walk, "--time-gate", gate, *smooth, *common, "--out", tmp_path / gate)
        result = json.loads(run.stdout)
        assert (result["two_passes"], result["smoothed"]) == (gate == "kmeans_offline", bool(smooth))
        assert result["config"]["stance"]["time_gate"] == "kmeans"
        tracks[gate] = (tmp_path / gate / "trajectory.tum").read_bytes()
    assert tracks["kmeans"] != tracks["kmeans_offline"]


@pytest.mark.parametrize(
    ("option", "known"),
    [
        ("--detector", "one of adaptive, glrt, .*, three_conditions"),
        ("--time-gate", "choose from none, gait_phases, kmeans, kmeans_offline"),
    ],
)
def test_an_unknown_name_is_answered_with_the_known_ones(option, known, folder):
    answer = pdr("run", folder / "walk", option, "shoe")
    check_refused(answer, "shoe")
    assert re.search(known, answer.stderr)


def test_level_ground_is_an_option_and_a_parameter(folder, tmp_path):
    (tmp_path / "level.yaml").write_text("/**: {ros__parameters: {filter: {level_ground: true}}}\n")
    done("run", folder / "walk", "--level-ground", "--out", tmp_path / "option")
    done("run", folder / "walk", "--params", tmp_path / "level.yaml", "--out", tmp_path / "file")
    option, file, without = (
        (where / "trajectory.tum").read_bytes()
        for where in (tmp_path / "option", tmp_path / "file", folder / "result of walk")
    )
    assert option == file != without


def test_what_exists_stays_unless_force_is_given(folder, tmp_path):
    done("convert", folder / "walk", tmp_path / "copy.mcap")
    answer = pdr("convert", folder / "walk", tmp_path / "copy.mcap")
    assert (answer.returncode, answer.stdout) == (2, "")
    assert "exists already: choose another name, or replace it with --force" in answer.stderr
    done("convert", folder / "walk", tmp_path / "copy.mcap", "--force")
    assert [p.name for p in tmp_path.iterdir()] == ["copy.mcap"]


@pytest.mark.parametrize("name", ["walk", "simulated", "walk.csv"])
def test_a_simulated_walk_is_replaced_by_force_only(name, tmp_path):
    walk = ("simulate", "--walk", "straight", "--length", 1.2, "--rate", 50, "--out", name)
    done(*walk, cwd=tmp_path)
    check_refused(pdr(*walk, cwd=tmp_path), "exists already: choose another name, or replace it with --force")
    done(*walk, "--force", cwd=tmp_path)


def test_a_walk_shorter_than_a_stride_is_refused(tmp_path):
    answer = pdr("simulate", "--length", 1.1, "--out", tmp_path / "walk")
    assert (answer.returncode, "--length" in answer.stderr) == (2, True)
    assert list(tmp_path.iterdir()) == []


def test_no_file_goes_into_the_recording(folder):
    before = sorted((folder / "walk").iterdir())
    check_refused(pdr("run", "walk", "--out", folder / "walk", cwd=folder), "is the recording itself", "--out")
    assert sorted((folder / "walk").iterdir()) == before


def test_a_page_does_not_replace_the_trajectory(folder):
    trajectory = folder / "result of walk" / "trajectory.tum"
    before = trajectory.read_bytes()
    check_refused(pdr("evaluate", trajectory, folder / "walk", "--report", trajectory), "--report", ".html")
    assert trajectory.read_bytes() == before


@pytest.mark.parametrize("value", ["inf", "1e300"])
def test_an_endless_difference_is_refused(value, folder):
    trajectory = folder / "result of walk" / "trajectory.tum"
    check_refused(pdr("evaluate", trajectory, folder / "walk", "--max-difference", value), "--max-difference", "finite")


@pytest.mark.parametrize("value", ["nan", "-1"])
def test_a_difference_below_zero_or_none_is_refused(value, folder):
    trajectory = folder / "result of walk" / "trajectory.tum"
    answer = pdr("evaluate", trajectory, folder / "walk", "--max-difference", value)
    assert (answer.returncode, answer.stdout) == (2, "")
    assert "--max-difference" in answer.stderr
    assert "Traceback" not in answer.stderr


def test_what_could_not_be_read_is_a_warning(folder, tmp_path):
    done("convert", folder / "walk", tmp_path / "whole.mcap")
    whole = (tmp_path / "whole.mcap").read_bytes()
    (tmp_path / "cut.mcap").write_bytes(whole[: len(whole) // 2])
    answer = done("convert", tmp_path / "cut.mcap", tmp_path / "saved")
    assert answer.stderr.startswith("Warning: cut.mcap is damaged: ")
    done("run", tmp_path / "saved")


def test_a_trajectory_is_compared_with_the_truth_of_its_recording(folder, tmp_path):
    trajectory, result = (folder / "result of walk" / name for name in ("trajectory.tum", "result.json"))
    page = tmp_path / "page.html"
    measured = json.loads(done("evaluate", trajectory, folder / "walk", "--json", "--measured").stdout)
    assert measured["ate2_m"] == pytest.approx(json.loads(result.read_text())["truth"]["ate2_m"], abs=1e-9)
    found = json.loads(done("evaluate", trajectory, folder / "walk", "--json", "--report", page).stdout)
    assert 0.0 < found["ate_rigid"]["rmse_m"] < found["ate3_m"] < 0.2
    assert found == json.loads(
        done("evaluate", trajectory, folder / "walk_truth.csv", "--json", "--interpolate").stdout
    )
    assert page.stat().st_size > 1000
    said = done("evaluate", trajectory, folder / "walk").stdout
    assert f"ATE2 {found['ate2_m']:.4f} m" in said
    assert f"ATE  {found['ate_rigid']['rmse_m']:.4f} m" in said


def test_tracks_of_different_times_are_one_sentence(folder, tmp_path):
    other = tmp_path / "other.tum"
    other.write_text("".join(f"{t} 0 0 0 0 0 0 1\n" for t in range(10_000, 10_010)))
    answer = pdr("evaluate", other, folder / "walk")
    assert (answer.returncode, answer.stdout) == (2, "")
    assert "only 0 pairs of positions at the same time: check that both count from the same moment" in answer.stderr
    assert answer.stderr.count("\n") == 1

"""`pdr calibrate mounting`, as it is typed, and what `pdr run` makes of its file."""

import json

import numpy as np
import pytest
from typer import Typer
from typer.testing import CliRunner

from pdr_bringup_scripts.commands.calibrate_mounting import mounting
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.run_choice import estimated
from pdr_bringup_scripts.run.run_options import RunOptions
from pdr_core.params import SimulationParams
from pdr_core.params_file import load_params
from pdr_core.recording import open_recording
from pdr_core.simulation import simulated_walk
from support.walks import still, write_csv

MOUNTED = {"mounting_roll_rad": 2.9, "mounting_pitch_rad": -0.6, "mounting_yaw_rad": 2.7}
GIVEN = "/**:\n  ros__parameters:\n    intake: {gyro_range_radps: 20.0}\n    filter: {level_ground: true}\n"


def typed(*arguments):
    app = Typer()
    app.command()(mounting)
    answer = CliRunner().invoke(app, [str(argument) for argument in arguments])
    if answer.exception and not isinstance(answer.exception, SystemExit):
        raise answer.exception
    return answer


@pytest.fixture(scope="module")
def walk(tmp_path_factory):
    params = SimulationParams(motion="smooth", walk="straight", walk_length_m=20.0, **MOUNTED)
    return write_csv(tmp_path_factory.mktemp("mounting") / "walk.csv", simulated_walk(params).imu)


def test_after_it_the_foot_looks_where_it_walks(walk, tmp_path):
    answer = typed(walk, "--out", tmp_path / "mounting.yaml")
    assert answer.exit_code == 0
    assert "14 straight strides" in answer.stdout
    assert f"--params {tmp_path / 'mounting.yaml'}" in answer.stdout
    params = load_params(tmp_path / "mounting.yaml")
    result = estimated(open_recording(walk), params, RunOptions(tmp_path / "out"))
    rows = np.genfromtxt(tmp_path / "out" / "strides.csv", delimiter=",", names=True)
    assert np.abs(rows["heading_rad"][1:]).max() < 0.05  # without the file it is any angle
    assert np.abs(rows["y_m"]).max() < 0.2
    turned = result.gait.mounting.quat_xyzw
    assert 2.0 * np.arccos(abs(turned[3])) < np.radians(1.0)


def test_what_the_given_file_says_is_kept(walk, tmp_path):
    (tmp_path / "given.yaml").write_text(GIVEN)
    typed(walk, "--out", tmp_path / "m.yaml", "--params", tmp_path / "given.yaml")
    params = load_params(tmp_path / "m.yaml")
    assert (params.intake.gyro_range_radps, params.filter.level_ground) == (20.0, True)
    first = params.intake.mounting_pitch_rad
    typed(walk, "--out", tmp_path / "again.yaml", "--params", tmp_path / "m.yaml")
    assert load_params(tmp_path / "again.yaml").intake.mounting_pitch_rad == pytest.approx(first, abs=0.01)


def test_json_and_page(walk, tmp_path):
    answer = typed(walk, "--out", tmp_path / "m.yaml", "--report", tmp_path / "m.html", "--json")
    found = json.loads(answer.stdout)
    assert [found[name] for name in MOUNTED] == pytest.approx(list(MOUNTED.values()), abs=0.02)
    assert found["walking_yaw_rad"] is None
    assert "Installation alignment" in (tmp_path / "m.html").read_text(encoding="utf-8")


def test_a_rest_tells_nothing_and_writes_nothing(tmp_path):
    rest = write_csv(tmp_path / "rest.csv", still(10.0, 0))
    with pytest.raises(Problem, match=r"0 straight strides were found.*ten strides straight ahead"):
        typed(rest, "--out", tmp_path / "m.yaml")
    assert not (tmp_path / "m.yaml").exists()

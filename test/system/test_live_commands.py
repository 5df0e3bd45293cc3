import json

import pytest

from support.processes import check_refused, pdr
from support.walks import COLUMNS, straight_walk, write_csv

WALK = {"recording", "format", "samples", "duration_s", "rate_hz", "pipeline", "smoothed", "two_passes"}
CLOSURE = {"strides", "distance_m", "end_position_m", "closure_2d_m", "closure_3d_m"}
KEYS = {*WALK, *CLOSURE, "gait", "seconds", "notices", "config", "truth", "version", "commit"}
COMMANDS = ("demo", "test", "live", "record", "run", "replay", "simulate", "convert", "evaluate", "params")
TWO_FEET = """name: two
time: {column: t, unit: ns}
sensors:
  left: &foot
    gyro: {columns: [wx, wy, wz], unit: rad/s}
    accel: {columns: [ax, ay, az], unit: m/s^2}
  right: *foot
"""


@pytest.fixture(scope="module")
def walk(tmp_path_factory):
    return write_csv(tmp_path_factory.mktemp("one") / "walk.csv", straight_walk(2).imu)


@pytest.fixture(scope="module")
def two_feet(tmp_path_factory):
    path = write_csv(tmp_path_factory.mktemp("two") / "walk.csv", straight_walk(2).imu)
    path.with_suffix(".yaml").write_text(TWO_FEET)
    return path


def only_json(answer):
    """The one JSON object that stdout holds, and nothing else."""
    assert answer.returncode == 0, answer.stderr
    return json.loads(answer.stdout, parse_constant=pytest.fail)


def test_json_is_one_object_with_the_keys_that_are_promised(walk, tmp_path):
    result = only_json(pdr("run", walk, "--json", "--out", tmp_path / "out"))
    assert set(result) == KEYS
    assert (result["format"], result["samples"], result["strides"], result["truth"]) == ("test", 900, 2, None)
    assert result == json.loads((tmp_path / "out" / "result.json").read_text())


def test_several_sensors_come_together_or_one_by_name(two_feet, tmp_path):
    both = only_json(pdr("run", two_feet, "--json", "--out", tmp_path / "out"))
    assert sorted(both) == ["body", "format", "recording", "sensors"]
    assert sorted(both["sensors"]) == ["left", "right"]
    assert set(both["body"]) == KEYS
    for folder in ("left", "right", "body"):
        assert (tmp_path / "out" / folder / "trajectory.tum").exists()
        assert (tmp_path / "out" / folder / "report.html").exists()
    one = only_json(pdr("run", two_feet, "--json", "--sensor", "right"))
    assert set(one) == KEYS
    assert one["end_position_m"] == both["sensors"]["right"]["end_position_m"]


def test_feet_are_named_or_found_by_their_names(two_feet):
    named = only_json(pdr("run", two_feet, "--json", "--feet", "right,left"))
    assert list(named["sensors"]) == ["right", "left"]
    for wrong in ("left", "left,left", "left,middle"):
        check_refused(pdr("run", two_feet, "--feet", wrong))
    check_refused(pdr("run", two_feet, "--feet", "left,right", "--smooth"), "--feet", "--smooth")
    assert "body" not in only_json(pdr("run", two_feet, "--json", "--smooth"))


def test_people_get_sentences(walk, tmp_path):
    answer = pdr("run", walk, "--out", tmp_path / "out")
    assert answer.stdout.startswith("Walked 2.")
    assert "in 2 strides" in answer.stdout
    assert str(tmp_path / "out") in answer.stdout
    assert answer.stderr == ""


def bad_file(folder, name, text):
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize("command", ["run", "replay"])
def test_a_missing_file_is_refused(command, tmp_path):
    check_refused(pdr(command, tmp_path / "no.csv", cwd=tmp_path), "no.csv", "does not exist")


@pytest.mark.parametrize("command", ["demo", "live", "replay"])
def test_the_recording_of_another_run_stays(command, walk, tmp_path):
    (tmp_path / "out" / "recording").mkdir(parents=True)
    given = [walk] if command == "replay" else []
    check_refused(pdr(command, *given, "--out", tmp_path / "out"), "recording exists already", "--out")
    assert not (tmp_path / "out" / "nodes").exists()


def test_a_missing_parameter_file_is_refused(walk, tmp_path):
    check_refused(pdr("run", walk, "--params", tmp_path / "no.yaml"), "no.yaml does not exist: check the path")


def test_an_unknown_sensor_is_refused(two_feet, tmp_path):
    check_refused(pdr("run", two_feet, "--sensor", "middle"), "middle", "left, right")
    out = tmp_path / "out"
    check_refused(pdr("replay", two_feet, "--sensor", "middle", "--out", out), "left, right")
    check_refused(pdr("replay", two_feet, "--feet", "left,middle", "--out", out), "left, right")


def test_two_sensors_are_feet_only_where_they_are_called_so(tmp_path):
    path = write_csv(tmp_path / "walk.csv", straight_walk(2).imu)
    path.with_suffix(".yaml").write_text(TWO_FEET.replace("left", "hand").replace("right", "belt"))
    check_refused(pdr("replay", path, "--out", tmp_path / "out"), "hand, belt", "--sensor")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("/**: {ros__parameters: {filter: {gate: 0.5}}}", ("filter.gate = 0.5", "within 1 ..")),
        ("/**: {ros__parameters: {filter: {gates: 5}}}", ("filter.gates", "unknown")),
        ("filter: {gate: 5.0}", ("ros__parameters",)),
        ("a: [", ("cannot be read as YAML",)),
    ],
)
def test_a_bad_parameter_file_is_refused(walk, tmp_path, text, words):
    params = bad_file(tmp_path, "mine.yaml", text)
    check_refused(pdr("run", walk, "--params", params), *words)


@pytest.mark.parametrize("command", ["run", "replay"])
def test_a_folder_that_cannot_be_written_is_refused(command, walk, tmp_path):
    blocked = bad_file(tmp_path, "file", "not a folder") / "out"
    check_refused(pdr(command, walk, "--out", blocked), "cannot write to", str(blocked))
    check_refused(pdr(command, walk, "--out", blocked.parent), "it is a file, and a folder is needed")


@pytest.mark.parametrize("text", ["", COLUMNS + "\n"])
def test_an_empty_recording_is_refused(tmp_path, text):
    path = bad_file(tmp_path, "walk.csv", text)
    check_refused(pdr("run", path), "walk.csv")


@pytest.mark.parametrize("command", COMMANDS)
def test_help_shows_an_example(command):
    answer = pdr(command, "--help", COLUMNS="200")
    assert answer.returncode == 0
    assert f"Example: pdr {command}" in answer.stdout.replace("`", "")

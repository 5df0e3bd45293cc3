import numpy as np
import pytest
import yaml
from small_bags import imu_messages, write_bag

from pdr_core.recording import RecordingError, open_recording
from pdr_core.recording.column_map_yaml import column_map_from_text, known_maps

HEADER = "t,wx,wy,wz,ax,ay,az\n"


def document(**changes):
    vectors = {
        "gyro": {"columns": ["wx", "wy", "wz"], "unit": "deg/s"},
        "accel": {"columns": ["ax", "ay", "az"], "unit": "g"},
    }
    return {"name": "mine", "time": {"column": "t", "unit": "ms"}, "sensors": {"foot": vectors}} | changes


def with_vector(**changes):
    whole = document()
    whole["sensors"]["foot"]["gyro"] |= changes
    return whole


def with_mag(**mag):
    whole = document()
    whole["sensors"]["foot"]["mag"] = mag
    return whole


def with_truth(**truth):
    whole = document()
    whole["sensors"]["foot"]["truth"] = truth
    return whole


def write(path, whole):
    path.write_text(yaml.safe_dump(whole))
    return path


def walk(folder, name="walk.csv"):
    (folder / name).write_text(HEADER + "1,1,2,3,4,5,6\n2,1,2,3,4,5,6\n")
    return folder / name


@pytest.mark.parametrize(
    ("whole", "message"),
    [
        (document(tiem=1), "m.yaml has the unknown key 'tiem'; allowed are header_rows, match, name, sensors, time"),
        (document(time={"column": "t", "unit": "min"}), "m.yaml: time.unit is 'min'; allowed are ms, ns, s, us"),
        (document(time={"column": "t", "units": "s"}), "time has the unknown key 'units'; allowed are column, rate_hz"),
        (document(time={"column": "t"}), "time needs column and unit, or rate_hz"),
        (document(time={"column": "t", "unit": "s", "rate_hz": 5}), "time needs column and unit, or rate_hz"),
        (document(time={"unit": "s"}), "time needs column and unit, or rate_hz"),
        (document(time={"rate_hz": 0}), "rate_hz is '0'; it must be a positive number"),
        (document(time={"rate_hz": "fast"}), "rate_hz is 'fast'; it must be a positive number"),
        (document(time=5), "time must be a section with the keys column, rate_hz, unit"),
        (document(header_rows=7), "header_rows is '7'; allowed are 0, 1, 2"),
        (document(match="t"), "match is 't'; it must be a list of at least one"),
        (document(sensors={}), "sensors must hold at least one sensor"),
        (
            document(sensors={"foot": {"gyro": {}}}),
            "sensors.foot lacks the key 'accel'; allowed are accel, gyro",
        ),
        (with_mag(columns=["a", "b", "c"], unit="gauss"), "foot.mag.unit is 'gauss'; allowed are G, T, mG, nT, uT"),
        (with_mag(columns=["a", "b"], unit="G"), r"foot.mag.columns is '\['a', 'b'\]'; it must be a list of 3"),
        (with_vector(unit="rpm"), "sensors.foot.gyro.unit is 'rpm'; allowed are deg/s, rad/s"),
        (with_vector(unit=["g"]), r"sensors.foot.gyro.unit is '\['g'\]'; allowed are deg/s, rad/s"),
        (with_vector(columns=["wx"]), r"gyro.columns is '\['wx'\]'; it must be a list of 3"),
        (with_vector(columns="wx"), "gyro.columns is 'wx'; it must be a list of 3"),
        (with_truth(kind="gps"), "truth.kind is 'gps'; allowed are closed_loop, position, strides"),
        (with_truth(kind="closed_loop", unit="m"), "truth has the unknown key 'unit'; allowed are kind, stems"),
        (with_truth(kind="position", points=[["x", "y", "z"]]), "truth lacks the key 'unit'"),
        (with_truth(kind="position", points=[["x", "y"]], unit="m"), "truth.points is .* a list of 3"),
        (with_truth(kind="position", points=3, unit="m"), "truth.points is '3'; it must be a list"),
        (with_truth(kind="strides", points=[["x", "y"]], unit="km"), "truth.unit is 'km'; allowed are m, mm"),
        (
            with_truth(kind="strides", points=[["x", "y"]], unit="m", signs=[1, 2]),
            "truth.signs is '2'; allowed are -1",
        ),
        (with_truth(kind="position", points=[["x", "y", "z"]], unit="m", file="f"), "needs file and time together"),
        (["list"], "m.yaml must be a section"),
        (None, "m.yaml must be a section"),
    ],
)
def test_what_is_wrong_in_a_map_is_named(whole, message):
    with pytest.raises(RecordingError, match=message):
        column_map_from_text(yaml.safe_dump(whole), "m.yaml")


def test_a_map_that_is_no_yaml_is_an_error():
    with pytest.raises(RecordingError, match=r"m\.yaml is not YAML"):
        column_map_from_text("time: [", "m.yaml")


def test_the_known_maps_are_named_after_their_files():
    assert [m.name for m in known_maps()] == [
        "gaitmap_dual_foot",
        "pyshoe_vicon",
        "ros1_foot_imu",
        "tile_walks_compensated",
        "tile_walks_marg",
        "xio_ngimu",
        "xio_ximu_marg",
    ]


def test_the_map_may_be_given_or_lie_beside_the_recording(tmp_path):
    path = walk(tmp_path)
    write(tmp_path / "pdr_columns.yaml", document(name="of the folder"))
    assert open_recording(path).format == "of the folder"
    write(tmp_path / "walk.yaml", document(name="of the walk"))
    assert open_recording(path).format == "of the walk"
    given = write(tmp_path / "elsewhere.yaml", document(name="given"))
    assert open_recording(path, column_map=given).format == "given"
    assert list(open_recording(path).sensors) == ["foot"]


def test_a_map_that_does_not_fit_names_the_column_and_those_there_are(tmp_path):
    given = write(tmp_path / "m.yaml", with_vector(columns=["gx", "wy", "wz"]))
    with pytest.raises(RecordingError, match="no columns match 'gx' of 't', 'wx', 'wy'"):
        open_recording(walk(tmp_path), given)
    given = write(tmp_path / "m.yaml", with_vector(columns=["w*", "wy", "wz"]))
    with pytest.raises(RecordingError, match="3 columns match"):
        open_recording(walk(tmp_path), given)


def test_a_missing_map_is_an_error(tmp_path):
    for path in (walk(tmp_path), write_bag(tmp_path / "bag", imu_messages(2), "mcap")):  # a bag needs none
        with pytest.raises(RecordingError, match=r"column map .*none.yaml cannot be read"):
            open_recording(path, tmp_path / "none.yaml")


def test_columns_without_a_header_go_by_number(tmp_path):
    (tmp_path / "walk.csv").write_text("1,1,2,3,4,5,6\n2,1,2,3,4,5,6\n")
    whole = document(header_rows=0, time={"column": "0", "unit": "s"})
    whole["sensors"]["foot"]["gyro"]["columns"] = ["1", "2", "3"]
    whole["sensors"]["foot"]["accel"] = {"columns": [4, 5, 6], "unit": "m/s^2"}
    write(tmp_path / "walk.yaml", whole)
    block = next(open_recording(tmp_path / "walk.csv").sensors["foot"].pieces())
    assert block.stamp_ns.tolist() == [10**9, 2 * 10**9]
    assert block.accel_mps2.tolist() == [[4, 5, 6]] * 2


def test_a_position_in_the_recording_itself_is_the_truth(tmp_path):
    whole = with_truth(kind="position", points=[["wx", "wy", "wz"], ["ax", "ay", "az"]], unit="mm", signs=[1, 1, -1])
    write(tmp_path / "walk.yaml", whole)
    truth = open_recording(walk(tmp_path)).sensors["foot"].truth
    assert truth.stamp_ns.tolist() == [1_000_000, 2_000_000]
    np.testing.assert_allclose(truth.position_m, [[2.5e-3, 3.5e-3, -4.5e-3]] * 2)

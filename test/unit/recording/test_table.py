import subprocess
import sys

import numpy as np
import pytest
from scipy.io import savemat

from pdr_core.recording import RecordingError, open_recording
from pdr_core.records import TruthKind, joined

G = 9.80665
NGIMU = (
    "Time (s),Gyroscope X (deg/s),Gyroscope Y (deg/s),Gyroscope Z (deg/s),"
    "Accelerometer X (g),Accelerometer Y (g),Accelerometer Z (g)\n"
)
OWN = """
name: mine
time: {column: t, unit: %s}
sensors:
  imu:
    gyro: {columns: ['*wx', '*wy', '*wz'], unit: rad/s}
    accel: {columns: [ax, ay, az], unit: m/s^2}
"""
OWN_HEADER = "t,s:wx,s:wy,s:wz,ax,ay,az\n"


def write(path, *lines):
    path.write_text("".join(line if line.endswith("\n") else line + "\n" for line in lines))
    return path


def samples(session, name="imu", max_samples=65536):
    return joined(list(session.sensors[name].pieces(max_samples)))


def own(tmp_path, *rows, unit="s", header=OWN_HEADER):
    (tmp_path / "walk.yaml").write_text(OWN % unit)
    return write(tmp_path / "walk.csv", header, *rows)


def test_a_known_format_is_found_by_its_header_and_turned_into_si(tmp_path):
    path = write(tmp_path / "walk.csv", NGIMU, "0,180,0,-90,0,0,1", "0.0025,0,0,0,2,0,0")
    session = open_recording(path)
    block = samples(session)
    assert (session.name, session.format) == ("walk", "xio_ngimu")
    assert block.stamp_ns.tolist() == [0, 2_500_000]
    np.testing.assert_allclose(block.gyro_radps, [[np.pi, 0, -np.pi / 2], [0, 0, 0]], rtol=1e-15)
    np.testing.assert_allclose(block.accel_mps2, [[0, 0, G], [2 * G, 0, 0]], rtol=1e-15)
    assert not block.gyro_sd_radps.any()
    assert session.sensors["imu"].truth is None


def test_only_the_published_walks_of_a_set_are_closed_loops(tmp_path):
    path = write(tmp_path / "short_walk.csv", NGIMU, "0,0,0,0,0,0,1")
    truth = open_recording(path).sensors["imu"].truth
    assert truth.kind is TruthKind.CLOSED_LOOP
    assert truth.position_m.shape == (0, 3)


@pytest.mark.parametrize(
    ("unit", "text", "stamp_ns"),
    [
        ("ns", "1584954936793327157", 1584954936793327157),
        ("us", "1584954936793327.157", 1584954936793327157),
        ("ms", "1584954936793.327157", 1584954936793327157),
        ("s", "1584954936.793327157", 1584954936793327157),
        ("s", "-1.5e-3", -1_500_000),
    ],
)
def test_stamps_are_exact_in_every_unit(tmp_path, unit, text, stamp_ns):
    block = samples(open_recording(own(tmp_path, f"{text},1,2,3,4,5,6", f"{text},1,2,x,4,5,6", unit=unit)))
    assert block.stamp_ns.dtype == np.int64
    assert block.stamp_ns.tolist() == [stamp_ns] * 2


def test_a_cell_without_a_number_is_nan_and_the_others_stay(tmp_path):
    rows = ["0,1,2,3,4,5,6", "1,,2,3,4,junk,6", "2,1,2,3", "3,nan,2,3,4,5,inf"]
    session = open_recording(own(tmp_path, *rows))
    block, nan = samples(session), np.nan
    assert block.stamp_ns.tolist() == [0, 10**9, 2 * 10**9, 3 * 10**9]
    np.testing.assert_array_equal(block.gyro_radps, [[1, 2, 3], [nan, 2, 3], [1, 2, 3], [nan, 2, 3]])
    np.testing.assert_array_equal(block.accel_mps2, [[4, 5, 6], [4, nan, 6], [nan, nan, nan], [4, 5, np.inf]])
    assert session.notices == []


def test_rows_without_a_time_are_left_out_and_counted_once(tmp_path):
    rows = ["0,1,2,3,4,5,6", "soon,1,2,3,4,5,6", "", "2,1,2,3,4,5,6", ",1,2,3,4,5,6", "1e99,1,2,3,4,5,6"]
    session = open_recording(own(tmp_path, *rows))
    for max_samples in (65536, 2, 1):
        assert samples(session, max_samples=max_samples).stamp_ns.tolist() == [0, 2 * 10**9]
    assert [(n.kind, n.count) for n in session.notices] == [("unreadable_time", 3)]


def test_duplicate_and_unordered_rows_stay_as_they_are(tmp_path):
    rows = [f"{t},1,2,3,4,5,6" for t in (1, 1, 0, 2)]
    assert samples(open_recording(own(tmp_path, *rows))).stamp_ns.tolist() == [10**9, 10**9, 0, 2 * 10**9]


def test_pieces_are_bounded_and_equal_the_whole(tmp_path):
    rows = [f"{t},{t},2,3,4,5,6" for t in range(25)]
    sensor = open_recording(own(tmp_path, *rows)).sensors["imu"]
    pieces = list(sensor.pieces(10))
    assert [len(p.stamp_ns) for p in pieces] == [10, 10, 5]
    assert joined(pieces).gyro_radps[:, 0].tolist() == list(range(25))


@pytest.mark.parametrize("delimiter", [";", "\t"])
def test_other_delimiters_quotes_and_a_byte_order_mark(tmp_path, delimiter):
    names = delimiter.join(f'"{name}"' for name in OWN_HEADER.strip().split(","))
    path = own(tmp_path, delimiter.join(['"0.5"', "1", "2", "3", "4", "5", "6"]), header="\ufeff" + names)
    block = samples(open_recording(path))
    assert block.stamp_ns.tolist() == [500_000_000]
    assert block.accel_mps2.tolist() == [[4, 5, 6]]


def test_rows_are_the_clock_of_the_x_imu(tmp_path):
    header = "Packet number," + NGIMU.split(",", 1)[1]
    rows = [f"{k},0,0,0,0,0,1" for k in (3, 5, 6, 8)]
    block = samples(open_recording(write(tmp_path / "walk.csv", header, *rows)), max_samples=3)
    assert block.stamp_ns.tolist() == [0, 3_906_250, 7_812_500, 11_718_750]


def test_rows_are_no_clock_where_the_x_imu_is_not_recognised(tmp_path):
    path = write(tmp_path / "walk.csv", "Time [s]," + NGIMU.split(",", 1)[1], "0,0,0,0,0,0,1")
    with pytest.raises(RecordingError, match="no known format"):
        open_recording(path)


def test_two_header_rows_two_feet_and_their_markers(tmp_path):
    axes = [f"{kind}_{axis}" for kind in ("acc", "gyr") for axis in "xyz"]
    header = "sensor," + ",".join(f"{f}_sensor" for _ in axes for f in ("left", "right"))
    rows = ["axis," + ",".join(a for a in axes for _ in "lr")]
    rows += [f"{i}," + ",".join(str(c) for c in range(12)) for i in (10, 11)]
    write(tmp_path / "imu_sample.csv", header, *rows)
    markers = [("L_TOE", 0), ("R_TOE", 100), ("L_FCC", 1000), ("R_FCC", 3000)]
    top = "," + ",".join(m for m, _ in markers for _ in "xyz")
    cells = ",".join(str(at + j) for _, at in markers for j in range(3))
    write(
        tmp_path / "mocap_sample.csv", top, "," + "x,y,z," * 3 + "x,y,z", f"7,{cells}", f"8,{cells}", f"9,,{cells[2:]}"
    )
    sensors = open_recording(tmp_path / "imu_sample.csv").sensors
    left, right = samples(open_recording(tmp_path / "imu_sample.csv"), "left_sensor"), sensors["right_sensor"].truth
    assert left.accel_mps2[0].tolist() == [0, 2, 4]
    np.testing.assert_allclose(left.gyro_radps[0], np.deg2rad([6, 8, 10]))
    assert left.stamp_ns.tolist() == [48_828_125, 53_710_938]
    np.testing.assert_allclose(right.position_m, [[1.55, 1.551, 1.552]] * 3)
    assert right.stamp_ns.tolist() == [48_828_125, 58_828_125, 68_828_125]
    np.testing.assert_allclose(sensors["left_sensor"].truth.position_m, [[0.5, 0.501, 0.502]] * 2)


def vicon(tmp_path, count=5, **changes):
    variables = {
        "ts": np.arange(count)[None] * 0.005,
        "imu": np.arange(count * 6.0).reshape(count, 6),
        "gt": np.ones((count, 3)) * [1, 2, 3],
        "name": "text",
    }
    savemat(tmp_path / "walk.mat", {k: v for k, v in (variables | changes).items() if v is not None})
    return tmp_path / "walk.mat"


def test_a_vicon_trial_brings_its_truth_with_z_up(tmp_path):
    session = open_recording(vicon(tmp_path))
    block, truth = samples(session, max_samples=2), session.sensors["imu"].truth
    assert session.format == "pyshoe_vicon"
    assert block.accel_mps2[1].tolist() == [6, 7, 8]
    assert block.gyro_radps[1].tolist() == [9, 10, 11]
    assert truth.kind is TruthKind.POSITION
    assert truth.stamp_ns.tolist() == block.stamp_ns.tolist() == [0, 5_000_000, 10_000_000, 15_000_000, 20_000_000]
    assert truth.position_m[3].tolist() == [1, -2, 3]


def test_a_mat_file_with_times_that_are_none_leaves_those_rows_out(tmp_path):
    session = open_recording(vicon(tmp_path, ts=np.array([[0.0, np.nan, 0.01, np.inf, 0.02]])))
    assert samples(session).accel_mps2[:, 0].tolist() == [0, 12, 24]
    assert ("unreadable_time", 2) in [(n.kind, n.count) for n in session.notices]


def test_variables_of_different_length_are_an_error(tmp_path):
    with pytest.raises(RecordingError, match="variables differ in length"):
        open_recording(vicon(tmp_path, ts=np.arange(4.0)[None]))


def test_a_cut_mat_file_is_an_error(tmp_path):
    path = vicon(tmp_path, count=200)
    whole = path.read_bytes()
    for cut in range(1, len(whole), 997):
        path.write_bytes(whole[:cut])
        with pytest.raises(RecordingError, match=r"walk.mat"):
            open_recording(path)


@pytest.mark.parametrize(("unit", "tesla"), [("T", 1.0), ("uT", 1e-6), ("nT", 1e-9), ("G", 1e-4), ("mG", 1e-7)])
def test_a_field_is_turned_into_tesla(tmp_path, unit, tesla):
    (tmp_path / "walk.yaml").write_text(OWN % "s" + f"    mag: {{columns: [mx, my, mz], unit: {unit}}}\n")
    path = write(tmp_path / "walk.csv", "t,s:wx,s:wy,s:wz,ax,ay,az,mz,my,mx", "0,1,2,3,4,5,6,7,8,9")
    block = samples(open_recording(path))
    np.testing.assert_allclose(block.field_tesla, [[9 * tesla, 8 * tesla, 7 * tesla]], rtol=1e-15)
    assert block.field_sd_tesla.tolist() == [0.0]
    assert block.accel_mps2.tolist() == [[4, 5, 6]]


def test_a_row_without_a_field_keeps_its_sample(tmp_path):
    (tmp_path / "walk.yaml").write_text(OWN % "s" + "    mag: {columns: [mx, my, mz], unit: T}\n")
    cells = ("1,2,3", ",,", "1,nan,3", "1,2", "1,2,inf", "x,2,3", "4,5,6")
    rows = [f"{i},1,2,3,4,5,6,{c}" for i, c in enumerate(cells)]
    session = open_recording(write(tmp_path / "walk.csv", OWN_HEADER.strip() + ",mx,my,mz", *rows))
    block = samples(session)
    assert block.field_sd_tesla.tolist() == [0.0, -1.0, -1.0, -1.0, -1.0, -1.0, 0.0]
    assert block.field_tesla.tolist() == [[1, 2, 3], *[[0, 0, 0]] * 5, [4, 5, 6]]
    assert np.isfinite(block.gyro_radps).all()
    assert session.notices == []


def test_a_field_that_a_users_map_names_must_be_there(tmp_path):
    path = own(tmp_path, "0,1,2,3,4,5,6")
    path.with_suffix(".yaml").write_text(OWN % "s" + "    mag: {columns: [mx, my, mz], unit: T}\n")
    with pytest.raises(RecordingError, match=r"no columns match 'mx' of .*; correct the map"):
        open_recording(path)


@pytest.mark.parametrize("magnetic", [True, False])
def test_a_known_format_opens_with_and_without_its_field(tmp_path, magnetic):
    header = "Packet number," + NGIMU.strip().split(",", 1)[1] + ",Magnetometer X (G),Magnetometer Y (G)"
    path = write(tmp_path / "w.csv", header + ",Magnetometer Z (G)" * magnetic, "1,0,0,0,0,0,1,0.1,0.2,-0.3")
    session = open_recording(path)
    assert session.format == "xio_ximu_marg"
    assert (samples(session).field_sd_tesla >= 0.0).tolist() == [magnetic]
    np.testing.assert_allclose(samples(session).field_tesla, [[1e-5 * magnetic, 2e-5 * magnetic, -3e-5 * magnetic]])


def tile_walk(tmp_path):
    names = [f"inertial-1.2:scaled{kind}{axis}" for kind in ("Gyro", "Accel") for axis in "XYZ"]
    write(tmp_path / "w1.csv", "Time," + ",".join(names), "0,1,2,3,0,0,1", "0.005,1,2,3,0,0,1")
    savemat(tmp_path / "w1.mat", {"GCP_meters": np.array([[0.0, 0.0], [1.2, 0.3], [2.4, 0.3]]), "expID": 1})
    return tmp_path / "w1.csv"


def test_a_tile_walk_brings_the_strides_beside_it(tmp_path):
    session = open_recording(tile_walk(tmp_path))
    truth = session.sensors["imu"].truth
    assert samples(session).accel_mps2[0].tolist() == [0, 0, G]
    assert (truth.kind, len(truth.stamp_ns)) == (TruthKind.STRIDES, 0)
    assert truth.position_m.tolist() == [[0, 0], [1.2, 0.3], [2.4, 0.3]]


def test_a_damaged_truth_is_told_and_a_missing_one_is_none(tmp_path):
    path = tile_walk(tmp_path)
    (tmp_path / "w1.mat").write_bytes(b"rubbish")
    session = open_recording(path)
    assert session.sensors["imu"].truth is None
    assert [n.kind for n in session.notices] == ["unreadable_truth"]
    (tmp_path / "w1.mat").unlink()
    assert open_recording(path).notices == []


def test_a_file_of_truth_alone_sends_to_the_samples(tmp_path):
    tile_walk(tmp_path)
    with pytest.raises(RecordingError, match=r"holds only the truth of a walk: open the samples beside it, w1\.csv"):
        open_recording(tmp_path / "w1.mat")


def test_an_unknown_table_shows_its_columns_and_how_to_map_them(tmp_path):
    path = write(tmp_path / "walk.csv", "when,a,b", "0,1,2")
    with pytest.raises(RecordingError, match=r"columns are 'when', 'a', 'b': say which is which in a file 'walk.yaml'"):
        open_recording(path)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("missing.csv", None, "does not exist: check the path"),
        ("empty.csv", "", "is empty: record it again"),
        ("header.csv", NGIMU, "holds no readable sample"),
        ("times.csv", NGIMU + "x,1,2,3,4,5,6\n", "holds no readable sample"),
        ("walk.png", "x", "unknown format: give a rosbag2 directory or a file that ends in .bag, .csv"),
        ("walk.bag", "#ROSBAG", "repair it with `rosbag reindex`"),
    ],
)
def test_what_cannot_be_opened_says_what_to_do(tmp_path, name, content, message):
    if content is not None:
        (tmp_path / name).write_text(content)
    with pytest.raises(RecordingError, match=message) as caught:
        open_recording(tmp_path / name)
    assert str(tmp_path / name) in str(caught.value)


def test_opening_text_imports_neither_rosbags_nor_mcap_nor_scipy(tmp_path):
    path = write(tmp_path / "walk.csv", NGIMU, "0,0,0,0,0,0,1")
    code = (
        "import sys; from pdr_core.recording import open_recording; "
        f"next(open_recording({str(path)!r}).sensors['imu'].pieces()); "
        "print([m for m in ('rosbags', 'mcap', 'scipy', 'apsw') if m in sys.modules])"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "[]"

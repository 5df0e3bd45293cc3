"""`pdr calibrate mag`, with a recording in memory."""

import json
from pathlib import Path

import numpy as np
import pytest
import yaml

import pdr_core.recording
from pdr_bringup_scripts.commands.calibrate import mag
from pdr_bringup_scripts.problems import Problem
from pdr_core.intake import Ingestion
from pdr_core.params_file import load_params
from pdr_core.recording import Sensor, Session
from pdr_core.records import part
from support.processes import check_refused, pdr
from support.turned_magnetometer import heading_errors_rad, some_iron, turned

SWAPPED = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
IRON = some_iron(2, axes=SWAPPED)
IMU = turned(IRON, 2)[0]


@pytest.fixture
def recorded(monkeypatch, tmp_path):
    """A function that makes samples what the next recording to be opened holds, and a folder to work in."""

    def put(imu, sensors=("imu",)):
        def read(most):
            return (part(imu, i, i + most // 16) for i in range(0, len(imu.stamp_ns), most // 16))

        found = {name: Sensor(name, None, read) for name in sensors}
        session = Session("turned", Path("turned.mcap"), "memory", found)
        monkeypatch.setattr(pdr_core.recording, "open_recording", lambda *_, **__: session)

    monkeypatch.chdir(tmp_path)
    put(IMU)
    return put


def calibrate(**given):
    everything = {"out": None, "report": None, "json": False, "params": None, "columns": None, "sensor": ""}
    mag(Path("turned.mcap"), **(everything | given))


class Applied:
    """The calibration as ingestion applies it: what counts in the end."""

    def __init__(self, params):
        self.params = params

    def applied(self, field_tesla):
        return Ingestion(self.params.intake).run(part(IMU, 0, 1)._replace(field_tesla=field_tesla[None])).field_tesla[0]


def test_what_it_writes_makes_headings_right(recorded, capsys):  # noqa: ARG001
    calibrate(out=Path("mag.yaml"), report=Path("mag.html"))
    said = capsys.readouterr()
    assert said.out.startswith("The field is 47.9 µT strong and points 60.0° down.")
    assert "x is the magnetometer's y, y its x, z its -z, 12." in said.out
    assert said.err == (
        "Written to mag.yaml: give it to `pdr run --params`.\nWritten to mag.html: open it in a browser.\n"
    )
    params = load_params(Path("mag.yaml"))
    assert np.rad2deg(np.abs(heading_errors_rad(IRON, Applied(params))).max()) < 1.0
    assert params.place.field_norm_tesla == pytest.approx(47.9e-6, abs=0.2e-6)
    assert params.place.field_dip_deg == pytest.approx(60.0, abs=0.5)
    assert "turned.mcap" in Path("mag.html").read_text()


def test_what_stood_in_the_file_stays_but_the_old_calibration_does_not_count(recorded):  # noqa: ARG001
    calibrate(out=Path("mag.yaml"))
    old = {
        "intake": {"mag_offset_x_tesla": 1e-3, "mag_matrix_xx": -3.0, "mounting_yaw_rad": 1.0, "accel_unit": "m/s^2"},
        "stance": {"detector": "glrt"},
        "place": {"latitude_deg": 52.0},
    }
    Path("old.yaml").write_text(yaml.safe_dump({"/**": {"ros__parameters": old}}))
    calibrate(params=Path("old.yaml"), out=Path("new.yaml"))
    fresh, new = (yaml.safe_load(Path(name).read_text())["/**"]["ros__parameters"] for name in ("mag.yaml", "new.yaml"))
    assert new["stance"] == {"detector": "glrt"}
    assert new["intake"] == {"mounting_yaw_rad": 1.0, "accel_unit": "m/s^2", **fresh["intake"]}
    assert new["place"] == {"latitude_deg": 52.0, **fresh["place"]}


def test_the_unit_of_the_file_counts(recorded):
    recorded(IMU._replace(field_tesla=IMU.field_tesla * 1e6))
    with pytest.raises(Problem, match=r"turned\.mcap, imu: there is no magnetic field"):
        calibrate()
    Path("unit.yaml").write_text("/**: {ros__parameters: {intake: {mag_unit: uT}}}")
    calibrate(params=Path("unit.yaml"))


def test_a_latitude_that_is_given_tells_mirrored_axes(recorded, capsys):
    recorded(turned(some_iron(2, axes=np.diag([1.0, 1.0, -1.0])), 2)[0])
    with pytest.raises(Problem, match=r"place\.latitude_deg"):
        calibrate()
    Path("here.yaml").write_text("/**: {ros__parameters: {place: {latitude_deg: 48.0}}}")
    calibrate(params=Path("here.yaml"))
    assert "z its -z, mirrored, " in capsys.readouterr().out


def test_json_holds_all_figures(recorded, capsys):  # noqa: ARG001
    calibrate(json=True)
    found = json.loads(capsys.readouterr().out)
    assert np.array(found["matrix"]).shape == (3, 3)
    assert set(found) >= {"offset_tesla", "field_norm_tesla", "dip_rad", "residual_tesla", "heading_sd_rad", "coverage"}


def test_one_sensor_is_chosen(recorded):
    recorded(IMU, ("left", "right"))
    with pytest.raises(Problem, match="choose one by --sensor: left, right"):
        calibrate()
    calibrate(sensor="right")


def test_the_recording_is_not_overwritten(recorded):  # noqa: ARG001
    with pytest.raises(Problem, match="is what the calibration is made from"):
        calibrate(out=Path("turned.mcap"))


def test_the_command_is_there_and_refuses_in_one_sentence(tmp_path):
    assert "mag.yaml" in pdr("calibrate", "mag", "--help").stdout
    check_refused(pdr("calibrate", "mag", tmp_path / "gone.mcap"), "gone.mcap does not exist")

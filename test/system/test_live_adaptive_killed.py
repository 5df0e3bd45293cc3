"""`pdr demo --adaptive` whose driver is killed in mid-walk: it is started again, and the track goes on."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from pdr_core.recording.tum import read_tum
from support.processes import END_S

END_OF_DEMO_S = 300.0
STRIDE_M = 1.7  # longer than any of this walk
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """The folder of a demonstration whose driver was killed once, its exit code and its words."""
    folder = tmp_path_factory.mktemp("killed")
    (folder / "quick.yaml").write_text("/**: {ros__parameters: {power: {calibration_m: 20.0}}}")
    command = ["demo", "--adaptive", "--length", "100", "--params", folder / "quick.yaml", "--out", folder / "out"]
    demo = subprocess.Popen(
        [sys.executable, "-m", "pdr_bringup_scripts", *map(str, command)],
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    try:
        next(line for line in demo.stdout if line.startswith("Walking: "))  # else it has failed
        os.kill(driver_of(folder / "out"), signal.SIGKILL)
        said, _ = demo.communicate(timeout=END_OF_DEMO_S)
    finally:
        demo.kill()
        demo.wait(END_S)
    return folder / "out", demo.returncode, said


def driver_of(out):
    """Return the process of the driver of a demonstration."""
    lines = {int(path.parent.name): command_line(path) for path in Path("/proc").glob("[0-9]*/cmdline")}
    (found,) = (pid for pid, line in lines.items() if "pdr_nodes.imu_driver_node" in line and str(out) in line)
    return found


def command_line(path):
    try:
        return path.read_bytes().replace(b"\0", b" ").decode(errors="replace")
    except OSError:  # it has ended
        return ""


def test_the_demonstration_ends_well_and_says_what_has_happened(killed):
    out, code, said = killed
    assert code == 0, said
    result = json.loads((out / "result.json").read_text())
    kinds = {notice["kind"]: notice for notice in result["notices"]}
    assert kinds["driver_restarted"]["count"] == 1
    assert "driver_died" in kinds
    assert result["truth"] is None  # the walk began anew
    assert "was started again" in said


def test_the_gyro_came_back_and_went_off_again(killed):
    modes = json.loads((killed[0] / "result.json").read_text())["energy"]["modes"]
    fault = next(i for i, m in enumerate(modes) if m["mode"] == "fault")
    assert modes[fault]["gyro"]
    after = [(m["mode"], m["answer"]) for m in modes[fault + 1 :]]
    assert after[0] == ("initialising", "acknowledged")
    assert ("dead_reckoning", "acknowledged") in after


def test_the_track_goes_on_without_a_jump(killed):
    places_m = read_tum(killed[0] / "trajectory.tum").position_m
    assert np.isfinite(places_m).all()
    assert np.linalg.norm(np.diff(places_m, axis=0), axis=1).max() < STRIDE_M
    assert np.linalg.norm(np.diff(places_m[:, :2], axis=0), axis=1).sum() > 100.0

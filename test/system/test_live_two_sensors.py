"""`pdr live` on the drivers of two feet, each a process of its own: what `pdr run` makes of the same samples."""

import json

import numpy as np
import pytest

from pdr_bringup_scripts.live.live_recording import messages
from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline import FootInertial
from pdr_core.rate_limit import RateLimit
from pdr_core.recording import open_recording
from pdr_core.recording.tum import read_tum
from pdr_core.records import joined, part
from pdr_core.simulation import simulated_feet
from support.feet import FEET
from support.live_command import live_until_done, patience
from support.processes import pdr
from support.walks import BEGIN_NS, write_csv

LENGTH_M, SPEED = 30.0, 2  # after 20 m the feet know that they turn to opposite sides
ROWS = {
    "left": 2550,
    "right": 2350,
}  # Ctrl-C comes in the middle of the walk, and the left foot waits for the right one
TOLERANCE = 1e-9
PARTS = {"left": "left/imu", "right": "right/imu", "body": "body"}  # where they are in the folders of live and of run
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def walks():
    """What the sensors of both feet measure until they are switched off."""
    walk = SimulationParams(
        motion="smooth", walk="straight", walk_length_m=LENGTH_M, sample_rate_hz=100.0, sensor_model="g_sensitive"
    )
    feet = simulated_feet(walk, start_ns=BEGIN_NS)
    return {foot: part(feet[foot].imu, 0, rows) for foot, rows in ROWS.items()}


@pytest.fixture(scope="module")
def run(walks, tmp_path_factory):
    """A run that Ctrl-C ends: its folder, its exit code and what it said."""
    folder = tmp_path_factory.mktemp("feet")
    drivers = [(write_csv(folder / f"{f}.csv", walks[f]), f"/{f}_shoe/imu", "RELIABLE", SPEED, "mag") for f in FEET]
    topics = [
        part for foot in FEET for part in (f"--{foot}", f"/{foot}_shoe/imu", f"--{foot}-mag", f"/{foot}_shoe/imu_mag")
    ]
    return folder / "out", *live_until_done(folder, drivers, *topics, *patience(folder))


@pytest.fixture(scope="module")
def again(run):
    """What `pdr run` makes of the recording."""
    answer = pdr("run", run[0] / "recording", "--out", run[0] / "again")
    assert answer.returncode == 0, answer.stderr
    return run[0] / "again"


def test_ctrl_c_ends_it_well(run):
    out, code, said, complained = run
    assert (code, "Traceback" in complained) == (0, False), complained
    for whose in PARTS:
        assert f"{whose}: Walked 2" in said
    assert f"Open {out / 'body' / 'report.html'} in a browser" in said


@pytest.mark.parametrize("whose", PARTS)
def test_what_is_estimated_is_what_was_recorded(run, again, whose):
    live, offline = (read_tum(folder / "trajectory.tum") for folder in (run[0] / whose, again / PARTS[whose]))
    assert len(live.stamp_ns) > 2000
    np.testing.assert_array_equal(live.stamp_ns, offline.stamp_ns)
    np.testing.assert_allclose(live.position_m, offline.position_m, rtol=0.0, atol=TOLERANCE)
    np.testing.assert_allclose(live.quat_xyzw, offline.quat_xyzw, rtol=0.0, atol=TOLERANCE)


def test_the_result_is_the_same(run, again):
    live, offline = (json.loads((folder / "result.json").read_text()) for folder in (run[0], again))
    for foot in FEET:
        for name in ("strides", "samples"):
            assert live["sensors"][foot][name] == offline["sensors"][PARTS[foot]][name]
    assert live["body"]["strides"] == offline["body"]["strides"] > 8


@pytest.mark.parametrize("foot", FEET)
def test_the_samples_come_through_as_they_were_with_their_fields(run, walks, foot):
    (recorded,) = (s for name, s in open_recording(run[0] / "recording").sensors.items() if foot in name)
    heard = joined(list(recorded.pieces()))
    rows = np.searchsorted(walks[foot].stamp_ns, heard.stamp_ns)
    np.testing.assert_array_equal(heard.gyro_radps, walks[foot].gyro_radps[rows])
    assert len(rows) > 0.8 * len(walks[foot].stamp_ns)  # what is lost, is lost before it reaches us
    assert len(list(messages(run[0] / "recording", f"{foot}/imu/mag"))) > 0.8 * len(rows)


@pytest.mark.parametrize("foot", FEET)
def test_the_feet_told_each_other_something(run, foot):
    """Else the tests above would show little."""
    recorded = open_recording(run[0] / "recording").sensors[f"{foot}/imu"]
    alone = RateLimit(Params().node.odom_rate_hz).thinned(
        FootInertial(Params()).run(joined(list(recorded.pieces()))).nav
    )
    together = read_tum(run[0] / foot / "trajectory.tum")
    assert np.abs(alone.position_m - together.position_m[: len(alone.stamp_ns)]).max() > 0.01


def test_a_silent_foot_is_told_and_the_other_is_kept(walks, tmp_path):
    driver = (write_csv(tmp_path / "left.csv", walks["left"]), "/left_shoe/imu", "RELIABLE", 8)
    code, said, complained = live_until_done(
        tmp_path, [driver], "--left", "/left_shoe/imu", "--right", "/right_shoe/imu"
    )
    recording = tmp_path / "out" / "recording"
    assert (code, said) == (2, "")
    assert "pdr: no messages on /right_shoe/imu yet: nobody publishes it" in complained
    assert f"pdr: the other foot is in {recording}: pdr run {recording}" in complained
    session = open_recording(recording)
    assert (list(session.sensors), session.notices) == (["left/imu"], [])

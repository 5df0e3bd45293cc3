"""What the four processes say of a recording, live, is what `pdr run` says of it."""

import json

import numpy as np
import pytest

from pdr_core.params import Params
from pdr_core.rate_limit import RateLimit
from pdr_core.recording.tum import read_tum
from support.processes import pdr
from support.walks import straight_walk, write_csv

TOLERANCE = 1e-9
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module", params=["simulated, in real time", "a real walk, four times as fast"])
def folders(request, tmp_path_factory):
    """Folders of one recording: played live, estimated offline, and estimated offline from what was recorded live."""
    folder = tmp_path_factory.mktemp("live")
    if "real walk" in request.param:
        recording = request.getfixturevalue("recordings") / "xio_ngimu" / "short_walk.csv"
        rate = 4
        columns = ()
    else:
        recording, rate = write_csv(folder / "walk.csv", straight_walk(3, rate_hz=200.0).imu), 1
        columns = ("--columns", recording.with_suffix(".yaml").rename(folder / "mine.yml"))
    commands = {
        "live": ("replay", recording, "--rate", rate, "--namespace", "left/foot", *columns),
        "offline": ("run", recording, *columns),
        "again": ("run", folder / "live" / "recording"),
    }
    for name, command in commands.items():
        answer = pdr(*command, "--out", folder / name)
        assert answer.returncode == 0, answer.stderr
    return folder


@pytest.mark.parametrize("other", ["offline", "again"])
def test_the_trajectory_is_the_same(folders, other):
    live, offline = (read_tum(folders / name / "trajectory.tum") for name in ("live", other))
    said = RateLimit(Params().node.odom_rate_hz).allowed(offline.stamp_ns)
    np.testing.assert_array_equal(live.stamp_ns, offline.stamp_ns[said])
    np.testing.assert_allclose(live.position_m, offline.position_m[said], rtol=0.0, atol=TOLERANCE)
    np.testing.assert_allclose(live.quat_xyzw, offline.quat_xyzw[said], rtol=0.0, atol=TOLERANCE)
    assert len(live.stamp_ns) > 1000


@pytest.mark.parametrize("other", ["offline", "again"])
def test_the_result_is_the_same(folders, other):
    live, offline = (json.loads((folders / name / "result.json").read_text()) for name in ("live", other))
    assert live["strides"] == offline["strides"] >= 3
    assert live["samples"] == offline["samples"]
    assert live["distance_m"] == pytest.approx(offline["distance_m"], abs=1e-6)
    assert {n["kind"]: n["count"] for n in live["notices"]} == {n["kind"]: n["count"] for n in offline["notices"]}

"""One foot whose heading a constraint holds, live: heading_fusion answers, and the track is the one made offline."""

import numpy as np
import pytest

from pdr_bringup_scripts.live.live_recording import messages
from pdr_core.heading import HeadingConstraint
from pdr_core.params_file import load_params
from pdr_core.pipeline import FootInertial
from pdr_core.rate_limit import RateLimit
from pdr_core.recording import open_recording
from pdr_core.records import joined
from pdr_nodes.convert import nav_block
from support.processes import pdr

STRAIGHT = (
    "/**: {ros__parameters: {simulation: {walk: straight, sensor_model: g_sensitive}, heading: {constraint: hde}}}"
)
TOLERANCE = 1e-9
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("held")
    (folder / "straight.yaml").write_text(STRAIGHT)
    options = ("--params", folder / "straight.yaml", "--length", 12, "--rate", 2, "--out", folder / "out")
    answer = pdr("demo", *options)
    assert answer.returncode == 0, answer.stderr
    assert "the heading constraint is on" in answer.stdout
    return folder / "out"


def said(out, topic):
    return joined([nav_block(message) for message in messages(out / "recording", topic)])


def offline(out, held):
    """The track of the recorded samples, with the constraint or without it, as the node tells it."""
    params = load_params(out / "nodes" / "foot" / "parameters.yaml")
    (sensor,) = open_recording(out / "recording").sensors.values()
    heading = {"heading": HeadingConstraint(params.heading).answer} if held else {}
    foot = FootInertial(params, **heading)
    outputs = [foot.run(joined(list(sensor.pieces()))), foot.finish()]
    return RateLimit(params.node.odom_rate_hz).thinned(joined([output.nav for output in outputs]))


def test_the_foot_is_held_live_as_it_is_offline(out):
    live, expected, free = said(out, "foot/odom"), offline(out, held=True), offline(out, held=False)
    np.testing.assert_array_equal(live.stamp_ns, expected.stamp_ns)
    np.testing.assert_allclose(live.position_m, expected.position_m, rtol=0.0, atol=TOLERANCE)
    np.testing.assert_allclose(live.quat_xyzw, expected.quat_xyzw, rtol=0.0, atol=TOLERANCE)
    assert np.abs(live.position_m - free.position_m).max() > 1e-3


def test_the_person_goes_with_the_foot(out):
    foot, person = said(out, "foot/odom"), said(out, "odom")
    np.testing.assert_array_equal(person.stamp_ns, foot.stamp_ns)
    np.testing.assert_allclose(person.position_m[:, :2], foot.position_m[:, :2], rtol=0.0, atol=TOLERANCE)

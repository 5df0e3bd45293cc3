"""The configuration for robot_localization, which cannot be installed here: its names, and that they fit ours."""

import re

import numpy as np
import yaml
from source_tree import CHECKOUT

from pdr_bringup_scripts.live.chain import NAMESPACE
from pdr_core.params import NodeParams

FILE = CHECKOUT / "pdr_bringup_scripts" / "config" / "robot_localization.yaml"
# as its documentation lists them: state_estimation_nodes.rst, params/ekf.yaml
KNOWN = re.compile(
    r"frequency|sensor_timeout|two_d_mode|(map|odom|base_link|world)_frame|transform_time_offset|transform_timeout|"
    r"publish_tf|publish_acceleration|print_diagnostics|smooth_lagged_data|history_length|"
    r"(odom|pose|twist|imu)\d+(_config|_queue_size)?|(odom|pose|imu)\d+_(differential|relative)|"
    r"odom\d+_(pose|twist)_rejection_threshold|(pose|twist)\d+_rejection_threshold"
)
PARAMETERS = yaml.safe_load(FILE.read_text(encoding="utf-8"))["ekf_filter_node"]["ros__parameters"]
X, Y, Z, YAW, VX, VY, VZ, VYAW = 0, 1, 2, 5, 6, 7, 8, 11


def fused(sensor):
    """The variables of a sensor that are fused, by their place among the fifteen."""
    chosen = PARAMETERS[f"{sensor}_config"]
    assert len(chosen) == 15
    return set(np.flatnonzero(chosen).tolist())


def test_every_name_is_one_of_its_documentation():
    assert [name for name in PARAMETERS if not KNOWN.fullmatch(name)] == []


def test_frames_and_topic_are_those_that_we_publish():
    node = NodeParams()
    assert (PARAMETERS["odom_frame"], PARAMETERS["base_link_frame"]) == (node.world_frame, node.base_frame)
    assert PARAMETERS["odom0"] == f"/{NAMESPACE}/odom"


def test_no_transform_has_two_broadcasters():
    """ekf_node broadcasts world_frame -> base_link_frame, by map -> odom where the world is the map."""
    assert NodeParams().publish_base_tf
    assert PARAMETERS["publish_tf"]
    assert PARAMETERS["world_frame"] == PARAMETERS["map_frame"] != PARAMETERS["odom_frame"]


def test_nothing_is_fused_twice_and_no_swinging_height_at_all():
    assert fused("odom0") == {VX, VY, VYAW}
    assert fused("pose0") == {X, Y}
    assert PARAMETERS["two_d_mode"]

"""Frames are called as tf2 and several people on one /tf need it."""

from dataclasses import asdict

import pytest
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from pdr_core.parameter import ParameterError
from pdr_core.params import Params, changed
from pdr_core.records import part
from pdr_msgs.msg import StanceImu
from pdr_nodes.frames import prefixed
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.walks import judged, stance_messages, straight_walk


def test_a_prefix_goes_before_every_frame():
    messages = stance_messages(part(judged(straight_walk(1).imu), 0, 50))
    named = {"node__frame_prefix": "alice/", "node__foot_frame": "l_sole", "node__publish_tf": True}
    with Bench(ZuptEkfNode, **named) as bench:
        odometry, transforms = bench.hear(Odometry, "odom"), bench.hear(TFMessage, "/tf", 1000)
        bench.until(lambda: bench.me.count_publishers("/tf") == 1, "a broadcaster")
        bench.feed(bench.publisher(StanceImu, "stance"), messages)
        bench.until(lambda: len(odometry) == len(transforms) == 50, "estimates")
    single = [message.transforms[0] for message in transforms]
    heard = {(m.header.frame_id, m.child_frame_id) for m in [*odometry, *single]}
    assert heard == {("alice/odom", "alice/l_sole")}


def test_no_frame_of_any_node_is_left_out():
    node = asdict(prefixed(changed(Params(), "node", frame_prefix="alice/")).node)
    default = asdict(Params().node)
    told = {name for name in node if node[name] != default[name]} - {"frame_prefix"}
    assert told == {name for name in node if name.endswith("_frame")} >= {"world_frame", "foot_frame", "chest_frame"}
    assert {node[name] for name in told} == {f"alice/{default[name]}" for name in told}


@pytest.mark.parametrize(
    "given",
    [{"node__frame_prefix": "/alice/"}, {"node__world_frame": "/odom"}, {"node__foot_frame": ""}],
    ids=["a prefix with a slash first", "a frame with one", "an empty frame"],
)
def test_what_tf2_refuses_is_refused(given):
    with pytest.raises(ParameterError, match="tf2 takes no frame"), Bench(ZuptEkfNode, **given):
        pass

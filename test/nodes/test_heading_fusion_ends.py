"""Node `heading_fusion`: the node of a foot ends. All that it has said counts, and then it is waited for no longer."""

import numpy as np
from nav_msgs.msg import Odometry

from pdr_core.params import Params
from pdr_core.pipeline import FootInertial, HeadingFusion
from pdr_core.records import joined, length, part
from pdr_nodes.convert import nav_block, odometry_message
from pdr_nodes.heading_fusion_node import HeadingFusionNode
from support.bench import Bench
from support.feet import FEET, FootOnTopics, both_walk, halves

WALK = both_walk(4.8)


def test_a_foot_whose_node_has_ended_is_not_waited_for():
    with Bench(HeadingFusionNode, node__answer_timeout_s=60.0) as bench:
        feet = {foot: FootOnTopics(bench, foot) for foot in FEET}
        feet["left"].walk(halves(WALK["left"])[0])
        feet["right"].walk(WALK["right"])
        bench.until(lambda: feet["right"].answers, "answers while both are there")
        feet["left"].leave()
        end_ns = WALK["right"].stamp_ns[-1] - 1e9
        bench.until(lambda: feet["right"].latest_ns > end_ns, "the right foot's end", 25.0)  # patience: 30 s


def test_the_last_words_of_a_node_that_has_ended_are_heard_before_it_is_waited_for_no_longer():
    """On a busy machine they have come when the node looks who is there, and the stage has not seen them."""
    navs = {foot: part(FootInertial(Params()).run(WALK[foot]).nav, 0, 200) for foot in FEET}
    fusion, ends = HeadingFusion(Params(), FEET), {"left": part(navs["left"], 0, 100), "right": navs["right"]}
    expected = joined([*(fusion.odometry(foot, nav).body for foot, nav in ends.items()), fusion.leave("left").body])
    with Bench(HeadingFusionNode, node__answer_timeout_s=60.0) as bench:
        said, node = bench.hear(Odometry, "odom"), bench.node
        told = {foot: messages_of(nav, foot) for foot, nav in ends.items()}
        topics = {foot: bench.publisher(Odometry, f"{foot}/odom") for foot in FEET}
        bench.feed(topics["right"], told["right"])
        bench.feed(topics["left"], told["left"][:50])
        bench.until(lambda: len(said) == 50, "what both have told")
        bench.feed(topics["left"], told["left"][50:])
        while node.waiting < 50:
            bench.executor.spin_once(timeout_sec=0.05)
        bench.me.destroy_publisher(topics["left"])
        there = []
        node.count_publishers = lambda topic, ask=node.count_publishers: there.append(ask(topic)) or there[-1]
        while 0 not in there:
            bench.executor.spin_once(timeout_sec=0.05)
        bench.until(lambda: len(said) == length(expected), "the right foot alone")
    for name, live, offline in zip(expected._fields, joined([nav_block(m) for m in said]), expected, strict=True):
        np.testing.assert_array_equal(live, offline, err_msg=name)


def messages_of(nav, foot):
    """Return estimates of a foot as its filter tells them."""
    return [odometry_message(nav, i, "odom", f"{foot}_foot") for i in range(length(nav))]

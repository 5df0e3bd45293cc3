"""Each step is answered by one heading observation: the track does not depend on when the answer comes."""

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry

from pdr_core.eskf import ZuptFilter
from pdr_core.params import Params, changed
from pdr_core.records import HeadingObservation, HeadingSource, joined, length
from pdr_msgs.msg import Handover, StanceImu, StepEvent
from pdr_msgs.msg import HeadingObservation as HeadingMessage
from pdr_nodes.convert import nav_block, step_event
from pdr_nodes.convert_feedback import handover_record, heading_message
from pdr_nodes.qos import ANSWERS, STATUS
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.walks import judged, stance_messages, straight_walk

ASKING = changed(Params(), "filter", heading_feedback=True)
STRIDES = 3
BLOCK = judged(straight_walk(STRIDES).imu)


def answer(step):
    later_ns = 40_000_000 * step.index
    return HeadingObservation(
        step.index, step.stamp_ns, step.answer_due_ns + later_ns, HeadingSource.BUILDING, 0.02 * step.index, 0.01
    )


def offline():
    """The filter alone, answered at once."""
    f, navs = ZuptFilter(ASKING.filter, ASKING.place), []
    nav, steps = f.run(BLOCK)
    while steps:
        navs.append(nav)
        for step in steps:
            f.answer(answer(step))
        nav, steps = f.resume()
    return joined([*navs, nav])


class Walk:
    """The walk through the node, with somebody who answers, or nobody."""

    def __init__(self, bench):
        self.bench, self.node = bench, bench.node
        self.odometry, self.steps = bench.hear(Odometry, "odom"), bench.hear(StepEvent, "step")
        self.handovers = bench.hear(Handover, "handover")
        self.diagnostics = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        self.answers = bench.me.create_publisher(HeadingMessage, "heading_observation", ANSWERS)
        self.bench.feed(bench.publisher(StanceImu, "stance"), stance_messages(BLOCK))

    def heard(self, messages, count):
        self.bench.until(lambda: len(messages) >= count, f"{count} messages")

    def answered(self, behind):
        """Answer each step when the odometry has stood still for it, or as soon as it is known."""
        self.bench.until(self.answers.get_subscription_count, "somebody who asks")
        for count in range(1, STRIDES):  # the last step is certain only when no more samples come
            self.heard(self.steps, count)
            if behind:
                self.bench.until(lambda: self.node._filter.waits, "the filter to wait")
            self.answers.publish(heading_message(answer(step_event(self.steps[count - 1])), "foot"))
        self.heard(self.odometry, length(BLOCK))
        return joined([nav_block(message) for message in self.odometry])


@pytest.mark.parametrize("behind", [True, False])
def test_the_answers_give_the_track_of_the_filter_alone(behind):
    with Bench(ZuptEkfNode, filter__heading_feedback=True, node__answer_timeout_s=0.0) as bench:
        nav = Walk(bench).answered(behind)
    expected = offline()
    np.testing.assert_array_equal(nav.stamp_ns, expected.stamp_ns)
    np.testing.assert_array_equal(nav.position_m, expected.position_m)
    np.testing.assert_array_equal(nav.quat_xyzw, expected.quat_xyzw)


def test_without_answers_the_node_goes_on_and_says_so():
    with Bench(ZuptEkfNode, filter__heading_feedback=True, node__answer_timeout_s=0.2, node__idle_s=0.3) as bench:
        walk = Walk(bench)
        bench.until(lambda: len(walk.odometry) == length(BLOCK), "an estimate for every sample")
        bench.until(lambda: "heading_unanswered" in repr(walk.diagnostics), "the notice")


def test_each_step_hands_the_estimate_over():
    with Bench(ZuptEkfNode, node__idle_s=0.3) as bench:
        walk = Walk(bench)
        bench.until(lambda: len(walk.steps) == len(walk.handovers) == STRIDES, "every step")
    handed = handover_record(walk.handovers[-1])
    nav = joined([nav_block(message) for message in walk.odometry])
    at = int(np.flatnonzero(nav.stamp_ns == handed.stamp_ns)[0])
    np.testing.assert_array_equal(handed.pose.position_m, nav.position_m[at])
    np.testing.assert_array_equal(handed.pose.covariance, nav.pose_covariance[at])
    assert handed.biases is not None


def test_the_last_step_comes_after_what_waits_for_an_answer():
    """The stream pauses while the filter waits: what it holds is still to come."""
    with Bench(ZuptEkfNode, filter__heading_feedback=True, node__answer_timeout_s=0.0, node__idle_s=0.2) as bench:
        walk = Walk(bench)
        bench.until(lambda: bench.node._filter.waits, "the filter to wait")
        bench.until(lambda: bench.node._ends, "the end of the stream")
        walk.answered(behind=True)
        walk.heard(walk.steps, STRIDES)
    assert [step.index for step in walk.steps] == [1, 2, 3]
    assert step_event(walk.steps[-1]).stamp_ns == BLOCK.imu.stamp_ns[-1]

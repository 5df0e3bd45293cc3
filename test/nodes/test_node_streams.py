"""What a node says of its inputs and of its one output that it shares with nobody."""

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu

from pdr_core.records import Level, length
from pdr_nodes.convert import imu_block
from pdr_nodes.imu_ingestion_node import ImuIngestionNode
from pdr_nodes.input import Input
from pdr_nodes.notice_board import notices_from
from pdr_nodes.qos import OWN, STATUS
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.walks import BEGIN_NS, imu_messages, stamps, still

BEST_EFFORT = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
MESSAGES = imu_messages(still(10.0, BEGIN_NS))


class Listening:
    """An input in the hands of the test, and the blocks that it gave."""

    def __init__(self, bench, **options):
        self.blocks = []
        self.input = Input(bench.me, Imu, "samples", OWN, imu_block, self.blocks.append, **options)
        self.input.begin()

    @property
    def stamps(self):
        self.input.give()
        return [stamp_ns for block in self.blocks for stamp_ns in block.stamp_ns.tolist()]


def expected(messages):
    return [imu_block(m).stamp_ns[0] for m in messages]


def test_what_waits_is_taken_in_few_blocks():
    sizes, take = [], ImuIngestionNode._take
    with Bench(ImuIngestionNode, node__input_reliable=True) as bench, pytest.MonkeyPatch.context() as patch:
        patch.setattr(ImuIngestionNode, "_take", lambda node, block: (sizes.append(length(block)), take(node, block)))
        bench.node.trigger_deactivate()
        bench.node.trigger_cleanup()
        bench.node.start()
        out = bench.hear(Imu, "imu/data")
        publisher = bench.publisher(Imu, "imu/data_raw")
        bench.feed(publisher, MESSAGES[:1])
        bench.until(lambda: sizes, "the first sample")
        bench.feed(publisher, MESSAGES[1:])
        bench.until(lambda: len(out) == len(MESSAGES), "all samples")
    assert stamps(out) == stamps(MESSAGES)
    assert sum(sizes) == len(MESSAGES)
    assert len(sizes) < 50


@pytest.mark.parametrize(("restarts_anew", "times"), [(False, 1), (True, 2)])
def test_a_publisher_of_ours_that_is_started_again_is_not_heard_twice_a_driver_is(restarts_anew, times):
    with Bench() as bench:
        listening = Listening(bench, restarts_anew=restarts_anew)
        first = bench.publisher(Imu, "samples")
        bench.feed(first, MESSAGES[:500])
        bench.until(lambda: len(listening.stamps) == 500, "the first samples")
        bench.me.destroy_publisher(first)
        bench.feed(bench.publisher(Imu, "samples"), MESSAGES)
        bench.until(lambda: listening.stamps[-1] == expected(MESSAGES[-1:])[0], "the last sample")
    assert listening.stamps == [*expected(MESSAGES[:500]), *expected(MESSAGES if times == 2 else MESSAGES[500:])]


def streams(diagnostics, name):
    """The latest of what a node says of its streams: {kind: notice}."""
    status = [s for m in diagnostics for s in m.status if s.name.endswith(f"{name}: streams")][-1:]
    return {notice.kind: notice for s in status for notice in notices_from(s.values)}


def test_a_node_without_samples_says_so_until_some_come():
    with Bench(ImuIngestionNode) as bench:
        diagnostics = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        bench.until(lambda: "no_input" in streams(diagnostics, "imu_ingestion"), "the notice")
        said = streams(diagnostics, "imu_ingestion")["no_input"]
        assert said.level is Level.WARN
        assert f"/{bench.namespace}/imu/data_raw for 2 s" in said.text
        publisher = bench.publisher(Imu, "imu/data_raw")

        def better():
            bench.feed(publisher, MESSAGES[:1])
            return not streams(diagnostics, "imu_ingestion")

        bench.until(better, "the end of the notice")


def test_a_publisher_that_does_not_match_is_named_with_what_to_do():
    with Bench(ImuIngestionNode, node__input_reliable=True) as bench:
        diagnostics = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        bench.me.create_publisher(Imu, "imu/data_raw", BEST_EFFORT)
        bench.until(lambda: "incompatible_qos" in streams(diagnostics, "imu_ingestion"), "the notice")
    text = streams(diagnostics, "imu_ingestion")["incompatible_qos"].text
    assert "node.input_reliable: false" in text


def test_two_filters_that_publish_one_odom_is_an_error_while_both_are_active():
    with Bench(ZuptEkfNode) as bench:
        diagnostics = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        bench.until(lambda: diagnostics, "a diagnosis")
        assert "not_alone" not in streams(diagnostics, "zupt_ekf")
        other = bench.start(ZuptEkfNode)
        bench.until(lambda: "not_alone" in streams(diagnostics, "zupt_ekf"), "the notice")
        said = streams(diagnostics, "zupt_ekf")["not_alone"]
        assert said.level is Level.ERROR
        assert f"another node publishes /{bench.namespace}/odom too: /{bench.namespace}/zupt_ekf" in said.text
        other.trigger_deactivate()
        bench.until(lambda: "not_alone" not in streams(diagnostics[-2:], "zupt_ekf"), "the end of the notice")

"""What all nodes have in common: their states, what they say of themselves, what they keep and what they drop."""

import gc

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from nav_msgs.msg import Odometry
from rclpy.parameter import Parameter
from sensor_msgs.msg import Imu

from pdr_core.records import joined
from pdr_msgs.msg import StanceImu
from pdr_nodes.convert import nav_block
from pdr_nodes.gait_dr_node import GaitDrNode
from pdr_nodes.imu_driver_node import ImuDriverNode
from pdr_nodes.imu_ingestion_node import ImuIngestionNode
from pdr_nodes.mode_manager_node import ModeManagerNode
from pdr_nodes.qos import STATUS
from pdr_nodes.stance_detector_node import StanceDetectorNode
from pdr_nodes.zupt_ekf_node import ZuptEkfNode
from support.bench import Bench
from support.participants import participants
from support.walks import BEGIN_NS, imu_messages, judged, stamps, stance_messages, still, straight_walk

NODES = pytest.mark.parametrize(
    "node",
    [ImuDriverNode, ImuIngestionNode, StanceDetectorNode, ZuptEkfNode, GaitDrNode, ModeManagerNode],
    ids=lambda n: n.NAME,
)
CONFIGURE, CLEANUP = Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_CLEANUP
ACTIVATE, DEACTIVATE = Transition.TRANSITION_ACTIVATE, Transition.TRANSITION_DEACTIVATE
SHUTDOWN = Transition.TRANSITION_ACTIVE_SHUTDOWN


def told_to(bench, transition):
    """Ask for a transition as a lifecycle manager does; return whether it was done."""
    return bench.call(ChangeState, f"{bench.node.NAME}/change_state", transition=Transition(id=transition)).success


def state(bench):
    return bench.call(GetState, f"{bench.node.NAME}/get_state").current_state.label


@NODES
def test_a_node_walks_through_its_states_when_told(node):
    with Bench(node, node__autostart=False) as bench:
        seen = [state(bench)]
        for transition in (CONFIGURE, ACTIVATE, DEACTIVATE, CLEANUP, CONFIGURE, ACTIVATE, SHUTDOWN):
            assert told_to(bench, transition)
            seen.append(state(bench))
    life = ["inactive", "active", "inactive", "unconfigured", "inactive", "active", "finalized"]
    assert seen == ["unconfigured", *life]


@NODES
def test_a_node_is_active_by_itself(node):
    with Bench(node) as bench:
        assert state(bench) == "active"


@NODES
def test_a_destroyed_node_leaves_the_graph_at_once(node):
    """Not when garbage is collected: two graphs in one process may lock each other."""
    gc.disable()
    try:
        with Bench(node):
            assert participants() == 1
        assert participants() == 0
    finally:
        gc.enable()


def test_an_impossible_transition_is_refused_and_the_node_lives_on():
    with Bench(ImuIngestionNode, node__autostart=False) as bench:
        assert not told_to(bench, ACTIVATE)
        assert state(bench) == "unconfigured"
        assert str(bench.node.problem) == "this transition is not possible while the node is unconfigured"


def test_a_bad_parameter_stops_the_configuration_until_it_is_mended():
    with Bench(ImuIngestionNode, node__autostart=False, node__idle_s=100.0) as bench:
        assert not told_to(bench, CONFIGURE)
        assert str(bench.node.problem) == "node.idle_s = 100.0: must be float, within 0.2 .. 60 s"
        assert state(bench) == "unconfigured"
        bench.node.set_parameters([Parameter("node.idle_s", value=3.0)])
        assert told_to(bench, CONFIGURE)


def test_an_inactive_node_is_silent_and_catches_up_afterwards():
    block = still(3.0, BEGIN_NS)
    messages = imu_messages(block)
    with Bench(ImuIngestionNode, node__input_reliable=True) as bench:
        out, publisher = bench.hear(Imu, "imu/data"), bench.publisher(Imu, "imu/data_raw")
        bench.feed(publisher, messages[:100])
        bench.until(lambda: len(out) == 100, "what came before")
        assert told_to(bench, DEACTIVATE)
        bench.feed(publisher, messages[100:200])
        assert state(bench) == "inactive"
        assert len(out) == 100
        assert told_to(bench, ACTIVATE)
        bench.feed(publisher, messages[200:])
        bench.until(lambda: len(out) >= 300, "what came meanwhile and later")
    assert stamps(out) == block.stamp_ns.tolist()


def test_after_a_cleanup_the_stage_starts_anew():
    messages = stance_messages(judged(straight_walk(1).imu))
    with Bench(ZuptEkfNode) as bench:
        odometry = bench.hear(Odometry, "odom")
        bench.feed(bench.publisher(StanceImu, "stance"), messages)
        bench.until(lambda: len(odometry) == len(messages), "the first estimates")
        for transition in (DEACTIVATE, CLEANUP, CONFIGURE, ACTIVATE):
            assert told_to(bench, transition)
        bench.until(lambda: len(odometry) == 2 * len(messages), "the same once more")
    nav = joined([nav_block(m) for m in odometry])
    for column in nav:
        np.testing.assert_array_equal(column[: len(messages)], column[len(messages) :])


@NODES
def test_a_node_says_in_which_state_it_is(node):
    def said():
        return [s.message for m in heard for s in m.status if s.name.endswith(f"/{node.NAME}: lifecycle")]

    with Bench(node, node__autostart=False) as bench:
        heard = bench.hear(DiagnosticArray, "/diagnostics", STATUS)
        bench.until(lambda: "unconfigured" in said(), "the first state")
        assert told_to(bench, CONFIGURE)
        assert told_to(bench, ACTIVATE)
        bench.until(lambda: said()[-1] == "active", "the last state")

"""What the nodes of a namespace say and hear, and how, as the ROS graph shows it."""

import pkgutil
from collections.abc import Iterator
from contextlib import suppress
from typing import NamedTuple

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from pdr_bringup_scripts.live.cast import below
from pdr_nodes import __path__ as modules_of_nodes

NODE_MODULE = "_node"
INGESTION = "imu_ingestion"
INPUTS = {"sensor_msgs/msg/Imu": "imu/data_raw", "sensor_msgs/msg/MagneticField": "imu/mag"}  # as recorded
OF_EVERY_NODE = ("/rosout", "/parameter_events", "/transition_event", "/clock")
QUEUE = 10_000


class OurNode(NamedTuple):
    """A node of the suite."""

    name: str
    namespace: str  # without its first slash

    @property
    def full_name(self) -> str:
        """Its name from the root."""
        return f"/{below(self.namespace, self.name)}"


class Spoken(NamedTuple):
    """A topic that nodes of ours say or hear."""

    address: str  # on the graph
    topic: str  # in a recording: relative to the namespace of the run where it lies in it
    msgtype: str


def our_names() -> frozenset[str]:
    """Return what the nodes of the suite are called: as their modules."""
    modules = (module.name for module in pkgutil.iter_modules(modules_of_nodes))
    return frozenset(name.removesuffix(NODE_MODULE) for name in modules if name.endswith(NODE_MODULE))


def our_nodes(graph: Node) -> list[OurNode]:
    """Return the nodes of the suite that are there, wherever."""
    names, there = our_names(), graph.get_node_names_and_namespaces()
    return sorted({OurNode(name, namespace.strip("/")) for name, namespace in there if name in names})


def lies_in(name: str, namespace: str) -> bool:
    """Tell whether a name is a namespace or lies below it; all lies below the root, which is empty."""
    return not namespace or f"{name}/".startswith(f"{namespace}/")


def spoken(graph: Node, nodes: list[OurNode], home: str) -> dict[str, Spoken]:
    """Return the topics of nodes by address; what an ingestion hears is the raw input, whatever it is called.

    What a driver of ours says elsewhere is not: `pdr live` passes it on, and both would be one topic in the recording.
    """
    found: dict[str, Spoken] = {}
    for node in nodes:
        for address, msgtype, hears in topics_of(graph, node):
            inside = address.strip("/")
            topic = inside.removeprefix(f"{home}/") if home and lies_in(inside, home) else inside
            if hears and node.name == INGESTION and msgtype in INPUTS:
                foot = node.namespace.removeprefix(home).strip("/")
                found[address] = Spoken(address, below(foot, INPUTS[msgtype]), msgtype)
            elif hears or msgtype not in INPUTS or lies_in(inside, home):
                found.setdefault(address, Spoken(address, topic, msgtype))
    return found


def topics_of(graph: Node, node: OurNode) -> Iterator[tuple[str, str, bool]]:
    """Yield address, message type and whether it is heard of every topic of a node that is not of every node."""
    with suppress(Exception):  # rclpy has an error of its own for a node that has gone
        said = graph.get_publisher_names_and_types_by_node(node.name, f"/{node.namespace}")
        heard = graph.get_subscriber_names_and_types_by_node(node.name, f"/{node.namespace}")
        for topics, hears in ((said, False), (heard, True)):
            for address, types in topics:
                if not address.endswith(OF_EVERY_NODE):
                    yield address, types[0], hears


def offered(graph: Node, address: str) -> QoSProfile | None:
    """Return the best delivery that all publishers of a topic offer; None where nobody publishes it."""
    infos = [info.qos_profile for info in graph.get_publishers_info_by_topic(address)]
    if not infos:
        return None
    reliable = all(qos.reliability == ReliabilityPolicy.RELIABLE for qos in infos)
    kept = all(qos.durability == DurabilityPolicy.TRANSIENT_LOCAL for qos in infos)
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=QUEUE,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if kept else DurabilityPolicy.VOLATILE,
    )

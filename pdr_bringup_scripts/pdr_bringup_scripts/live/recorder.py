"""Hears all that the nodes of a namespace say and hear, and writes it down as it comes."""

import time
from collections.abc import Callable
from functools import partial

from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

from pdr_bringup_scripts.live.cast import below
from pdr_bringup_scripts.live.graph import INPUTS, OurNode, Spoken, lies_in, offered, our_nodes, spoken
from pdr_bringup_scripts.live.listener import message_class
from pdr_bringup_scripts.live.node_parameters import AskedNode, together
from pdr_bringup_scripts.live.recorded_params import PARAMETERS
from pdr_core.params_file import params_text
from pdr_core.recording.mcap_writer import McapWriter

YAML = "application/yaml"
LOOK_S = 0.2  # between two looks at the graph
RAW = "/imu/data_raw"  # how the topics of samples end


class Recorder:
    """Subscribes to topics as they appear, and attaches the parameters of each namespace once its nodes have answered.

    `say` tells the user what is not recorded as it should be.
    """

    def __init__(self, graph: Node, home: str, file: McapWriter, say: Callable[[str], None]) -> None:
        self._graph, self._home, self._file, self._say = graph, home, file, say
        self._heard: set[str] = set()  # addresses
        self._there: set[OurNode] = set()
        self._asked: dict[OurNode, AskedNode] = {}  # all that ever were there
        self._attached: dict[str, str] = {}  # text by namespace
        self._look_s = 0.0

    def look(self) -> None:
        """Look what is new on the graph, not too often."""
        if time.monotonic() < self._look_s:
            return
        self._look_s = time.monotonic() + LOOK_S
        nodes = [node for node in our_nodes(self._graph) if lies_in(node.namespace, self._home)]
        for topic in spoken(self._graph, nodes, self._home).values():
            self._hear(topic)
        self._ask(nodes)

    @property
    def samples(self) -> dict[str, int]:
        """How many samples of each sensor were recorded."""
        return {topic: count for topic, count in self._file.counts.items() if topic.endswith(RAW)}

    @property
    def elsewhere(self) -> list[str]:
        """Return the namespaces in which nodes of ours are and are not recorded."""
        return sorted({f"/{n.namespace}" for n in our_nodes(self._graph) if not lies_in(n.namespace, self._home)})

    def _hear(self, topic: Spoken) -> None:
        qos = None if topic.address in self._heard else offered(self._graph, topic.address)
        if qos is None:
            return
        self._heard.add(topic.address)
        if not self._file.knows(topic.msgtype):
            self._say(f"pdr: {topic.address} is not recorded: {topic.msgtype} is not known here")
            return
        self._warn_of_losses(topic, qos)
        write = partial(self._write, f"/{topic.topic}", topic.msgtype)
        self._graph.create_subscription(message_class(topic.msgtype), topic.address, write, qos, raw=True)

    def _warn_of_losses(self, topic: Spoken, qos: QoSProfile) -> None:
        if topic.msgtype in INPUTS and qos.reliability == ReliabilityPolicy.BEST_EFFORT:
            text = f"pdr: {topic.address} is best-effort: the recording may miss samples that the nodes have, or they"
            self._say(f"{text} some that it has")

    def _write(self, topic: str, msgtype: str, cdr: bytes) -> None:
        self._file.write(topic, msgtype, time.time_ns(), cdr)

    def _ask(self, nodes: list[OurNode]) -> None:
        """Ask nodes that are new or back, and attach what is complete and new; what has gone has told what it read."""
        for node in set(nodes) - self._there:
            if node not in self._asked:
                self._asked[node] = AskedNode(self._graph, node.full_name)
            self._asked[node].ask_again()
        self._there = set(nodes)
        for namespace in {node.namespace for node in nodes}:
            here = [answer for node, answer in self._asked.items() if node.namespace == namespace]
            for answer in here:
                answer.look()
            if all(answer.own for answer in here):
                inside = namespace.removeprefix(self._home).strip("/")
                self._attach(below(inside, PARAMETERS), params_text(together(here)))

    def _attach(self, name: str, text: str) -> None:
        if self._attached.get(name) != text:
            self._attached[name] = text
            self._file.attach(name, YAML, time.time_ns(), text.encode())

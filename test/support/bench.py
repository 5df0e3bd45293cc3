"""A bench for one node: the node in this process, its inputs and outputs in the hands of the test."""

import time
from collections.abc import Callable, Iterable
from itertools import count

import rclpy
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.node import Node

from pdr_nodes.qos import OWN
from pdr_nodes.run import serve

DEADLINE_S = 120.0
NUMBERS = count()


class Bench:
    """A context manager. Nothing spins but in `until` and `spin`: the test owns the clock."""

    def __init__(self, make_node: Callable[[], Node] | None = None, namespace: str = "", **params: object) -> None:
        self.namespace = namespace or f"bench{next(NUMBERS)}"
        self._make_node = make_node
        self._params = {name.replace("__", ".", 1): value for name, value in params.items()}

    def __enter__(self) -> "Bench":
        self.node: Node | None = None
        self._started: list[Node] = []
        given = [part for name, value in self._params.items() for part in ("-p", f"{name}:={yaml_text(value)}")]
        rclpy.init(args=["--ros-args", "-r", f"__ns:=/{self.namespace}", "--log-level", "error", *given])
        self.executor = EventsExecutor()
        self.me = Node("bench", start_parameter_services=False, use_global_arguments=True)
        self.executor.add_node(self.me)
        try:
            self.node = self.start(self._make_node) if self._make_node else None
        except Exception:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        """Leave nothing of it on the graph."""
        self.executor.shutdown()
        for node in (*self._started, self.me):
            node.destroy_node()
        rclpy.try_shutdown()

    def start(self, make_node: Callable[[], Node]) -> Node:
        """Make a node, start it and serve it as long as the bench stands."""
        node = make_node()
        self._started.append(node)
        node.start()
        self.executor.add_node(node)
        return node

    def hear(self, kind: type, topic: str, qos: object = OWN) -> list:
        """Return a list that grows with every message that comes."""
        heard: list = []
        self.me.create_subscription(kind, topic, heard.append, qos)
        return heard

    def publisher(self, kind: type, topic: str, qos: object = OWN):
        """Return a publisher that the node under test already listens to."""
        publisher = self.me.create_publisher(kind, topic, qos)
        self.until(publisher.get_subscription_count, f"a subscriber of {topic}")
        return publisher

    def feed(self, publisher, messages: Iterable) -> None:
        """Publish all messages."""
        for message in messages:
            publisher.publish(message)

    def spin(self) -> None:
        """Serve what comes next."""
        if self.node:
            serve(self.executor, self.node, 0.05)
        else:
            self.executor.spin_once(timeout_sec=0.05)

    def until(self, condition: Callable[[], object], what: str, within_s: float = DEADLINE_S) -> None:
        """Serve callbacks until the condition holds; AssertionError says what never came."""
        deadline_s = time.monotonic() + within_s
        while not condition():
            if time.monotonic() > deadline_s:
                raise AssertionError(f"waited {within_s:.0f} s for {what}")
            self.spin()

    def call(self, kind: type, name: str, **request: object):
        """Call a service and return its answer."""
        client = self.me.create_client(kind, name)
        self.until(client.service_is_ready, f"service {name}")
        future = client.call_async(kind.Request(**request))
        self.until(future.done, f"the answer of {name}")
        return future.result()


def yaml_text(value: object) -> str:
    """Return a value as ROS reads it on the command line."""
    return f"'{value}'" if isinstance(value, str) else str(value).lower()

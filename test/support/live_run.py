"""A live run as one who only listens sees it: topics, stamps and processes, nothing of the nodes' insides."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.subscription import Subscription
from sensor_msgs.msg import Imu

from pdr_bringup_scripts.live.chain import NAMESPACE, Chain
from pdr_core.params import Params, params_as_mapping
from pdr_msgs.msg import FilterHealth
from pdr_nodes.convert import header_stamp_ns
from pdr_nodes.qos import OWN, STATUS
from support.usage import usage

SETTLED_S = 4.0  # the nodes have found each other, and caught up with what came before
LEFT_S = 2.0  # before the end of the walk, with which the driver ends
LAST_WORDS_S = 15.0  # within these the filter must have taken all samples


class Ear(Node):
    """Notes when samples were published, when estimates arrived, and how many samples the filter has taken.

    The times are the middleware's own, so it need not wait for messages: now and then it takes those that are there.
    """

    def __init__(self) -> None:
        super().__init__("ear", namespace=NAMESPACE, start_parameter_services=False)
        self.sent: dict[int, int] = {}  # header stamp -> time of publication, both [ns]
        self.arrived: dict[int, int] = {}  # header stamp -> time of reception, both [ns]
        self.taken = 0
        self._samples = self.create_subscription(Imu, "imu/data_raw", print, OWN, raw=True)
        self._estimates = self.create_subscription(Odometry, "odom", print, OWN, raw=True)
        self._health = self.create_subscription(FilterHealth, "filter_health", print, STATUS)

    def listen(self) -> None:
        """Take what has come."""
        for cdr, info in waiting(self._samples):
            self.sent[header_stamp_ns(cdr)] = info["source_timestamp"]
        for cdr, info in waiting(self._estimates):
            self.arrived[header_stamp_ns(cdr)] = info["received_timestamp"]
        for health, _ in waiting(self._health):
            self.taken = health.samples


def waiting(subscription: Subscription) -> Iterator[tuple[Any, dict[str, int]]]:
    """Yield the messages that wait in a subscription, with what the middleware says of them."""
    with subscription.handle:
        while taken := subscription.handle.take_message(subscription.msg_type, subscription.raw):
            yield taken


class LiveRun:
    """Runs the nodes of one foot on the device of the parameters, for `samples` samples in `seconds` seconds."""

    def __init__(self, params: Params, samples: int, seconds: float, logs: Path) -> None:
        self.cost: dict[str, tuple[float, float]] = {}  # of each node: share of a core, memory [MB]
        rclpy.init()
        self.ear = Ear()
        try:
            self._samples = samples
            with Chain(logs, params_as_mapping(params), NAMESPACE) as chain:
                self._listen(chain, seconds)
        finally:
            self.ear.destroy_node()
            rclpy.try_shutdown()

    def _listen(self, chain: Chain, seconds: float) -> None:
        self._until(lambda: self.ear.sent, LAST_WORDS_S)
        self._until(lambda: False, SETTLED_S)
        before, begin_s = {name: usage(pid) for name, pid in chain.pids.items()}, time.monotonic()
        self._until(lambda: False, seconds - SETTLED_S - LEFT_S)
        passed_s = time.monotonic() - begin_s
        for name, pid in chain.pids.items():
            now = usage(pid)
            self.cost[name] = (now.cpu_s - before[name].cpu_s) / passed_s, now.memory_mb
        self._until(lambda: self.ear.taken >= self._samples, LEFT_S + LAST_WORDS_S)
        chain.check()

    def _until(self, condition: Callable[[], object], within_s: float) -> None:
        deadline_s = time.monotonic() + within_s
        while not condition() and time.monotonic() < deadline_s:
            self.ear.listen()
            time.sleep(0.02)

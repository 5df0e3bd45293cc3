"""One topic that a node takes samples from: in blocks, without repeats, and never silently without any."""

import time
from collections.abc import Callable, Iterator
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_policy_name_from_kind
from rclpy.subscription import Subscription

from pdr_core.records import Level, Notice, joined, length
from pdr_nodes.notice_board import NO_INPUT
from pdr_nodes.publishers import publishers
from pdr_nodes.repeats import Repeats

BLOCK = 200  # messages taken in one go: then services and timers get their turn
SILENT_S = 2.0


class Input:
    """Subscribed to while the node is active.

    The messages that wait are taken in one go and given on as one block: the cost of a sample falls where a node
    cannot keep up, and a stage gives the same for a block as for its samples one by one.
    """

    def __init__(
        self,
        node: Node,
        kind: type,
        topic: str,
        qos: QoSProfile,
        block: Callable[[Any], tuple],
        take: Callable[[tuple], None],
        restarts_anew: bool,
    ) -> None:
        self._node, self._kind, self._topic, self._qos = node, kind, topic, qos
        self._block, self._take = block, take
        self._subscription: Subscription | None = None
        self._restarts_anew = restarts_anew
        self._repeats = Repeats()
        self._heard_s = 0.0
        self._refused = ""  # the policy for which a publisher does not match

    def begin(self) -> None:
        """Subscribe. What the topic remembers comes once more."""
        self._heard_s, self._refused = time.monotonic(), ""
        if self._qos.durability == DurabilityPolicy.TRANSIENT_LOCAL:
            self._repeats.expect()
        events = SubscriptionEventCallbacks(matched=self._matched, incompatible_qos=self._incompatible)
        self._subscription = self._node.create_subscription(
            self._kind, self._topic, self._heard, self._qos, event_callbacks=events
        )

    def end(self) -> None:
        """Subscribe no more."""
        if self._subscription:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

    @property
    def notices(self) -> list[Notice]:
        """What is wrong with the topic now."""
        if self._subscription is None:
            return []
        return [*self._silence(), *self._misfit()]

    def _heard(self, first: Any) -> None:
        self._heard_s = time.monotonic()
        block = self._repeats.left_out(joined([self._block(message) for message in (first, *self._waiting())]))
        if length(block):
            self._take(block)

    def _waiting(self) -> Iterator[Any]:
        """Take what waits behind the first message; the executor then finds nothing there, which it allows."""
        for _ in range(BLOCK - 1):
            taken = self._subscription.handle.take_message(self._kind, False) if self._subscription else None
            if taken is None:
                return
            yield taken[0]

    def _matched(self, info: Any) -> None:
        if info.current_count_change > 0 and not self._restarts_anew:
            self._repeats.expect()

    def _incompatible(self, info: Any) -> None:
        self._refused = qos_policy_name_from_kind(info.last_policy_kind).lower()

    def _silence(self) -> Iterator[Notice]:
        silent_s = time.monotonic() - self._heard_s
        if silent_s > SILENT_S:
            who = ", ".join(publishers(self._node, self._topic)) or "none"
            question = f"is its publisher running, is the topic right? Publishers there: {who}"
            yield Notice(Level.WARN, NO_INPUT, f"no samples on {self._name} for {SILENT_S:.0f} s: {question}", 1, 0)

    def _misfit(self) -> Iterator[Notice]:
        if self._refused:
            way_out = (
                "let it publish reliable and transient local; for a driver, node.input_reliable: false asks for less"
            )
            text = f"a publisher of {self._name} offers less {self._refused} than is asked for: {way_out}"
            yield Notice(Level.WARN, "incompatible_qos", text, 1, 0)

    @property
    def _name(self) -> str:
        return self._node.resolve_topic_name(self._topic)

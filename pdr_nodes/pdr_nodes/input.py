"""One topic that a node takes samples from: in blocks, without repeats, and never silently without any."""

import time
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, NamedTuple

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_policy_name_from_kind
from rclpy.subscription import Subscription

from pdr_core.records import Level, Notice, joined
from pdr_nodes import publishers
from pdr_nodes.notice_board import NO_INPUT
from pdr_nodes.repeats import Repeats

SILENT_S = 2.0


class Words(NamedTuple):
    """What is said of a topic without messages, and by what names it is known."""

    what: str = "samples"
    silent: str = NO_INPUT  # kinds of notice
    misfit: str = "incompatible_qos"
    question: str = "is its publisher running, is the topic right?"


SAMPLES = Words()


class Input:
    """Subscribed to while the node is active. Messages are collected as they come, and given on as one block.

    So the cost of a sample falls where a node cannot keep up; a stage makes the same of a block as of its samples.
    """

    def __init__(
        self,
        node: Node,
        kind: type,
        topic: str,
        qos: QoSProfile,
        block: Callable[[Any], tuple | None],
        take: Callable[[tuple], None],
        restarts_anew: bool,
        words: Words = SAMPLES,
    ) -> None:
        self._node, self._kind, self._topic, self._qos = node, kind, topic, qos
        self._block, self._take, self._words = block, take, words
        self._blocks: list[tuple] = []  # of one sample each
        self._subscription: Subscription | None = None
        self._repeats = Repeats(frozenset if restarts_anew else partial(publishers.identities, node, topic))
        self._heard_s = 0.0
        self._refused = ""  # the policy for which a publisher does not match

    def begin(self) -> None:
        """Subscribe. What the topic remembers comes once more."""
        self._heard_s, self._refused = time.monotonic(), ""
        if self._qos.durability == DurabilityPolicy.TRANSIENT_LOCAL:
            self._repeats.expect()
        events = SubscriptionEventCallbacks(incompatible_qos=self._incompatible)
        self._subscription = self._node.create_subscription(
            self._kind, self._topic, self._heard, self._qos, event_callbacks=events
        )

    def end(self) -> None:
        """Give on what has come, and subscribe no more."""
        self.give()
        if self._subscription:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

    @property
    def notices(self) -> list[Notice]:
        """What is wrong with the topic now."""
        if self._subscription is None:
            return []
        return [*self._silence(), *self._misfit()]

    @property
    def waiting(self) -> int:
        """How many messages have come that were not given on."""
        return len(self._blocks)

    def give(self) -> None:
        """Give on what has come."""
        if self._blocks:
            blocks, self._blocks = self._blocks, []
            self._take(joined(blocks) if len(blocks) > 1 else blocks[0])

    def _heard(self, message: Any) -> None:
        self._heard_s = time.monotonic()
        block = self._block(message)
        if block and not self._repeats.has(stamp_ns(block)):
            self._blocks.append(block)

    def _incompatible(self, info: Any) -> None:
        self._refused = qos_policy_name_from_kind(info.last_policy_kind).lower()

    def _silence(self) -> Iterator[Notice]:
        silent_s = time.monotonic() - self._heard_s
        if silent_s > SILENT_S:
            who = ", ".join(publishers.names(self._node, self._topic)) or "none"
            nothing = f"no {self._words.what} on {self._name} for {SILENT_S:.0f} s"
            text = f"{nothing}: {self._words.question} Publishers there: {who}"
            yield Notice(Level.WARN, self._words.silent, text, 1, 0)

    def _misfit(self) -> Iterator[Notice]:
        if self._refused:
            way_out = (
                "let it publish reliable and transient local; for a driver, node.input_reliable: false asks for less"
            )
            text = f"a publisher of {self._name} offers less {self._refused} than is asked for: {way_out}"
            yield Notice(Level.WARN, self._words.misfit, text, 1, 0)

    @property
    def _name(self) -> str:
        return self._node.resolve_topic_name(self._topic)


def stamp_ns(block: tuple) -> int:
    """Return the stamp of a block of one sample [ns]."""
    first = block[0]
    return stamp_ns(first) if isinstance(first, tuple) else int(first[0])

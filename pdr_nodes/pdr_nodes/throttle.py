"""Plays as fast as the chain takes it: only so many samples are on their way at a time."""

import struct
import time
from collections import deque

from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.subscription import Subscription

from pdr_core.conventions import NANOSECONDS
from pdr_core.records import Level, Notice
from pdr_nodes.qos import OWN

ON_THEIR_WAY = 1000  # a tenth of what the queue of a topic holds, so that none can overflow
STALLED_S = 5.0  # where none of them comes back for so long, they were left out on the way: send as many again
LOOK_S = 0.05


class Throttle:
    """Takes a stamp that the end of the chain publishes as acknowledgement of all samples up to it."""

    def __init__(self, node: Node, topic: str) -> None:
        self._node, self._topic = node, topic
        self._stamps_ns: deque[int] = deque()
        self._moved_s = 0.0  # when the last acknowledgement came, or the first sample after all were acknowledged left
        self._subscription: Subscription | None = None
        self._stalls = 0

    def begin(self) -> None:
        """Listen to the end of the chain."""
        self._subscription = self._node.create_subscription(Odometry, self._topic, self._acknowledge, OWN, raw=True)

    def end(self) -> None:
        """Listen no more."""
        if self._subscription:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

    @property
    def ready(self) -> bool:
        """Somebody is there to acknowledge."""
        return self._subscription is not None and self._subscription.get_publisher_count() > 0

    @property
    def notices(self) -> list[Notice]:
        """Whether the chain takes what is sent."""
        if not self._stalls:
            return []
        text = f"nothing on {self._topic} for {STALLED_S:.0f} s, sent {ON_THEIR_WAY} more: does the chain run?"
        return [Notice(Level.WARN, "not_acknowledged", text, self._stalls, 0)]

    def wait_s(self, _stamp_ns: int) -> float:
        """Return 0 if one more sample may be sent, else the time [s] until it is worth asking again."""
        if len(self._stamps_ns) >= ON_THEIR_WAY and time.monotonic() - self._moved_s > STALLED_S:
            self._stamps_ns.clear()
            self._stalls += 1
        return 0.0 if len(self._stamps_ns) < ON_THEIR_WAY else LOOK_S

    def sent(self, stamp_ns: int) -> None:
        """Note that a sample is on its way."""
        if not self._stamps_ns:
            self._moved_s = time.monotonic()
        self._stamps_ns.append(stamp_ns)

    def _acknowledge(self, cdr: bytes) -> None:
        seconds, nanoseconds = struct.unpack_from("<iI", cdr, 4)  # the header's stamp follows 4 bytes of encapsulation
        stamp_ns = seconds * NANOSECONDS + nanoseconds
        self._moved_s = time.monotonic()
        while self._stamps_ns and self._stamps_ns[0] <= stamp_ns:
            self._stamps_ns.popleft()

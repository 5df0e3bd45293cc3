"""Plays as fast as the chain takes it: only so many samples are on their way at a time."""

import struct
import time
from collections import deque

from nav_msgs.msg import Odometry
from rclpy.node import Node

from pdr_core.conventions import NANOSECONDS
from pdr_nodes.qos import OWN

ON_THEIR_WAY = 1000  # a tenth of what the queue of a topic holds, so that none can overflow
STALLED_S = 5.0  # where none of them comes back for so long, they were left out on the way: go on


class Throttle:
    """Takes the stamps that the end of the chain publishes as acknowledgement of all samples up to them."""

    def __init__(self, node: Node, topic: str) -> None:
        self._stamps_ns: deque[int] = deque()
        self._moved_s = time.monotonic()
        self._subscription = node.create_subscription(Odometry, topic, self._acknowledge, OWN, raw=True)

    @property
    def open(self) -> bool:
        """One more sample may be sent."""
        if len(self._stamps_ns) >= ON_THEIR_WAY and time.monotonic() - self._moved_s > STALLED_S:
            self._stamps_ns.clear()
        return len(self._stamps_ns) < ON_THEIR_WAY

    def sent(self, stamp_ns: int) -> None:
        """Note that a sample is on its way."""
        self._stamps_ns.append(stamp_ns)

    def _acknowledge(self, cdr: bytes) -> None:
        seconds, nanoseconds = struct.unpack_from("<iI", cdr, 4)  # the header's stamp follows 4 bytes of encapsulation
        stamp_ns = seconds * NANOSECONDS + nanoseconds
        self._moved_s = time.monotonic()
        while self._stamps_ns and self._stamps_ns[0] <= stamp_ns:
            self._stamps_ns.popleft()

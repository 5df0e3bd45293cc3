"""Plays as fast as the chain takes it: only so many samples are on their way at a time."""

import time
from collections import deque

from nav_msgs.msg import Odometry
from rclpy.node import Node

from pdr_core.records import Level, Notice
from pdr_msgs.msg import WalkStatus
from pdr_nodes.convert import header_stamp_ns
from pdr_nodes.hearing import Hearing
from pdr_nodes.pace import Pace
from pdr_nodes.qos import ANSWERS, OWN

ON_THEIR_WAY = 1000  # a tenth of what the queue of a topic holds, so that none can overflow
STALLED_S = 5.0  # where none of them comes back for so long, they were left out on the way: send as many again
LOOK_S = 0.05


KINDS = {"walk": (WalkStatus, ANSWERS)}  # by the last part of the topic; others are odometry


class Throttle:
    """Takes a stamp that the end of the chain publishes as acknowledgement of all samples up to it."""

    def __init__(self, node: Node, topic: str, most: int = ON_THEIR_WAY) -> None:
        self._topic, self._most = topic, most
        kind, qos = KINDS.get(topic.rpartition("/")[2], (Odometry, OWN))
        self._hearing = Hearing(node, kind, topic, self._acknowledge, qos, raw=True)
        self._stamps_ns: deque[int] = deque()
        self._moved_s = 0.0  # when the last acknowledgement came, or the first sample after all were acknowledged left
        self._stalls = 0

    def begin(self) -> None:
        """Listen to the end of the chain."""
        self._hearing.begin()

    def end(self) -> None:
        """Listen no more."""
        self._hearing.end()

    @property
    def ready(self) -> bool:
        """Somebody is there to acknowledge."""
        return self._hearing.publishers > 0

    @property
    def notices(self) -> list[Notice]:
        """Whether the chain takes what is sent."""
        if not self._stalls:
            return []
        text = f"nothing on {self._topic} for {STALLED_S:.0f} s, sent {self._most} more: does the chain run?"
        return [Notice(Level.WARN, "not_acknowledged", text, self._stalls, 0)]

    def wait_s(self, _stamp_ns: int) -> float:
        """Return 0 if one more sample may be sent, else the time [s] until it is worth asking again."""
        if len(self._stamps_ns) >= self._most and time.monotonic() - self._moved_s > STALLED_S:
            self._stamps_ns.clear()
            self._stalls += 1
        return 0.0 if len(self._stamps_ns) < self._most else LOOK_S

    def sent(self, stamp_ns: int) -> None:
        """Note that a sample is on its way."""
        if not self._stamps_ns:
            self._moved_s = time.monotonic()
        self._stamps_ns.append(stamp_ns)

    def _acknowledge(self, cdr: bytes) -> None:
        stamp_ns = header_stamp_ns(cdr)
        self._moved_s = time.monotonic()
        while self._stamps_ns and self._stamps_ns[0] <= stamp_ns:
            self._stamps_ns.popleft()


class Limited:
    """Plays at a pace, but never far ahead of the end of the chain: what answers the samples then answers in time."""

    def __init__(self, pace: Pace, throttle: Throttle) -> None:
        self._pace, self._throttle = pace, throttle

    def begin(self) -> None:
        """Begin both."""
        self._throttle.begin()
        self._pace.begin()

    def end(self) -> None:
        """End both."""
        self._pace.end()
        self._throttle.end()

    @property
    def ready(self) -> bool:
        """Somebody is there to acknowledge."""
        return self._throttle.ready

    @property
    def notices(self) -> list[Notice]:
        """Whether the chain takes what is sent."""
        return self._throttle.notices

    def wait_s(self, stamp_ns: int) -> float:
        """Return the time [s] until a sample is due."""
        return max(self._pace.wait_s(stamp_ns), self._throttle.wait_s(stamp_ns))

    def sent(self, stamp_ns: int) -> None:
        """Note that a sample is on its way."""
        self._throttle.sent(stamp_ns)

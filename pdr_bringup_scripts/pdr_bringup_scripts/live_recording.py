"""Reads what the nodes have said back from a recording."""

from collections.abc import Iterator
from itertools import islice, zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from pdr_bringup_scripts.problems import Problem
from pdr_core.pipeline import FootOutput
from pdr_core.records import Notice, joined
from pdr_nodes.convert import nav_block, stamp_ns, stance_block, step_event
from pdr_nodes.notice_board import NO_FIELD, NO_INPUT, ORIENTATION, notices_from
from pdr_nodes.rate_limit import RateLimit

PIECE = 5000


def outputs(bag: Path, odom_rate_hz: float) -> Iterator[FootOutput]:
    """Yield the estimates in pieces, each with its verdict, and all steps with the first piece.

    Of the estimates, at most so many a second are said: which ones, the stamps of the verdicts tell.
    """
    steps = [step_event(m) for m in messages(bag, "step")]
    limit = RateLimit(odom_rate_hz)
    said = (m for m in messages(bag, "stance") if limit.allows(stamp_ns(m.imu.header.stamp)))
    pairs = zip_longest(said, messages(bag, "odom"))
    while piece := list(islice(pairs, PIECE)):
        if None in piece[-1]:
            raise Problem(f"{bag}: verdicts and estimates are not as many: messages were lost on the way")
        judged = joined([stance_block(stance) for stance, _ in piece])
        nav = joined([nav_block(odometry) for _, odometry in piece])
        if not np.array_equal(judged.imu.stamp_ns, nav.stamp_ns):
            raise Problem(f"{bag}: verdicts and estimates do not belong together: messages were lost on the way")
        yield FootOutput(judged, nav, steps)
        steps = []


def notices(bag: Path, namespace: str) -> list[Notice]:
    """Return the last word of every node of our namespace on what was wrong with the track: anybody speaks there.

    That samples and fields have come to their end is not wrong.
    """
    spoken = (status for m in messages(bag, "diagnostics") for status in m.status)
    ours = (status for status in spoken if status.name.startswith(f"{namespace}/"))
    last = {status.name: status for status in ours if not status.name.endswith(f": {ORIENTATION}")}
    found = [notice for status in last.values() for notice in notices_from(status.values)]
    return [notice for notice in found if notice.kind not in (NO_INPUT, NO_FIELD)]


def messages(bag: Path, topic: str) -> Iterator[Any]:
    """Yield the messages of a topic, named without its leading slash, in the order in which they came."""
    from rosbags.highlevel import AnyReader

    with AnyReader([bag]) as reader:
        connections = [c for c in reader.connections if c.topic.strip("/") == topic]
        for connection, _, raw in reader.messages(connections=connections) if connections else ():
            yield reader.deserialize(raw, connection.msgtype)

"""Reads what the nodes have said back from a recording."""

from collections.abc import Iterator
from itertools import islice, zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from pdr_bringup_scripts.live.cast import below
from pdr_bringup_scripts.problems import Problem
from pdr_core.pipeline import FootOutput
from pdr_core.rate_limit import RateLimit
from pdr_core.records import NavBlock, Notice, StanceBlock, inertial_block, joined, length
from pdr_nodes.convert import nav_block, stamp_ns, stance_block, step_event
from pdr_nodes.notice_board import NO_FIELD, NO_INPUT, ORIENTATION, notices_from

PIECE = 5000


def outputs(bag: Path, foot: str, odom_rate_hz: float) -> Iterator[FootOutput]:
    """Yield the estimates of a foot in pieces, each with its verdict, and all steps with the first piece.

    Of the estimates, at most so many a second are said: which ones, the stamps of the verdicts tell.
    """
    steps = [step_event(m) for m in messages(bag, below(foot, "step"))]
    limit = RateLimit(odom_rate_hz)
    said = (m for m in messages(bag, below(foot, "stance")) if limit.allows(stamp_ns(m.imu.header.stamp)))
    pairs = zip_longest(said, messages(bag, below(foot, "odom")))
    while piece := list(islice(pairs, PIECE)):
        if None in piece[-1]:
            raise Problem(f"{bag}: verdicts and estimates are not as many: messages were lost on the way")
        judged = joined([stance_block(stance) for stance, _ in piece])
        nav = joined([nav_block(odometry) for _, odometry in piece])
        if not np.array_equal(judged.imu.stamp_ns, nav.stamp_ns):
            raise Problem(f"{bag}: verdicts and estimates do not belong together: messages were lost on the way")
        yield FootOutput(judged, nav, steps)
        steps = []


def chest_outputs(bag: Path) -> Iterator[FootOutput]:
    """Yield the estimates of a card on the chest in pieces, and all steps with the first piece."""
    steps = [step_event(m) for m in messages(bag, "step")]
    for nav in navs(bag, "odom"):
        yield FootOutput(resting(nav), nav, steps)
        steps = []


def resting(nav: NavBlock) -> StanceBlock:
    """Return when a chest rests: while it does, its estimate is held and has no velocity at all."""
    zero = np.zeros(length(nav))
    level = np.zeros((length(nav), 3))
    rests = np.linalg.norm(nav.velocity_mps, axis=1) == 0.0
    return StanceBlock(inertial_block(nav.stamp_ns, level, level, zero, zero), rests, zero, zero, zero, level, zero)


def body(bag: Path) -> Iterator[NavBlock]:
    """Yield the estimates of the person between two feet in pieces."""
    return navs(bag, "odom")


def navs(bag: Path, topic: str) -> Iterator[NavBlock]:
    """Yield the estimates of a topic in pieces."""
    said = messages(bag, topic)
    while piece := list(islice(said, PIECE)):
        yield joined([nav_block(odometry) for odometry in piece])


def notices(bag: Path, begin: str) -> list[Notice]:
    """Return the last word of every node whose full name begins so, on what was wrong: anybody speaks there.

    That samples, fields and estimates have come to their end is not wrong, and orientation is not the track.
    """
    spoken = (status for m in messages(bag, "diagnostics") for status in m.status)
    ours = (status for status in spoken if status.name.startswith(begin))
    last = {status.name: status for status in ours if not status.name.endswith(f": {ORIENTATION}")}
    found = [notice for status in last.values() for notice in notices_from(status.values)]
    return [notice for notice in found if not notice.kind.startswith((NO_INPUT, NO_FIELD))]


def messages(bag: Path, topic: str) -> Iterator[Any]:
    """Yield the messages of a topic, named without its leading slash, in the order in which they came."""
    return (message for _, message in timed_messages(bag, topic))


def timed_messages(bag: Path, topic: str) -> Iterator[tuple[int, Any]]:
    """Yield the messages with the time of the wall clock at which they came [ns]."""
    from rosbags.highlevel import AnyReader

    with AnyReader([bag]) as reader:
        connections = [c for c in reader.connections if c.topic.strip("/") == topic]
        for connection, came_ns, raw in reader.messages(connections=connections) if connections else ():
            yield came_ns, reader.deserialize(raw, connection.msgtype)

"""The pitch of the foot: how far its walking direction points below the horizon, so heel up is positive (REP-103).

With `ahead` the walking direction and `up` the vertical, both unit vectors in foot axes, the height of the tip of
`ahead` is up' ahead, and pitch = -asin(up' ahead): Qiu's theta of eq. 2 for the body that the alignment gives, without
its singularity in the mounting. Beyond a right angle, as in crawling, it falls again.
"""

import numpy as np

from pdr_core.gait.samples import Cycle
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Vector, dot
from pdr_core.records import CYCLE_POINTS, Floats


@compiled
def pitch_rad(up: Vector, ahead: Vector) -> float:
    """Return the pitch of a foot, -pi/2 .. pi/2."""
    return -np.arcsin(min(1.0, max(-1.0, dot(up, ahead))))


@compiled
def range_rad(cycle: Cycle, ahead: Vector) -> tuple[float, float]:
    """Return the largest and the smallest pitch of a stride."""
    highest, lowest = -1.0, 1.0
    for i in range(cycle.first, cycle.last + 1):
        height = dot(cycle.samples.up[i], ahead)
        highest, lowest = max(highest, height), min(lowest, height)
    return -np.arcsin(max(-1.0, lowest)), -np.arcsin(min(1.0, highest))


@compiled
def cycle_rad(cycle: Cycle, ahead: Vector) -> Floats:
    """Return the pitch at CYCLE_POINTS evenly spaced times from the beginning of a stride to its end, (CYCLE_POINTS,).

    Between two samples it is interpolated; a stride without samples missing has ascending stamps.
    """
    since_ns = cycle.samples.stamp_ns - cycle.samples.stamp_ns[cycle.first]
    up, row, out = cycle.samples.up, cycle.first, np.empty(CYCLE_POINTS)
    for k in range(CYCLE_POINTS):
        at_ns = since_ns[cycle.last] * k / (CYCLE_POINTS - 1)
        while row < cycle.last - 1 and since_ns[row + 1] <= at_ns:
            row += 1
        share = (at_ns - since_ns[row]) / (since_ns[row + 1] - since_ns[row])
        before_rad = pitch_rad(up[row], ahead)
        out[k] = before_rad + share * (pitch_rad(up[row + 1], ahead) - before_rad)
    return out

"""The pitch of the foot: how far its walking direction points below the horizon, so heel up is positive (REP-103).

With `ahead` the walking direction and `up` the vertical, both unit vectors in foot axes, the height of the tip of
`ahead` is up' ahead, and pitch = -asin(up' ahead): Qiu's theta of eq. 2 for the body that the alignment gives, without
its singularity in the mounting. Beyond a right angle, as in crawling, it falls again.
"""

import numpy as np

from pdr_core.gait.samples import Samples
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Vector, dot
from pdr_core.records import Floats
from pdr_core.records_gait import CYCLE_POINTS


@compiled
def pitch_rad(up: Vector, ahead: Vector) -> float:
    """Return the pitch of a foot, -pi/2 .. pi/2."""
    return -np.arcsin(min(1.0, max(-1.0, dot(up, ahead))))


@compiled
def over_stride(s: Samples, first: int, last: int, ahead: Vector) -> tuple[float, float, Floats]:
    """Return the largest and the smallest pitch from one row to another, and its course, (CYCLE_POINTS,)."""
    highest, lowest = -1.0, 1.0
    for i in range(first, last + 1):
        height = dot(s[i].up, ahead)
        highest, lowest = max(highest, height), min(lowest, height)
    return -np.arcsin(max(-1.0, lowest)), -np.arcsin(min(1.0, highest)), course_rad(s, first, last, ahead)


@compiled
def course_rad(s: Samples, first: int, last: int, ahead: Vector) -> Floats:
    """Return the pitch at evenly spaced times from one row to another, (CYCLE_POINTS,).

    Between two samples it is interpolated. The stamps must ascend, as they do in a stride of which all is seen.
    """
    i, out = first, np.empty(CYCLE_POINTS)
    for k in range(CYCLE_POINTS):
        after_ns = (s[last].stamp_ns - s[first].stamp_ns) * k / (CYCLE_POINTS - 1)
        while i < last - 1 and s[i + 1].stamp_ns - s[first].stamp_ns <= after_ns:
            i += 1
        share = (after_ns - (s[i].stamp_ns - s[first].stamp_ns)) / (s[i + 1].stamp_ns - s[i].stamp_ns)
        before_rad = pitch_rad(s[i].up, ahead)
        out[k] = before_rad + share * (pitch_rad(s[i + 1].up, ahead) - before_rad)
    return out

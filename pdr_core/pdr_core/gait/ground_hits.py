"""When a foot hits the ground, walking or running, from how far its acceleration is from that of a standing foot.

A stride shows two peaks of that distance: at push-off, and a larger one where the leg brakes the swing. Then the foot
comes down, and the distance falls. Two things end a stride:

    still   the foot is still: so after every walked stride, also a weak one
    dip     a runner's foot is never still. After a strong braking peak a fall to a share of it is a stance, unless a
            stronger peak follows within a time that is longer than from push-off to braking; nor is the dip between
            push-off and braking one, which comes too soon after the foot was still

The hit is where the distance falls below that of a foot that may stand, or is least within the dip.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.gait.foot_motion import MotionBlock
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, fresh, record
from pdr_core.params import GaitParams
from pdr_core.records import Flags, Stamps


class HitLimits(NamedTuple):
    """What makes a ground hit."""

    calm_mps2: float
    weakest_mps2: float
    strong_mps2: float
    dip_share: float
    dip_wait_ns: int
    shortest_ns: int


MEMORY = record(  # the stride so far
    [
        ("peak_mps2", np.float64),  # largest distance
        ("peak_ns", np.int64),
        ("dip_mps2", np.float64),  # least distance since then
        ("dip_ns", np.int64),
        ("still_ns", np.int64),  # when the foot was still last; NO_STAMP: not since the last gap
        ("low_ns", np.int64),  # since when the distance is that of a foot that may stand; NO_STAMP: it is not
    ],
)


class GroundHits:
    """Motion in, ground hits out."""

    def __init__(self, params: GaitParams) -> None:
        self._limits = hit_limits(params)
        self._memory = fresh(MEMORY)
        begin_anew(self._memory[0])

    def run(self, motion: MotionBlock) -> tuple[Stamps, Flags]:
        """Return for each value, (n,), the stamp of the hit that it shows, or NO_STAMP; and whether by a dip."""
        return hits(motion, self._limits, self._memory[0])


def hit_limits(p: GaitParams) -> HitLimits:
    """Derive the limits from the parameters."""
    times_ns = nanoseconds(p.dip_wait_s), nanoseconds(p.swing_shortest_s)
    return HitLimits(p.calm_mps2, p.weakest_mps2, p.strong_mps2, p.dip_share, *times_ns)


@compiled
def begin_anew(s: Memory) -> None:
    """Know nothing of a stride."""
    s.peak_mps2, s.still_ns, s.low_ns = 0.0, NO_STAMP, NO_STAMP


@compiled
def hits(motion: MotionBlock, limits: HitLimits, s: Memory) -> tuple[Stamps, Flags]:
    """Return the hits that the next values show."""
    n = motion.stamp_ns.shape[0]
    found, by_dip = np.full(n, NO_STAMP, np.int64), np.zeros(n, np.bool_)
    for i in range(n):
        if motion.fresh[i]:
            begin_anew(s)
        follow(motion.stamp_ns[i], motion.distance_mps2[i], limits.calm_mps2, s)
        if motion.still[i]:
            if s.peak_mps2 >= limits.weakest_mps2:
                found[i] = s.low_ns
            s.peak_mps2, s.still_ns = 0.0, motion.stamp_ns[i]
        elif dipped(motion.stamp_ns[i], limits, s):
            found[i], by_dip[i] = s.dip_ns, True
            s.peak_mps2 = 0.0
    return found, by_dip


@compiled
def follow(stamp_ns: int, distance_mps2: float, calm_mps2: float, s: Memory) -> None:
    """Take the next distance into the stride."""
    if distance_mps2 > s.peak_mps2:
        s.peak_mps2, s.peak_ns = distance_mps2, stamp_ns
        s.dip_mps2 = np.inf
    if distance_mps2 <= s.dip_mps2:
        s.dip_mps2, s.dip_ns = distance_mps2, stamp_ns
    if distance_mps2 >= calm_mps2:
        s.low_ns = NO_STAMP
    elif s.low_ns == NO_STAMP:
        s.low_ns = stamp_ns


@compiled
def dipped(stamp_ns: int, limits: HitLimits, s: Memory) -> bool:
    """Return whether a strong peak was followed by a dip, and by no stronger peak for long enough."""
    strong = s.peak_mps2 >= limits.strong_mps2 and s.dip_mps2 <= limits.dip_share * s.peak_mps2
    in_swing = s.still_ns != NO_STAMP and s.dip_ns - s.still_ns < limits.shortest_ns
    return strong and not in_swing and stamp_ns - s.peak_ns >= limits.dip_wait_ns

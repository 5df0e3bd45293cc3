"""When a foot leaves the ground and comes down, and how high it is in between (Qiu section 2.3 and figure 11).

A stride goes from the end of one stance to the end of the next. Its middle is where the foot is fastest. Before it, the
foot leaves the ground where it is tipped farthest from how it stood: the rate about the ankle passes zero. After it,
the heel strikes at a peak of the specific force: the sharpest, whose flank is the largest change between two samples,
since braking alone can be stronger than a soft strike. It is looked for from where the foot has lost half of its
largest speed until it stands.
"""

from typing import NamedTuple

from pdr_core.gait.samples import Cycle, Samples, stood_from
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import difference, dot, row

BRAKED = 0.5  # share of the largest speed below which a heel strikes
LANDED = 0.25  # below which a standing foot is no false stance amid the swing
SHORTEST_PATH_M = 0.1  # a shorter step has no line along which its ground rises


class Marks(NamedTuple):
    """Rows of a cycle, and what happens in between."""

    flat_before: int  # where the foot is stillest in the stance before
    flat_after: int
    toe_off: int
    heel_strike: int
    landed: int  # the first row of the stance
    clearance_m: float
    seen: bool  # no gap, and the gyro on


@compiled
def marks(cycle: Cycle) -> Marks:
    """Return the marks of a cycle."""
    s, first, last = cycle
    fastest = first
    for i in range(first, last + 1):
        fastest = i if s.speed_mps[i] > s.speed_mps[fastest] else fastest
    flat_before = stillest(s, first)
    landed = landing(s, fastest, last)
    seen = True
    for i in range(flat_before + 1, last + 1):
        seen = seen and s.seen[i]
    return Marks(
        flat_before,
        stillest(s, last),
        toe_off(s, flat_before, first, fastest),
        heel_strike(s, fastest, landed),
        landed,
        clearance_m(s, first, last),
        seen,
    )


@compiled
def stillest(s: Samples, end: int) -> int:
    """Return the row of the least statistic within the last second of the stance that ends at a row."""
    best = end
    for i in range(stood_from(s.stamp_ns, s.standing, end), end):
        best = i if s.standing[i] and s.statistic[i] < s.statistic[best] else best
    return best


@compiled
def landing(s: Samples, fastest: int, last: int) -> int:
    """Return the first row after the fastest one at which the foot stands."""
    for i in range(fastest, last):
        if s.standing[i] and s.speed_mps[i] < LANDED * s.speed_mps[fastest]:
            return i
    return last


@compiled
def toe_off(s: Samples, flat: int, first: int, fastest: int) -> int:
    """Return the row before the fastest one at which the foot is tipped farthest from the flat one."""
    best, least = first, 1.0
    for i in range(first, fastest + 1):
        cosine = dot(s.up[i], s.up[flat])
        if cosine < least:
            best, least = i, cosine
    return best


@compiled
def heel_strike(s: Samples, fastest: int, landed: int) -> int:
    """Return the row of the sharpest peak of the force between the braking foot and the standing one."""
    begin = fastest
    while begin < landed and s.speed_mps[begin] >= BRAKED * s.speed_mps[fastest]:
        begin += 1
    best = begin
    for i in range(begin, landed + 1):
        best = i if s.jolt_mps2[i] > s.jolt_mps2[best] else best
    falls = best > 0 and s.force_mps2[best - 1] > s.force_mps2[best]
    return best - 1 if falls else best


@compiled
def clearance_m(s: Samples, first: int, last: int) -> float:
    """Return the largest height above the line from the place of row `first` to that of row `last`."""
    start_m = row(s.position_m, first)
    whole_m = difference(row(s.position_m, last), start_m)
    path_m2 = max(whole_m[0] ** 2 + whole_m[1] ** 2, SHORTEST_PATH_M**2)
    largest_m = 0.0
    for i in range(first, last + 1):
        there_m = difference(row(s.position_m, i), start_m)
        along = (there_m[0] * whole_m[0] + there_m[1] * whole_m[1]) / path_m2
        largest_m = max(largest_m, there_m[2] - min(max(along, 0.0), 1.0) * whole_m[2])
    return largest_m

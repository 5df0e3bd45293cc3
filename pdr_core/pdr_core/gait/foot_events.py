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
from pdr_core.maths.vector import difference, dot

BRAKED = 0.5  # share of the largest speed below which a heel strikes
LANDED = 0.25  # below which a standing foot is no false stance amid the swing
SHORTEST_PATH_M = 0.1  # a shorter step has no line along which its ground rises


class Marks(NamedTuple):
    """What happens in a stride."""

    flat_before: int  # the row where the foot is stillest in the stance before
    flat_after: int
    toe_off_ns: int
    heel_strike_ns: int
    standing_ns: int  # how long the stance after it lasts
    clearance_m: float
    seen: bool  # no gap, and the gyro on


def marks(cycle: Cycle) -> Marks:
    """Return the marks of a stride."""
    return Marks(*found(*cycle))


@compiled
def found(s: Samples, first: int, last: int) -> tuple[int, int, int, int, int, float, bool]:
    """Return the marks of the stride from one row to another."""
    fastest = first
    for i in range(first, last + 1):
        fastest = i if s[i].speed_mps > s[fastest].speed_mps else fastest
    flat_before, landed = stillest(s, first), landing(s, fastest, last)
    seen = True
    for i in range(flat_before + 1, last + 1):
        seen = seen and s[i].seen
    return (
        flat_before,
        stillest(s, last),
        s[toe_off(s, flat_before, first, fastest)].stamp_ns,
        s[heel_strike(s, fastest, landed)].stamp_ns,
        s[last].stamp_ns - s[landed].stamp_ns,
        clearance_m(s, first, last),
        seen,
    )


@compiled
def stillest(s: Samples, end: int) -> int:
    """Return the row of the least statistic within the last second of the stance that ends at a row."""
    best = end
    for i in range(stood_from(s, end), end):
        best = i if s[i].standing and s[i].statistic < s[best].statistic else best
    return best


@compiled
def landing(s: Samples, fastest: int, last: int) -> int:
    """Return the first row after the fastest one at which the foot stands."""
    for i in range(fastest, last):
        if s[i].standing and s[i].speed_mps < LANDED * s[fastest].speed_mps:
            return i
    return last


@compiled
def toe_off(s: Samples, flat: int, first: int, fastest: int) -> int:
    """Return the row before the fastest one at which the foot is tipped farthest from the flat one."""
    best, least = first, 1.0
    for i in range(first, fastest + 1):
        cosine = dot(s[i].up, s[flat].up)
        if cosine < least:
            best, least = i, cosine
    return best


@compiled
def heel_strike(s: Samples, fastest: int, landed: int) -> int:
    """Return the row of the sharpest peak of the force between the braking foot and the standing one."""
    begin = fastest
    while begin < landed and s[begin].speed_mps >= BRAKED * s[fastest].speed_mps:
        begin += 1
    best = begin
    for i in range(begin, landed + 1):
        best = i if s[i].jolt_mps2 > s[best].jolt_mps2 else best
    falls = best > 0 and s[best - 1].force_mps2 > s[best].force_mps2
    return best - 1 if falls else best


@compiled
def clearance_m(s: Samples, first: int, last: int) -> float:
    """Return the largest height above the line from the place of row `first` to that of row `last`."""
    start_m = s[first].position_m
    whole_m = difference(s[last].position_m, start_m)
    path_m2 = max(whole_m[0] ** 2 + whole_m[1] ** 2, SHORTEST_PATH_M**2)
    largest_m = 0.0
    for i in range(first, last + 1):
        there_m = difference(s[i].position_m, start_m)
        along = (there_m[0] * whole_m[0] + there_m[1] * whole_m[1]) / path_m2
        largest_m = max(largest_m, there_m[2] - min(max(along, 0.0), 1.0) * whole_m[2])
    return largest_m

"""Where the body really was: midway between both feet."""

import numpy as np

from pdr_core.evaluation.score import in_order
from pdr_core.records import Truth, TruthKind


def truth_between(left: Truth | None, right: Truth | None) -> Truth | None:
    """Return the way midway between two feet at the stamps of the left one that the right one has around it.

    None where one of them is not known at many stamps. Both must be in one frame.
    """
    if not left or not right or {left.kind, right.kind} != {TruthKind.POSITION}:
        return None
    left, right = in_order(left), in_order(right)
    if not len(left.stamp_ns) or not len(right.stamp_ns):
        return None
    inside = (left.stamp_ns >= right.stamp_ns[0]) & (left.stamp_ns <= right.stamp_ns[-1])
    stamp_ns = left.stamp_ns[inside]
    at, known = ((ns - right.stamp_ns[0]).astype(np.float64) for ns in (stamp_ns, right.stamp_ns))
    other_m = np.column_stack([np.interp(at, known, axis_m) for axis_m in right.position_m.T])
    return Truth(TruthKind.POSITION, stamp_ns, 0.5 * (left.position_m[inside] + other_m))

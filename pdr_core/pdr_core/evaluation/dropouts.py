"""Where motion capture lost the foot: it repeats its last position, then jumps to the next one.

A person who stands still does not repeat: the noise of the cameras moves every row.
"""

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.records import Flags, Floats, Stamps

HELD_ROWS = 5  # equal rows in a run that is no measurement
JUMP_MPS = 12.0  # faster than any foot


def measured(stamp_ns: Stamps, position_m: Floats) -> Flags:
    """Return which rows, (n,), of a truth, (n, 3) [m], are measurements: finite, not held and not at a jump.

    A truth that is held from its first row to its last is a foot at rest (in a simulation), not a dropout.
    """
    held = _held(position_m)
    finite = np.all(np.isfinite(position_m), axis=1)
    return finite if held.all() else finite & ~held & ~_at_jump(stamp_ns, position_m)


def _held(position_m: Floats) -> Flags:
    """Return which rows belong to a run of HELD_ROWS or more equal rows."""
    moved = np.any(np.diff(position_m, axis=0) != 0.0, axis=1)
    run = np.concatenate([[0], np.cumsum(moved)])[: len(position_m)]
    return np.bincount(run)[run] >= HELD_ROWS


def _at_jump(stamp_ns: Stamps, position_m: Floats) -> Flags:
    """Return which rows lie at either end of a step that is faster than JUMP_MPS."""
    distance_m = np.linalg.norm(np.diff(position_m, axis=0), axis=1)
    jump = distance_m > JUMP_MPS * np.diff(stamp_ns) / NANOSECONDS
    at_jump = np.zeros(len(position_m), dtype=np.bool_)
    at_jump[:-1] |= jump
    at_jump[1:] |= jump
    return at_jump

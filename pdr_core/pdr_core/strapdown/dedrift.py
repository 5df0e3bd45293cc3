"""Velocity and position without a filter: the drift of each swing is known once the foot stands again (Qiu eq. 23-27).

The loop over the samples; `swing.py` has the formulas. A swing is given out once its stance has come. One that never
ends, for a gap, the end of the recording or because it lasts too long, is given out as it is, and the position is held
until the foot stands.
"""

import numpy as np

from pdr_core.conventions import nanoseconds
from pdr_core.maths.compiled import compiled
from pdr_core.strapdown.swing import (
    Accelerations,
    DriftState,
    Track,
    close,
    drift_mps,
    interval_s,
    leave_open,
    remember,
)

LONGEST_NS = nanoseconds(5.0)  # no step takes so long
IMPOSSIBLE_MPS2 = 1.4  # a stance that needs an acceleration so wrong is none: in strides of real walks it is 1 at most
RELEASE_S = 0.1  # unless it goes on


@compiled
def track(block: Accelerations, waiting: int, state: DriftState, out: Track) -> int:
    """Write the samples whose swing is over; return how many. The first `waiting` have been looked at before."""
    done = 0
    for i in range(waiting, block.stamp_ns.shape[0]):
        late = not state.adrift and block.stamp_ns[i] - state.stamp_ns > LONGEST_NS
        if not block.whole[i] or late:
            done = leave_open(block, done, i, state, out)
        if state.adrift:
            arrive_or_wait(block, i, state, out)
            done = i + 1
        elif block.stance[i] and believed(block, done, i, state):
            close(block, done, i, state, out)
            done = i + 1
    return done


@compiled
def believed(block: Accelerations, first: int, i: int, state: DriftState) -> bool:
    """Return whether the swing from `first` on may end in sample i: a foot in mid-air may look still for a moment."""
    error, swing_s = drift_mps(block, first, i, state)
    if error <= IMPOSSIBLE_MPS2 * max(swing_s, RELEASE_S):
        return True
    contradicted_s = float(state.contradicted_s) + interval_s(block, first, i, state)
    state.contradicted_s = contradicted_s
    return contradicted_s > RELEASE_S


@compiled
def arrive_or_wait(block: Accelerations, i: int, state: DriftState, out: Track) -> None:
    """Begin anew with a foot that stands, or hold the position, where nobody knows the velocity."""
    stands = block.stance[i]
    for axis in range(3):
        out.velocity_mps[i, axis] = block.still_mps[i, axis] if stands else 0.0
    out.free_mps[i] = out.velocity_mps[i]
    out.velocity_sd_mps[i] = block.still_sd_mps[i] if stands else np.inf
    out.moved_sd_m[i] = 0.0
    state.adrift = not stands
    remember(block, i, stands, stands, state, out)

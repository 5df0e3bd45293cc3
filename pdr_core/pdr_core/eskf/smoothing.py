"""From the end of a recording back to its beginning: each estimate learns what came after it.

Rauch, Tung and Striebel's smoother (AIAA Journal 3, 1965; Sarkka, Bayesian filtering and smoothing, 2013, theorem 8.2),
in errors, from the filter's tape. It presumes no optimal gain, so all decisions of the filter stand; the derivation is
in docs/smoothing.md.
"""

import numpy as np

from pdr_core.eskf.error_state import POSITION
from pdr_core.eskf.floor import HEIGHT
from pdr_core.eskf.gravity import tilt_is_lost
from pdr_core.eskf.output import empty_nav, write
from pdr_core.eskf.state import FilterState
from pdr_core.eskf.step_events import note_end
from pdr_core.eskf.tape import Tape, error_between, note_nominal
from pdr_core.eskf.updates import inject
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import smoothed, smoother_gain
from pdr_core.maths.vector import product
from pdr_core.records import Flags, Floats, NavBlock


@compiled
def smooth(tape: Tape, ends: Flags, heights_stay: bool) -> None:
    """Smooth all states of the tape, in place, but the last, which is smoothed already.

    `ends` (n,) flags the samples where a step begins or ends. `heights_stay`: all but the height is smoothed, since
    where it is tied to a floor, later heights tell of the floor. No other error depends on that of the height.
    """
    for i in range(ends.shape[0] - 1, -1, -1):
        if ends[i]:
            settle(tape.states[i + 1])
        if heights_stay:
            part_height(tape.P_predicted[i], tape.P_predicted[i, HEIGHT, HEIGHT])
            part_height(tape.cross[i], 0.0)
        look_back(tape, i)
        if heights_stay:
            part_height(tape.states[i].P, tape.states[i].P[HEIGHT, HEIGHT])


@compiled
def part_height(M: Floats, own: float) -> None:
    """Take the covariances (15, 15) of the height with all else for zero, in place, and `own` for that with itself."""
    M[HEIGHT] = 0.0
    M[:, HEIGHT] = 0.0
    M[HEIGHT, HEIGHT] = own


@compiled
def look_back(tape: Tape, i: int) -> None:
    """Smooth the state before sample i by the one after it; where its tilt is lost no small error leads back."""
    state, later = tape.states[i], tape.states[i + 1]
    state.end_covariance[0] = later.end_covariance[0]
    if state.adrift and tilt_is_lost(state.P):
        state.cross[:, :3] = 0.0
        return
    smoothed_later = np.empty_like(tape.predicted[i])
    note_nominal(later, smoothed_later)
    C = smoother_gain(tape.cross[i], tape.P_predicted[i])
    inject(state, np.sum(C * error_between(tape.predicted[i], smoothed_later), axis=1))
    smoothed(state.P, C, tape.P_predicted[i], later.P)
    state.cross[:, :3] = product(C, later.cross[:, :3])


@compiled
def settle(state: FilterState) -> None:
    """Note the foot that a step leaves, with the displacement from here to where the step ends."""
    note_end(state)
    state.end_covariance[0] = state.end_covariance[1]
    state.cross[:, :3] = state.P[:, POSITION : POSITION + 3]


def estimates(tape: Tape) -> NavBlock:
    """Return the estimates of the tape's samples."""
    out = empty_nav(len(tape.states) - 1)
    write_all(tape, out)
    return out


@compiled
def write_all(tape: Tape, out: NavBlock) -> None:
    """Write the estimates of all samples."""
    for i in range(out.stamp_ns.shape[0]):
        write(out, i, tape.states[i + 1])

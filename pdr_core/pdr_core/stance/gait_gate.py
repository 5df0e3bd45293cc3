"""Gui section 3: which of the moments below the threshold really are stances of a walking foot.

A gait cycle is toe-off, swing, heel strike, stance; between toe-off and heel strike there is no stance. But in
mid-swing the foot turns back and is nearly weightless for an instant, and the statistic dips below the threshold (Gui
figure 3). The dip is short and comes soon after the toe-off. So a stance must last for a while (the time threshold),
and for longer where it begins within the shortest possible swing after the last one (the gait classification), if a
toe-off came between: a rise well above the threshold. A foot that merely wobbles has not left the ground.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.records import Flags, Floats, Stamps


class GateLimits(NamedTuple):
    """The numbers the gate works with."""

    threshold: float
    toe_off: float
    stance_min_ns: int
    dip_max_ns: int
    swing_min_ns: int


class GateState(NamedTuple):
    """The gate's memory, up to the last decided sample."""

    run: Stamps  # (1,) of samples below the threshold: NO_RUN, ACCEPTED or REJECTED
    last_ns: Stamps  # (1,) stamp of the last sample, or NO_STAMP
    last_stance_ns: Stamps  # (1,) stamp of the last sample in stance
    swinging: Flags  # (1,) a toe-off came after it


NO_RUN, ACCEPTED, REJECTED = 0, 1, 2


def fresh_state() -> GateState:
    """Return the memory of a gate that has seen nothing."""
    return GateState(np.zeros(1, np.int64), np.full(1, NO_STAMP), np.zeros(1, np.int64), np.zeros(1, np.bool_))


@compiled
def decide(
    stamp_ns: Stamps, statistic: Floats, limits: GateLimits, state: GateState, final: bool, verdict: Flags
) -> int:
    """Write the verdicts, (n,), and return how many are decided: the others wait for later samples, unless `final`."""
    n = stamp_ns.shape[0]
    for i in range(n):
        verdict[i] = False
        if statistic[i] > limits.threshold or after_gap(stamp_ns[i], state.last_ns[0]):
            state.run[0] = NO_RUN
        if statistic[i] > limits.threshold:
            state.swinging[0] = state.swinging[0] or statistic[i] > limits.toe_off
            state.last_ns[0] = stamp_ns[i]
            continue
        if state.run[0] == NO_RUN:
            needed_ns = limits.stance_min_ns
            if state.swinging[0] and stamp_ns[i] - state.last_stance_ns[0] < limits.swing_min_ns:
                needed_ns = limits.dip_max_ns
            lasts, ended = run_lasts(stamp_ns, statistic, i, limits.threshold, needed_ns)
            if not (lasts or ended or final):
                return i
            state.run[0] = ACCEPTED if lasts else REJECTED
        if state.run[0] == ACCEPTED:
            verdict[i] = True
            state.last_stance_ns[0] = stamp_ns[i]
            state.swinging[0] = False
        state.last_ns[0] = stamp_ns[i]
    return n


@compiled
def after_gap(stamp_ns: int, before_ns: int) -> bool:
    """Return whether samples are missing between two stamps: then no stance goes on from one to the other."""
    return before_ns != NO_STAMP and stamp_ns - before_ns > GAP_NS


@compiled
def run_lasts(stamp_ns: Stamps, statistic: Floats, start: int, threshold: float, needed_ns: int) -> tuple[bool, bool]:
    """Return whether the run below the threshold from `start` lasts for `needed_ns`, and whether its end is known."""
    for i in range(start, stamp_ns.shape[0]):
        if statistic[i] > threshold or (i > start and after_gap(stamp_ns[i], stamp_ns[i - 1])):
            return False, True
        if stamp_ns[i] - stamp_ns[start] >= needed_ns:
            return True, True
    return False, False

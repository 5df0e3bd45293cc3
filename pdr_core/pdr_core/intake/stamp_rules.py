"""Which samples of a live or recorded stream may pass, in which order and with which stamp: the compiled rules.

A sample passes at once where its stamp is the next to be expected. Where it is not, the sample waits for the one after
it: that one shows whether the step is real, the stamp was a stray, or two samples had changed places.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NO_STAMP
from pdr_core.intake.even_stamps import even_stamp
from pdr_core.intake.stamp_faults import Fault
from pdr_core.intake.stamp_state import NOBODY, StampState, learn, missing_before, rushes
from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats, ImuBlock, Stamps

LATEST_NS = 2**62  # in the year 2116; so no difference of two stamps overflows
CLOCK_SET_NS = 60_000_000_000  # no pause within a walk is longer


class StampLimits(NamedTuple):
    """The numbers the rules work with."""

    restart_ns: int
    period_ns: int  # 0: the stamps are used as they come


class Verdicts(NamedTuple):
    """What becomes of n samples; of `order` and `stamp_ns` the first `state.passed` rows count."""

    fault: Stamps  # (n,)
    order: Stamps  # (n,) indices of the samples that pass
    stamp_ns: Stamps  # (n,) the stamps they pass with


@compiled
def judged(block: ImuBlock, limits: StampLimits, state: StampState, final: bool) -> Verdicts:
    """Judge the samples of a block; the first one is the one that waits, if one does."""
    n = block.stamp_ns.shape[0]
    out = Verdicts(np.zeros(n, np.int64), np.empty(n, np.int64), np.empty(n, np.int64))
    state.passed, state.straight, start = 0, True, 0
    if state.waiting != NOBODY:
        state.waiting, start = 0, 1
    for i in range(start, n):
        if not -LATEST_NS < block.stamp_ns[i] < LATEST_NS:
            out.fault[i] = Fault.STRAY
        elif state.waiting == NOBODY:
            take(block, i, limits, state, out)
        else:
            meet(block, i, limits, state, out)
    if final and state.waiting != NOBODY:
        release(block, limits, state, out)
    return out


@compiled
def take(block: ImuBlock, i: int, limits: StampLimits, state: StampState, out: Verdicts) -> None:
    """Let sample i pass, wait, or be left out, by its step from the last one that passed."""
    step_ns = block.stamp_ns[i] - state.last_ns
    if state.last_ns == NO_STAMP:
        let_pass(block, i, limits, state, out)
        return
    if step_ns == 0:
        out.fault[i] = repeated(block, i, state.last_gyro, state.last_accel, limits)
    elif -limits.restart_ns <= step_ns < 0:
        out.fault[i] = Fault.LATE
    if out.fault[i] == Fault.NONE:
        if unexpected(step_ns, state):
            state.waiting = i
        else:
            let_pass(block, i, limits, state, out)


@compiled
def meet(block: ImuBlock, i: int, limits: StampLimits, state: StampState, out: Verdicts) -> None:
    """Judge the sample that waits by sample i, the next one, and sample i itself."""
    w = state.waiting
    since_last_ns = block.stamp_ns[i] - state.last_ns
    since_waiting_ns = block.stamp_ns[i] - block.stamp_ns[w]
    within_reach = 0 < block.stamp_ns[w] - state.last_ns <= GAP_NS
    nearer_to_waiting = abs(since_waiting_ns) < abs(since_last_ns)
    if since_waiting_ns == 0:
        out.fault[i] = repeated(block, i, block.gyro_radps[w], block.accel_mps2[w], limits)
        if out.fault[i] != Fault.NONE:
            return
    if 0 <= since_waiting_ns <= CLOCK_SET_NS and nearer_to_waiting:
        release(block, limits, state, out)
        take(block, i, limits, state, out)
    elif since_waiting_ns < 0 < since_last_ns and within_reach:
        let_pass(block, i, limits, state, out)
        if not unexpected(-since_waiting_ns, state):
            release(block, limits, state, out)
    elif -limits.restart_ns <= (since_waiting_ns if nearer_to_waiting else since_last_ns) <= 0:
        out.fault[i] = Fault.LATE
    elif within_reach:
        release(block, limits, state, out)
        take(block, i, limits, state, out)
    else:
        out.fault[w] = Fault.STRAY
        state.waiting = NOBODY
        take(block, i, limits, state, out)


@compiled
def repeated(block: ImuBlock, i: int, gyro: Floats, accel: Floats, limits: StampLimits) -> int:
    """Return what sample i is, whose stamp is that of the one before it with these values."""
    if np.all(block.gyro_radps[i] == gyro) and np.all(block.accel_mps2[i] == accel):
        return Fault.DUPLICATE
    if block.stamp_ns[i] == 0:
        return Fault.UNSTAMPED
    return Fault.EQUAL if limits.period_ns == 0 else Fault.NONE


@compiled
def unexpected(step_ns: int, state: StampState) -> bool:
    """Return whether a sample that comes so long after the last one must wait for the one after it."""
    return step_ns < 0 or step_ns > GAP_NS or missing_before(step_ns, state)


@compiled
def fault_of_step(step_ns: int) -> int:
    """Return what it means that two samples which pass are so far from one another."""
    if step_ns < 0:
        return Fault.BACK
    if step_ns > CLOCK_SET_NS:
        return Fault.FORTH
    return Fault.GAP if step_ns > GAP_NS else Fault.NONE


@compiled
def release(block: ImuBlock, limits: StampLimits, state: StampState, out: Verdicts) -> None:
    """Believe the sample that waits."""
    i = state.waiting
    state.waiting = NOBODY
    let_pass(block, i, limits, state, out)


@compiled
def let_pass(block: ImuBlock, i: int, limits: StampLimits, state: StampState, out: Verdicts) -> None:
    """Let sample i pass as the next one, with the fault of its step."""
    stamp_ns = block.stamp_ns[i]
    passes = True
    if state.last_ns == NO_STAMP:
        state.out_ns = stamp_ns
    else:
        step_ns = stamp_ns - state.last_ns
        out.fault[i] = fault_of_step(step_ns)
        if limits.period_ns > 0:
            out.fault[i], passes = even_stamp(stamp_ns, out.fault[i], limits.period_ns, state)
        else:
            state.out_ns = stamp_ns
            if rushes(step_ns, state):
                out.fault[i] = Fault.BURST
        learn(step_ns, state)
    state.last_ns = stamp_ns
    for axis in range(3):
        state.last_gyro[axis] = block.gyro_radps[i, axis]
        state.last_accel[axis] = block.accel_mps2[i, axis]
    if passes:
        state.straight = state.straight and state.passed == i
        out.order[state.passed] = i
        out.stamp_ns[state.passed] = state.out_ns
        state.passed += 1

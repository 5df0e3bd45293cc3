"""A gyro that its own sensor switches: on when the foot leaves its stand, off soon after the heel has struck.

It looks at nothing but the change of the specific force over a short time, as the motion interrupts of common sensors
do, so a service call need not come in time for every stride:

    on     the force has changed by `wake_mps2` within 40 ms, and the foot has been quiet since the gyro went off
    off    the force has changed by `strike_mps2` within 10 ms, the heel, and `strike_on_ns` have passed since;
           or the foot is quiet; neither before the gyro has been on for `least_ns`, in which the toe pushes off
    quiet  no change of `quiet_mps2` within 40 ms for as long as that

What stands in for the driver in a recording and what plays one live use the same object.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.records import Flags, Floats, Stamps

SPAN_NS, STRIKE_SPAN_NS = 40_000_000, 10_000_000
FIRST_QUIET_NS = 100_000_000  # so long before the gyro goes off for the first time: in mid-swing no foot is
LONG_AGO = NO_STAMP // 2


class MotionRule(NamedTuple):
    """When the gyro goes on and off."""

    wake_mps2: float
    quiet_mps2: float
    strike_mps2: float
    strike_on_ns: int
    least_ns: int
    settle_ns: int  # from going on until the rates can be trusted


class SwitchState(NamedTuple):
    """What the switch remembers, (1,) each."""

    powered: Flags
    ready: Flags  # the foot has been quiet since the gyro went off
    woke_ns: Stamps
    moved_ns: Stamps  # the last change that is none of a quiet foot
    struck_ns: Stamps  # the heel since the gyro went on; NO_STAMP: not yet
    fresh: Flags  # nobody knows the phase of the gait: the gyro has not been off


class MotionSwitch:
    """Samples in; of each, whether the gyro is powered and whether its rate can be trusted."""

    def __init__(self, rule: MotionRule, powered: bool) -> None:
        self.rule, self._first_powered = rule, powered
        self._stamp_ns: Stamps
        self._accel_mps2: Floats
        self._state: SwitchState
        self._forget()

    def run(self, stamp_ns: Stamps, accel_mps2: Floats) -> tuple[Flags, Flags]:
        """Return powered and measured, (n,) each, of the next samples; `accel_mps2` (n, 3) in any axes."""
        newest_ns = self._stamp_ns[-1:] if len(self._stamp_ns) else stamp_ns[:1]
        jumps_back = np.flatnonzero(np.diff(stamp_ns, prepend=newest_ns[: len(stamp_ns)]) < 0).tolist()
        flags = []
        for start, stop in pairwise([0, *jumps_back, len(stamp_ns)]):
            if start in jumps_back:  # another clock
                self._forget()
            flags.append(self._switched(stamp_ns[start:stop], accel_mps2[start:stop]))
        return np.concatenate([f[0] for f in flags]), np.concatenate([f[1] for f in flags])

    def _switched(self, stamp_ns: Stamps, accel_mps2: Floats) -> tuple[Flags, Flags]:
        stamps = np.concatenate([self._stamp_ns, stamp_ns])
        accel = np.ascontiguousarray(np.vstack([self._accel_mps2, accel_mps2]))
        powered, measured = np.empty(len(stamp_ns), np.bool_), np.empty(len(stamp_ns), np.bool_)
        switch(stamps, accel, self.rule, self._state, powered, measured)
        kept = int(np.searchsorted(stamps, stamps[-1] - SPAN_NS, side="right")) - 1 if len(stamps) else 0
        self._stamp_ns, self._accel_mps2 = stamps[max(0, kept) :], accel[max(0, kept) :]
        return powered, measured

    def _forget(self) -> None:
        self._stamp_ns, self._accel_mps2 = np.zeros(0, np.int64), np.zeros((0, 3))
        self._state = SwitchState(
            np.full(1, self._first_powered),
            np.ones(1, np.bool_),
            np.full(1, LONG_AGO),
            np.full(1, LONG_AGO),
            np.full(1, NO_STAMP),
            np.full(1, self._first_powered),
        )


@compiled
def switch(
    stamp_ns: Stamps, accel_mps2: Floats, rule: MotionRule, state: SwitchState, powered: Flags, measured: Flags
) -> None:
    """Fill the flags of the last samples; those before them are remembered, for the changes."""
    n, first = stamp_ns.shape[0], stamp_ns.shape[0] - powered.shape[0]
    for i in range(first, n):
        if change(stamp_ns, accel_mps2, i, SPAN_NS) > rule.quiet_mps2:
            state.moved_ns[0] = stamp_ns[i]
        if state.powered[0]:
            go_off(stamp_ns, accel_mps2, i, rule, state)
        else:
            go_on(stamp_ns, accel_mps2, i, rule, state)
        powered[i - first] = state.powered[0]
        measured[i - first] = state.powered[0] and stamp_ns[i] - state.woke_ns[0] >= rule.settle_ns


@compiled
def go_off(stamp_ns: Stamps, accel_mps2: Floats, i: int, rule: MotionRule, state: SwitchState) -> None:
    """Switch off where the swing is over."""
    now_ns = stamp_ns[i]
    if state.fresh[0]:
        state.moved_ns[0] = now_ns if state.moved_ns[0] == LONG_AGO else state.moved_ns[0]
        if now_ns - state.moved_ns[0] >= FIRST_QUIET_NS:
            state.powered[0], state.fresh[0] = False, False
        return
    if now_ns - state.woke_ns[0] < rule.least_ns:
        return
    if state.struck_ns[0] == NO_STAMP and change(stamp_ns, accel_mps2, i, STRIKE_SPAN_NS) > rule.strike_mps2:
        state.struck_ns[0] = now_ns
    struck = state.struck_ns[0] != NO_STAMP and now_ns - state.struck_ns[0] >= rule.strike_on_ns
    if struck or quiet(now_ns, state):
        state.powered[0], state.ready[0] = False, False


@compiled
def go_on(stamp_ns: Stamps, accel_mps2: Floats, i: int, rule: MotionRule, state: SwitchState) -> None:
    """Switch on where the foot leaves its stand."""
    now_ns = stamp_ns[i]
    state.ready[0] = state.ready[0] or quiet(now_ns, state)
    if state.ready[0] and change(stamp_ns, accel_mps2, i, SPAN_NS) > rule.wake_mps2:
        state.powered[0], state.woke_ns[0], state.struck_ns[0] = True, now_ns, NO_STAMP


@compiled
def quiet(now_ns: int, state: SwitchState) -> bool:
    """Return whether the force has not changed for a while."""
    return now_ns - state.moved_ns[0] >= SPAN_NS


@compiled
def change(stamp_ns: Stamps, accel_mps2: Floats, i: int, span_ns: int) -> float:
    """Return the change of the force up to sample i over a time, 0 where nothing is remembered from before it."""
    k = i
    while k > 0 and stamp_ns[i] - stamp_ns[k] < span_ns:
        k -= 1
    if stamp_ns[i] - stamp_ns[k] < span_ns:
        return 0.0
    total = 0.0
    for axis in range(3):
        total += (accel_mps2[i, axis] - accel_mps2[k, axis]) ** 2
    return np.sqrt(total)

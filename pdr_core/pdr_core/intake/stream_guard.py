"""Which samples of a live or recorded stream may pass, and what is wrong with the others."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import GAP_NS, NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.records import ImuBlock, Level, Stamps

LATEST_NS = 2**62  # in the year 2116; so no difference of two stamps overflows
ABSURD = 1e6  # no sensor shows so much, in whatever unit, and the square of much more would drown all else


class Fault(IntEnum):
    """What can be wrong with a sample."""

    NONE = 0
    DUPLICATE = 1
    LATE = 2
    NOT_FINITE = 3
    RESTART = 4
    GAP = 5


FAULTS = {
    Fault.DUPLICATE: ("duplicate_stamp", Level.WARN, "samples repeat the stamp before them: left out"),
    Fault.LATE: ("late_stamp", Level.WARN, "samples come after younger ones: left out"),
    Fault.NOT_FINITE: ("not_finite", Level.WARN, "samples hold NaN, infinity or absurd numbers: left out"),
    Fault.RESTART: ("clock_jumped_back", Level.WARN, "the stamps jump back: the track goes on from where it was"),
    Fault.GAP: ("gap", Level.WARN, "samples are missing: the position is uncertain after the gap"),
}


class GuardLimits(NamedTuple):
    """The numbers the guard works with."""

    restart_ns: int


class GuardState(NamedTuple):
    """The guard's memory."""

    last_ns: Stamps  # (1,) stamp of the last sample that passed, or NO_STAMP


def fresh_state() -> GuardState:
    """Return the memory of a guard that has seen nothing."""
    return GuardState(np.full(1, NO_STAMP))


@compiled
def admitted(block: ImuBlock, limits: GuardLimits, state: GuardState) -> NDArray[np.int64]:
    """Return the Fault of each sample, (n,). NONE, GAP and RESTART pass, the others must not be used."""
    faults = np.zeros(block.stamp_ns.shape[0], np.int64)
    for i in range(block.stamp_ns.shape[0]):
        step_ns = block.stamp_ns[i] - state.last_ns[0]
        plausible = np.all(np.abs(block.gyro_radps[i]) < ABSURD) and np.all(np.abs(block.accel_mps2[i]) < ABSURD)
        if not (plausible and -LATEST_NS < block.stamp_ns[i] < LATEST_NS):
            faults[i] = Fault.NOT_FINITE
            continue
        if state.last_ns[0] != NO_STAMP:
            if step_ns == 0:
                faults[i] = Fault.DUPLICATE
                continue
            if -limits.restart_ns <= step_ns < 0:
                faults[i] = Fault.LATE
                continue
            if step_ns < 0:
                faults[i] = Fault.RESTART
            elif step_ns > GAP_NS:
                faults[i] = Fault.GAP
        state.last_ns[0] = block.stamp_ns[i]
    return faults

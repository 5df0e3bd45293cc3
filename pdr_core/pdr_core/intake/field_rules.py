"""Which magnetic fields of a stream are measurements, calibrated: the compiled rules.

A magnetometer is slower than the gyro, and many drivers repeat its last value with every sample. A value that is the
same to the last bit is therefore no new measurement: only the first of its kind counts, and three zeros, which a driver
sends that has nothing, never do. If nothing new comes while the gyro shows a turn, the magnetometer is stuck.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import added, difference, norm, rotated, row, scaled, within
from pdr_core.records import Floats, ImuBlock, Stamps

NONE, GOOD, REPEATED, STUCK, SATURATED, ABSURD = range(6)  # what is named comes after REPEATED
STUCK_NS = NANOSECONDS
STUCK_TURN_RAD = 0.52  # 30 deg
TURNING_RADPS = 0.3  # a lower rate may be bias and noise of a gyro at rest
ABSURD_SHARE = 2.0  # of the range: beyond it no sensor has measured that

# fmt: off
LAYOUT = np.dtype([
    ("changed_ns", np.int64),      # stamp of the last field that was new; NO_STAMP: none yet
    ("last_ns", np.int64),         # stamp of the last sample
    ("value", np.float64, 3),      # the last field, as it came
    ("turned_rad", np.float64, 3), # since it was new
    ("stuck", np.bool_),           # it should have changed
], align=True)
# fmt: on
FieldState = np.record


class FieldLimits(NamedTuple):
    """What is known of the magnetometer."""

    unit_tesla: float
    offset_tesla: Floats  # (3,)
    matrix: Floats  # (3, 3) from the sensor's axes, less the offset, into the foot's
    noise_tesla: float
    range_tesla: float


class Fields(NamedTuple):
    """n fields in tesla and the foot's axes, deviations of -1 where there is none, and what became of each."""

    field_tesla: Floats  # (n, 3)
    sd_tesla: Floats  # (n,)
    verdict: Stamps  # (n,)
    shown_tesla: Floats  # (n,) how strong each is, also those that are left out; 0 where there is none


def fresh_state() -> FieldState:
    """Return the memory of a magnetometer that has shown nothing."""
    state = np.zeros(1, LAYOUT).view(np.recarray)[0]
    state.changed_ns = NO_STAMP
    return state


@compiled
def holds_field(block: ImuBlock) -> bool:
    """Return whether anything stands where a block has its fields."""
    for i in range(block.stamp_ns.shape[0]):
        if not (block.field_sd_tesla[i] < 0.0 and norm(row(block.field_tesla, i)) == 0.0):
            return True
    return False


@compiled
def calibrated(block: ImuBlock, limits: FieldLimits, state: FieldState) -> Fields:
    """Judge and calibrate the fields of a block: matrix (field - offset)."""
    n = block.stamp_ns.shape[0]
    out = Fields(np.zeros((n, 3)), np.full(n, -1.0), np.zeros(n, np.int64), np.zeros(n))
    for i in range(n):
        if state.changed_ns != NO_STAMP:
            turn(block, i, state)
        state.last_ns = block.stamp_ns[i]
        out.verdict[i] = verdict(block, i, limits, state)
        if out.verdict[i] != NONE:
            measured = scaled(limits.unit_tesla, row(block.field_tesla, i))
            field = rotated(limits.matrix, difference(measured, limits.offset_tesla))
            out.shown_tesla[i] = norm(field) if norm(measured) > 0.0 else 0.0
            if out.verdict[i] == GOOD:
                out.field_tesla[i] = field
                out.sd_tesla[i] = np.hypot(limits.unit_tesla * block.field_sd_tesla[i], limits.noise_tesla)
    return out


@compiled
def verdict(block: ImuBlock, i: int, limits: FieldLimits, state: FieldState) -> int:
    """Return what the field of sample i is."""
    sd, field = limits.unit_tesla * block.field_sd_tesla[i], row(block.field_tesla, i)
    if sd < 0.0:
        return NONE
    in_tesla = scaled(limits.unit_tesla, field)
    if not (sd < ABSURD_SHARE * limits.range_tesla and within(in_tesla, ABSURD_SHARE * limits.range_tesla)):
        return ABSURD
    if not within(in_tesla, 0.995 * limits.range_tesla):
        return SATURATED
    if norm(field) == 0.0 or norm(difference(field, state.value)) == 0.0:
        return STUCK if state.stuck else REPEATED
    state.changed_ns, state.stuck = block.stamp_ns[i], False
    for axis in range(3):
        state.value[axis], state.turned_rad[axis] = field[axis], 0.0
    return GOOD


@compiled
def turn(block: ImuBlock, i: int, state: FieldState) -> None:
    """Take the turn up to sample i into account: it is stuck if it should have shown a new field long ago."""
    step_ns = block.stamp_ns[i] - state.last_ns
    rate = row(block.gyro_radps, i)
    if 0 < step_ns <= GAP_NS and block.gyro_sd_radps[i] >= 0.0 and norm(rate) > TURNING_RADPS:
        turned = added(state.turned_rad, scaled(step_ns / NANOSECONDS, rate))
        for axis in range(3):
            state.turned_rad[axis] = turned[axis]
        if norm(turned) > STUCK_TURN_RAD and block.stamp_ns[i] - state.changed_ns > STUCK_NS:
            state.stuck = True

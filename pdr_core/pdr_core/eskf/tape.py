"""What the smoother needs of a run of the filter: each sample's estimate before and after its corrections.

The tape is written by the functions that run live, sample by sample.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import NO_STAMP
from pdr_core.eskf.error_state import ACCEL_BIAS, ATTITUDE, SIZE
from pdr_core.eskf.navigate import predict, sample, update
from pdr_core.eskf.process import carry, forget_velocity
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import LAYOUT, FilterState
from pdr_core.eskf.step_events import stance_is_over, step_taken
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import conjugate, multiply, to_rotation_vector
from pdr_core.records import Floats, StanceBlock, length

NOMINAL = 16  # position, velocity, quaternion, accelerometer bias, gyro bias


class Tape(NamedTuple):
    """n samples of a run of the filter."""

    states: NDArray[np.void]  # (n + 1,) before the first sample and after each
    predicted: Floats  # (n, 16) the estimate of each sample before its corrections
    P_predicted: Floats
    cross: Floats  # (n, 15, 15) covariance of its errors with those after the sample before


def recorded(block: StanceBlock, s: Settings, state: FilterState) -> Tape:
    """Run the filter from a state, which is not changed, over samples that do not wait for an answer."""
    n = length(block)
    tape = Tape(np.zeros(n + 1, LAYOUT), np.empty((n, NOMINAL)), np.empty((n, SIZE, SIZE)), np.empty((n, SIZE, SIZE)))
    tape.states[0] = state
    running, done = state.copy(), 0
    while (done := record(block, done, s, running, tape)) < n:
        step_taken(running, s, NO_STAMP)
    return tape


@compiled
def record(block: StanceBlock, start: int, s: Settings, state: FilterState, tape: Tape) -> int:
    """Run the filter and write the tape, until a stance is over; return the next sample to take."""
    for i in range(start, block.stance.shape[0]):
        if stance_is_over(block.imu.stamp_ns[i], s.merge_ns, state):
            return i
        now = sample(block, i)
        tape.cross[i] = state.P
        carry(predict(now, s, state), tape.cross[i])
        if state.coasting:
            forget_velocity(tape.cross[i])
        note_nominal(state, tape.predicted[i])
        tape.P_predicted[i] = state.P
        state.doubt[:] = 0.0
        update(now, s, state)
        for j in range(SIZE):
            tape.P_predicted[i, j, j] += state.doubt[j]  # what was doubted had gone wrong before
        tape.states[i + 1] = state
    return block.stance.shape[0]


@compiled
def note_nominal(state: FilterState, out: Floats) -> None:
    """Write the estimate without its covariance, (16,)."""
    out[0:3] = state.position_m
    out[3:6] = state.velocity_mps
    out[6:10] = state.quat_xyzw
    out[10:13] = state.accel_bias_mps2
    out[13:16] = state.gyro_bias_radps


@compiled
def error_between(before: Floats, after: Floats) -> Floats:
    """Return the error (15,) of an estimate (16,) beside a better one."""
    error = np.empty(SIZE)
    error[:ATTITUDE] = after[:6] - before[:6]
    error[ATTITUDE:ACCEL_BIAS] = to_rotation_vector(multiply(after[6:10], conjugate(before[6:10])))
    error[ACCEL_BIAS:] = after[10:] - before[10:]
    return error

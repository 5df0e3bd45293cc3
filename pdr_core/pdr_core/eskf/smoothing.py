"""Smoothing."""

import numpy as np
from numpy.typing import NDArray

from pdr_core.eskf.error_state import ATTITUDE, POSITION, SIZE
from pdr_core.eskf.output import write
from pdr_core.eskf.state import FilterState
from pdr_core.eskf.tape import NOMINAL, Tape, note_nominal
from pdr_core.eskf.updates import inject
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import multiply, to_rotation_vector
from pdr_core.maths.vector import inverse_positive, product
from pdr_core.records import Flags, Floats, NavBlock


@compiled
def smooth(tape: Tape, ends: Flags) -> None:
    """Replace all states but the last, which is smoothed already, by the smoothed ones, in place."""
    n = tape.cross.shape[0]
    now = np.empty(NOMINAL)
    for i in range(n - 1, -1, -1):
        later, state = tape.states[i + 1], tape.states[i]
        note_nominal(later, now)
        C = backward_gain(tape.cross[i], tape.P_predicted[i])
        inject(state, product(C, error_between(tape.predicted[i], now).reshape(SIZE, 1))[:, 0])
        state.P[:] += product(product(C, later.P - tape.P_predicted[i]), C.T)
        state.cross[:, :3] = product(C, later.cross[:, :3])
        state.end_covariance[0] = later.end_covariance[0]


@compiled
def error_between(before: Floats, after: Floats) -> Floats:
    """Return the error (15,) that leads from one estimate (16,) to another."""
    error = np.empty(SIZE)
    error[:ATTITUDE] = after[:ATTITUDE] - before[:ATTITUDE]
    p = before[6:10]
    turn = multiply(after[6:10], (-p[0], -p[1], -p[2], p[3]))
    error[ATTITUDE : ATTITUDE + 3] = to_rotation_vector(turn)
    error[ATTITUDE + 3 :] = after[10:] - before[10:]
    return error


@compiled
def backward_gain(cross: Floats, P: Floats) -> Floats:
    """Return C = cross' P^-1."""
    scale = np.zeros(SIZE)
    for i in range(SIZE):
        scale[i] = 1.0 / np.sqrt(P[i, i]) if P[i, i] > 0.0 else 0.0
    scaled = np.eye(SIZE)
    for i in range(SIZE):
        for j in range(SIZE):
            if i != j:
                scaled[i, j] = P[i, j] * scale[i] * scale[j]
    inverse = inverse_positive(scaled)
    for i in range(SIZE):
        for j in range(SIZE):
            inverse[i, j] *= scale[i] * scale[j]
    return product(cross.T, inverse)


@compiled
def write_smoothed(tape: Tape, out: NavBlock) -> None:
    for i in range(tape.cross.shape[0]):
        write(out, i, tape.states[i + 1])

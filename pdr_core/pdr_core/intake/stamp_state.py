"""What the stamp rules remember: the last sample that passed, and the sensor's usual interval."""

import numpy as np

from pdr_core.conventions import GAP_NS, NO_STAMP
from pdr_core.maths.compiled import compiled

NOBODY = -1
LEARNT = 16  # intervals after which the usual one is known; counted, since the time between samples is what is learnt
MEMORY = 64  # intervals that the mean looks back on
HOLE = 1.5  # usual intervals: a longer one is a hole, in which a sample may be missing
RUSH = 0.25  # usual intervals: samples that are closer come at once

# fmt: off
LAYOUT = np.dtype([
    ("last_ns", np.int64),             # stamp, as it came, of the last sample that passed; NO_STAMP: none yet
    ("last_gyro", np.float64, 3),      # its values
    ("last_accel", np.float64, 3),
    ("out_ns", np.int64),              # the stamp it passed with
    ("usual_ns", np.float64),          # mean interval
    ("intervals", np.int64),           # that the mean was made of, up to MEMORY
    ("rushing", np.int64),             # short intervals in a row
    ("after_hole", np.bool_),          # they came after a hole
    ("waiting", np.int64),             # index of the sample that waits; NOBODY: none does
    ("passed", np.int64),              # samples of the present block that pass
    ("straight", np.bool_),            # none of them was left out or overtaken so far
], align=True)
# fmt: on
StampState = np.record


def fresh_state() -> StampState:
    """Return the memory of a policy that has seen nothing."""
    state = np.zeros(1, LAYOUT).view(np.recarray)[0]
    state.last_ns, state.waiting = NO_STAMP, NOBODY
    return state


@compiled
def learn(step_ns: int, state: StampState) -> None:
    """Take the step between two samples into the mean. Bursts leave it as it is: they begin with a hole."""
    if 0 <= step_ns <= GAP_NS:
        state.intervals = min(state.intervals + 1, MEMORY)
        state.usual_ns += (step_ns - state.usual_ns) / state.intervals


@compiled
def missing_before(step_ns: int, state: StampState) -> bool:
    """Return whether a step is a hole."""
    return state.intervals >= LEARNT and step_ns > HOLE * state.usual_ns


@compiled
def rushes(step_ns: int, state: StampState) -> bool:
    """Return whether this is the third sample at once after a hole: they had waited somewhere."""
    if state.intervals < LEARNT:
        return False
    if step_ns >= RUSH * state.usual_ns:
        state.rushing = 0
        state.after_hole = step_ns > HOLE * state.usual_ns
        return False
    state.rushing += 1
    return state.after_hole and state.rushing == 2

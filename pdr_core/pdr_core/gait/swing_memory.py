"""The samples since the stillest moment of the last stand, and the impulse of the swing up to each, in a fixed memory.

The impulse is summed up along the level axes of the last stand. Each sample remembers the sum up to it, since only the
next stand tells which part of the swing counts.
"""

import numpy as np

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.maths.compiled import compiled
from pdr_core.maths.levelling import levelled
from pdr_core.maths.memory import Memory, first_at, let_go, record
from pdr_core.maths.quaternion import rows
from pdr_core.maths.sample_memory import add_sample, let_samples_go, sample_rows
from pdr_core.maths.vector import Triple, dot, row, within
from pdr_core.records import Floats

NANO = 1e-9
LONGEST_NS = nanoseconds(2.5)  # a foot that moves for longer has stood in between, unseen: so in a run
NONE = -1
CAPACITY = 8192  # samples since the last stand was left; where there are more, the impulse is not known
MEMORY = record(
    [
        *sample_rows(CAPACITY),
        ("impulse_mps", np.float64, (CAPACITY, 2)),  # from the last stand up to the sample
        ("run", np.int64),  # first row of the still samples that go on; NONE: the foot moves
        ("goes_on", np.bool_),  # these belong to the last stand
        ("left_ns", np.int64),  # last still sample of the last stand, as far as it is known; NO_STAMP: none
        ("levelled", np.bool_),  # all samples since the last stand are there, along its level axes
        ("ahead", np.float64, 3),  # the level axes of the last stand, in axes of the foot
        ("left", np.float64, 3),
    ],
)


@compiled
def begin_anew(s: Memory) -> None:
    """Know nothing of a stand."""
    s.held, s.run, s.goes_on, s.left_ns, s.levelled = 0, NONE, False, NO_STAMP, False


@compiled
def append(stamp_ns: int, force_mps2: Triple, field_tesla: Triple, field_sd_tesla: float, s: Memory) -> None:
    """Remember a sample; where there is no room, what no stand and no impulse needs is forgotten."""
    if s.held == CAPACITY:
        make_room(s)
    add_sample(stamp_ns, force_mps2, field_tesla, field_sd_tesla, s)
    sum_up(s.held - 1, s)


@compiled
def sum_up(i: int, s: Memory) -> None:
    """Write the impulse up to row i."""
    s.impulse_mps[i] = 0.0
    if i > 0 and s.levelled:
        force, dt_s = row(s.accel_mps2, i - 1), (s.stamp_ns[i] - s.stamp_ns[i - 1]) * NANO
        s.impulse_mps[i, 0] = s.impulse_mps[i - 1, 0] + dot(s.ahead, force) * dt_s
        s.impulse_mps[i, 1] = s.impulse_mps[i - 1, 1] + dot(s.left, force) * dt_s


@compiled
def level_from(force_mps2: Floats, s: Memory) -> None:
    """Sum up anew, along the level axes of a stand at the first row."""
    ahead, left, _ = rows(levelled(force_mps2, 0.0))
    s.ahead[:] = ahead
    s.left[:] = left
    s.levelled = True
    for i in range(s.held):
        sum_up(i, s)


@compiled
def write_impulse(landed_ns: int, share: float, s: Memory, out: Memory) -> None:
    """Write the sum of the level specific force from the last stand to a share of the swing, if that is known."""
    out.impulse_known, swing_ns = False, landed_ns - s.left_ns
    if s.levelled and swing_ns <= LONGEST_NS:
        until = first_at(s.stamp_ns, 0, s.held, s.left_ns + np.int64(np.ceil(share * swing_ns)))
        out.impulse_mps[:] = s.impulse_mps[min(until, s.held - 1)]
        out.impulse_known = within((out.impulse_mps[0], out.impulse_mps[1], 0.0), np.inf)


@compiled
def make_room(s: Memory) -> None:
    """Forget what is before the swing and the still samples that may become a stand; if need be, more."""
    unneeded = s.held - 1 if s.left_ns == NO_STAMP else first_at(s.stamp_ns, 0, s.held, s.left_ns)
    if s.run != NONE and not s.goes_on:
        unneeded = min(unneeded, s.run)
    if unneeded == 0:
        unneeded, s.levelled = CAPACITY // 2, False
    keep_from(unneeded, s)


@compiled
def keep_from(first: int, s: Memory) -> None:
    """Forget the rows before one."""
    let_go(s.impulse_mps, first, s.held)
    let_samples_go(first, s)
    if s.run != NONE:
        s.run = max(0, s.run - first)

"""Where a foot stands, from the accelerometer and magnetometer alone: up, the field, and the push of the swing before.

A stand is judged by its stillest moment. Of the swing before it counts the impulse along the level axes of the stand
before that: the sum of the specific force across the walk tells a turn (see `turn_suspicion.py`).

A run of still samples that begins soon after the last stand was left belongs to it. Another that lasts is a stand, and
known while it goes on, or when it ends.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import GAP_NS, NO_STAMP, nanoseconds
from pdr_core.gait import swing_memory
from pdr_core.gait.stillest import stillest_rows
from pdr_core.gait.swing_memory import NONE
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, first_at, fresh, packed, record
from pdr_core.maths.vector import Triple, row
from pdr_core.params import DeadReckoningParams
from pdr_core.records import Floats, ImuBlock, StanceBlock, length

STAND = record(  # a Stand
    [
        ("stamp_ns", np.int64),
        ("force_mps2", np.float64, 3),
        ("field_tesla", np.float64, 3),
        ("field_seen", np.bool_),
        ("impulse_mps", np.float64, 2),
        ("impulse_known", np.bool_),
    ],
)


class StandLimits(NamedTuple):
    """What a stand is, and which share of a swing counts for the impulse; compiled code takes it packed."""

    shortest_ns: int
    known_ns: int
    window_ns: int
    swing_ns: int
    impulse_share: float


@dataclass(frozen=True)
class Stand:
    """A foot that stands: vectors in the axes of the foot."""

    stamp_ns: int  # the middle of its stillest moment
    force_mps2: Floats  # (3,) mean specific force: it points up
    field_tesla: Floats  # (3,) mean magnetic field
    field_seen: bool
    impulse_mps: Floats | None  # (2,) of the swing before: ahead and left of the foot's axes; None: not known


class Stands:
    """Finds the stands in samples with verdicts: any detector that needs no gyro will do."""

    def __init__(self, params: DeadReckoningParams) -> None:
        self.limits = packed(stand_limits(params))
        self.memory = fresh(swing_memory.MEMORY)
        swing_memory.begin_anew(self.memory[0])

    def run(self, block: StanceBlock) -> list[Stand]:
        """Return the stands that are known with these samples."""
        found = np.empty(length(block), STAND)
        return stands_of(found, take_all(block, self.limits, self.memory, found))

    def finish(self) -> list[Stand]:
        """Return the stand in which the samples end, if they do."""
        found = np.empty(1, STAND)
        return stands_of(found, int(ended(self.limits[0], self.memory[0], found[0])))


def stands_of(found: NDArray[Any], count: int) -> list[Stand]:
    """Return the stands in the first rows of an array of STAND."""
    return [stand_of(found[i]) for i in range(count)]


def stand_of(row: Any) -> Stand:
    """Return a stand of its row."""
    return Stand(
        int(row["stamp_ns"]),
        row["force_mps2"].copy(),
        row["field_tesla"].copy(),
        bool(row["field_seen"]),
        row["impulse_mps"].copy() if row["impulse_known"] else None,
    )


def stillest(imu: ImuBlock, first: int, last: int, window_ns: int) -> slice:
    """Return the rows of the window within first:last in which the specific force changes least."""
    return slice(*stillest_rows(imu.stamp_ns, imu.accel_mps2, first, last, window_ns))


def stand_limits(p: DeadReckoningParams) -> StandLimits:
    """Derive the limits from the parameters."""
    known_ns, window_ns = nanoseconds(p.stand_known_s), nanoseconds(p.stand_window_s)
    shortest_ns, swing_ns = nanoseconds(p.stand_shortest_s), nanoseconds(p.swing_shortest_s)
    return StandLimits(shortest_ns, known_ns, window_ns, swing_ns, p.impulse_share)


@compiled
def take_all(block: StanceBlock, limits: NDArray[Any], memory: NDArray[Any], found: NDArray[Any]) -> int:
    """Write the stands that are known with the next samples; return their number."""
    s, imu, count = memory[0], block.imu, 0
    for i in range(block.stance.shape[0]):
        force, field = row(imu.accel_mps2, i), row(imu.field_tesla, i)
        sample = imu.stamp_ns[i], force, field, imu.field_sd_tesla[i], block.stance[i]
        count += take(*sample, limits[0], s, found[count])
    return count


@compiled
def take(
    stamp_ns: int,
    force_mps2: Triple,
    field_tesla: Triple,
    field_sd_tesla: float,
    still: bool,
    limits: StandLimits,
    s: Memory,
    out: Memory,
) -> bool:
    """Take a sample with its verdict; return whether a stand is known with it, and write that."""
    unbroken = s.held == 0 or 0 < stamp_ns - s.stamp_ns[s.held - 1] <= GAP_NS
    found = (not still or not unbroken) and ended(limits, s, out)
    if not unbroken:
        swing_memory.begin_anew(s)
    swing_memory.append(stamp_ns, force_mps2, field_tesla, field_sd_tesla, s)
    return (still and stands_on(limits, s, out)) or found


@compiled
def ended(limits: StandLimits, s: Memory, out: Memory) -> bool:
    """End the still samples; return whether they were a stand that was not known yet."""
    run, s.run = s.run, NONE
    if run == NONE or s.goes_on or s.stamp_ns[s.held - 1] - s.stamp_ns[run] < limits.shortest_ns:
        return False
    stood(run, s.held, limits, s, out)
    return True


@compiled
def stands_on(limits: StandLimits, s: Memory, out: Memory) -> bool:
    """Go on with still samples to the newest one; return whether they are now known to be a stand."""
    newest_ns = s.stamp_ns[s.held - 1]
    if s.run == NONE:
        s.run = s.held - 1
        s.goes_on = s.left_ns != NO_STAMP and newest_ns - s.left_ns < limits.swing_ns
    known = not s.goes_on and newest_ns - s.stamp_ns[s.run] >= max(limits.shortest_ns, limits.known_ns)
    if known:
        last = first_at(s.stamp_ns, s.run, s.held, s.stamp_ns[s.run] + limits.known_ns + 1)
        stood(s.run, last, limits, s, out)
        s.run, s.goes_on = 0, True
    if s.goes_on:
        s.left_ns = newest_ns
    return known


@compiled
def stood(first: int, last: int, limits: StandLimits, s: Memory, out: Memory) -> None:
    """Write the stand in the rows first:last, and begin the swing after it at its stillest moment."""
    swing_memory.write_impulse(s.stamp_ns[first], limits.impulse_share, s, out)
    start, stop = stillest_rows(s.stamp_ns, s.accel_mps2, first, last, limits.window_ns)
    middle = (start + stop) // 2
    out.stamp_ns = s.stamp_ns[middle]
    out.force_mps2[:] = 0.0
    out.field_tesla[:] = 0.0
    fields = 0
    for i in range(start, stop):
        out.force_mps2[:] += s.accel_mps2[i]
        if s.field_sd_tesla[i] >= 0.0:
            out.field_tesla[:] += s.field_tesla[i]
            fields += 1
    out.force_mps2[:] /= stop - start
    out.field_tesla[:] /= max(1, fields)
    out.field_seen = fields > 0
    s.left_ns = s.stamp_ns[last - 1]
    swing_memory.keep_from(middle, s)
    swing_memory.level_from(out.force_mps2, s)

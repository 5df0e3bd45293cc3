"""Where a foot stands that no detector of stances has seen standing: in a run, or at a low rate of samples.

A runner's foot is flat for an instant, in the dip of the stride. A walker's has been still for as long as it takes to
end a stride, but 20 Hz may show less of that than a stance needs. The accelerometer of that moment is not to be
trusted: the foot has landed a moment ago. So up is what the same foot showed when it stood last; the field is that
about the moment. A foot that lands on its toes leans otherwise, and the heading is off by the tangent of the field's
dip times as much.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import nanoseconds
from pdr_core.gait.stands import Stand
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, fresh, record
from pdr_core.maths.vector import row
from pdr_core.params import GaitParams
from pdr_core.records import Floats, ImuBlock
from pdr_core.records_gait import Behaviour, GaitStep

FLAT_NS = nanoseconds(0.03)  # to both sides of the moment
CAPACITY = 2048  # samples that are remembered: 2 s of them at 1 kHz
MEMORY = record(
    [
        ("count", np.int64),  # samples since the clock was set back
        ("stamp_ns", np.int64, CAPACITY),  # a ring
        ("field_tesla", np.float64, (CAPACITY, 3)),
        ("field_sd_tesla", np.float64, CAPACITY),
    ],
)


class UnseenStands:
    """Remembers the samples of the last moments."""

    def __init__(self, params: GaitParams) -> None:
        self._still_ns = nanoseconds(params.calm_s)
        self.memory = fresh(MEMORY)

    def stand(self, step: GaitStep, standing_mps2: Floats) -> Stand:
        """Return the stand that ends a stride; `standing_mps2`, (3,), is the specific force of the foot that stands."""
        ran = step.behaviour is Behaviour.RUNNING
        stamp_ns = step.stamp_ns if ran else step.stamp_ns + self._still_ns // 2
        field_tesla, seen = field_about(stamp_ns, self.memory)
        return Stand(stamp_ns, standing_mps2.copy(), field_tesla, seen, None)


@compiled
def remember(imu: ImuBlock, i: int, s: Memory) -> None:
    """Take sample i."""
    if s.count > 0 and imu.stamp_ns[i] < s.stamp_ns[(s.count - 1) % CAPACITY]:
        s.count = 0
    at = s.count % CAPACITY
    s.stamp_ns[at], s.field_sd_tesla[at] = imu.stamp_ns[i], imu.field_sd_tesla[i]
    s.field_tesla[at] = row(imu.field_tesla, i)
    s.count += 1


@compiled
def field_about(stamp_ns: int, memory: NDArray[Any]) -> tuple[Floats, bool]:
    """Return the mean field, (3,), about a stamp, and whether there is one."""
    s, field_tesla, seen = memory[0], np.zeros(3), 0
    for i in range(max(0, s.count - CAPACITY), s.count):
        at = i % CAPACITY
        if abs(s.stamp_ns[at] - stamp_ns) <= FLAT_NS and s.field_sd_tesla[at] >= 0.0:
            field_tesla += s.field_tesla[at]
            seen += 1
    return field_tesla / max(1, seen), seen > 0

"""By how much a filter has been turned by what it was told: where an answer applies, the yaw jumps."""

from collections import deque

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, NO_STAMP
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import rows, yaw_rad
from pdr_core.records import Floats, NavBlock


class YawJumps:
    """Takes estimates, and the stamps at which answers apply."""

    def __init__(self) -> None:
        self._due_ns: deque[int] = deque()
        self._sum_rad = 0.0
        self._last: tuple[int, float, float] | None = None  # stamp, yaw, and yaw rate in the world

    def expect(self, due_ns: int) -> None:
        """Take it that an answer applies from a stamp on."""
        if due_ns != NO_STAMP:
            self._due_ns.append(due_ns)

    def run(self, nav: NavBlock) -> Floats:
        """Return the sum of all jumps so far at each of n estimates, (n,)."""
        out = np.full(len(nav.stamp_ns), self._sum_rad)
        for i in self._to_look_at(nav):
            now = seen(nav, i)
            if self._due_ns and now[0] >= self._due_ns[0]:
                while self._due_ns and now[0] >= self._due_ns[0]:
                    self._due_ns.popleft()
                before = seen(nav, i - 1) if i else self._last
                self._sum_rad += jump_rad(before, now) if before else 0.0
                out[i:] = self._sum_rad
        self._last = seen(nav, len(nav.stamp_ns) - 1)
        return out

    def _to_look_at(self, nav: NavBlock) -> list[int]:
        """Return the first estimate at or after each stamp at which an answer applies."""
        return sorted({int(np.searchsorted(nav.stamp_ns, due)) for due in self._due_ns} - {len(nav.stamp_ns)})


def seen(nav: NavBlock, i: int) -> tuple[int, float, float]:
    """Return stamp, yaw and yaw rate in the world of estimate i."""
    up = np.array(rows(nav.quat_xyzw[i])[2])
    return int(nav.stamp_ns[i]), float(yaw_rad(nav.quat_xyzw[i])), float(up @ nav.rate_radps[i])


def jump_rad(before: tuple[int, float, float], now: tuple[int, float, float]) -> float:
    """Return by how much the yaw has changed beyond what its rate makes of the time between; 0 across a gap."""
    if now[0] - before[0] > GAP_NS:
        return 0.0
    return wrapped_rad(now[1] - before[1] - 0.5 * (before[2] + now[2]) * (now[0] - before[0]) / NANOSECONDS)

"""The latest estimates of one foot, by stamp: what they are between two rows, and what of a stream can be used."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import normalised
from pdr_core.records import Flags, Floats, NavBlock, Stamps, joined, length, part

RESTART_NS = NANOSECONDS  # a clock that jumps back by more is a new one, by less the row comes late

NEVER_NS = 2**63 - 1
LOST_YAW_RAD2 = 0.25  # half a radian: a row with which the yaw becomes so much less known ends a gap
STARTED_ANEW = 0.01  # the variance of the place falls below this share of what it was

NO_ROWS = NavBlock(
    np.zeros(0, np.int64),
    np.zeros((0, 3)),
    np.zeros((0, 4)),
    np.zeros((0, 3)),
    np.zeros((0, 3)),
    np.zeros((0, 6, 6)),
    np.zeros((0, 6, 6)),
)


def room(count: int) -> NavBlock:
    """Return room for so many rows."""
    return NavBlock._make(np.zeros((count, *column.shape[1:]), column.dtype) for column in NO_ROWS)


def chosen(nav: NavBlock, rows: Flags) -> NavBlock:
    """Return some of the rows."""
    return nav if rows.all() else NavBlock._make(column[rows] for column in nav)


class FootRows:
    """Estimates whose stamps ascend; those that nobody will ask for are forgotten."""

    def __init__(self) -> None:
        self.rows = NO_ROWS
        self._lost: list[tuple[int, int]] = []  # after which stamp, until which one

    @property
    def last_ns(self) -> int:
        """The stamp of the last row; NO_STAMP: none."""
        return int(self.rows.stamp_ns[-1]) if length(self.rows) else NO_STAMP

    def add(self, rows: NavBlock) -> None:
        """Take later rows."""
        self.rows = joined([self.rows, rows]) if length(self.rows) else rows

    def lose(self, after_ns: int) -> None:
        """Take it that the rows after a stamp are in another world, which nobody knows until it is found."""
        self._lost.append((after_ns, NEVER_NS))

    def find(self, from_ns: int) -> None:
        """Take it that the rows can be used from a stamp on."""
        self._lost = [(after_ns, min(until_ns, from_ns)) for after_ns, until_ns in self._lost]

    def after(self, start_ns: int, stop_ns: int) -> NavBlock:
        """Return the rows after a stamp, up to and with another one."""
        first, end = np.searchsorted(self.rows.stamp_ns, [start_ns, stop_ns], side="right")
        return part(self.rows, first, end)

    def at(self, stamp_ns: Stamps) -> tuple[NavBlock, Flags]:
        """Return the estimates at stamps (n,), and at which of them they are known: in no gap, and not before."""
        out = room(len(stamp_ns))
        out.stamp_ns[:] = stamp_ns
        known = np.zeros(len(stamp_ns), np.bool_)
        if length(self.rows):
            interpolate(self.rows, out, known)
        for after_ns, until_ns in self._lost:
            known &= (stamp_ns <= after_ns) | (stamp_ns >= until_ns)
        return out, known

    def forget(self, before_ns: int) -> None:
        """Forget the rows that are not needed for stamps after this one."""
        last = int(np.searchsorted(self.rows.stamp_ns, before_ns, side="right")) - 1
        if last > 0:
            self.rows = part(self.rows, last)
        self._lost = [interval for interval in self._lost if interval[1] > before_ns]


@compiled
def interpolate(rows: NavBlock, out: NavBlock, known: Flags) -> None:
    """Write the estimates at the stamps that `out` holds, and whether the rows around each are near enough."""
    for i in range(out.stamp_ns.shape[0]):
        at = np.searchsorted(rows.stamp_ns, out.stamp_ns[i])
        if at == rows.stamp_ns.shape[0]:
            continue
        before = at if rows.stamp_ns[at] == out.stamp_ns[i] else at - 1
        if before < 0 or rows.stamp_ns[at] - rows.stamp_ns[before] > GAP_NS:
            continue
        span = rows.stamp_ns[at] - rows.stamp_ns[before]
        share = (out.stamp_ns[i] - rows.stamp_ns[before]) / span if span > 0 else 1.0
        mix(rows.position_m, before, at, share, out.position_m[i])
        mix(rows.velocity_mps, before, at, share, out.velocity_mps[i])
        mix(rows.rate_radps, before, at, share, out.rate_radps[i])
        turned(rows.quat_xyzw, before, at, share, out.quat_xyzw[i])
        for j in range(6):
            mix(rows.pose_covariance[:, j], before, at, share, out.pose_covariance[i, j])
            mix(rows.twist_covariance[:, j], before, at, share, out.twist_covariance[i, j])
        known[i] = True


@compiled
def mix(column: Floats, before: int, after: int, share: float, out: Floats) -> None:
    """Write what lies a share of the way from one row of a column, (n, m), to another."""
    for j in range(column.shape[1]):
        out[j] = (1.0 - share) * column[before, j] + share * column[after, j]


@compiled
def turned(quat_xyzw: Floats, before: int, after: int, share: float, out: Floats) -> None:
    """Write the attitude a share of the way from one row to another: rows are so near that the chord is the arc."""
    sign, alike = 1.0, 0.0
    for j in range(4):
        alike += quat_xyzw[before, j] * quat_xyzw[after, j]
    if alike < 0.0:
        sign = -1.0
    for j in range(4):
        out[j] = (1.0 - share) * sign * quat_xyzw[before, j] + share * quat_xyzw[after, j]
    mean = normalised(out)
    for j in range(4):
        out[j] = mean[j]


def usable(nav: NavBlock) -> NavBlock:
    """Return the rows without NaN or infinity."""
    finite = np.ones(length(nav), np.bool_)
    for column in nav:
        finite &= np.isfinite(column).all(axis=tuple(range(1, column.ndim)))
    return chosen(nav, finite)


def in_order(nav: NavBlock, last_ns: int) -> Iterator[tuple[bool, NavBlock]]:
    """Yield the rows later than `last_ns` and all before them; True: with them the clock has jumped back."""
    restarted = False
    while length(nav):
        latest_ns = np.maximum.accumulate(np.concatenate([[last_ns], nav.stamp_ns]))[:-1]
        back = (latest_ns != NO_STAMP) & (nav.stamp_ns < np.maximum(latest_ns, NO_STAMP + RESTART_NS) - RESTART_NS)
        end = int(back.argmax()) if back.any() else length(nav)
        later = nav.stamp_ns[:end] > latest_ns[:end]
        if later.any():
            yield restarted, chosen(part(nav, 0, end), later)
        nav, last_ns, restarted = part(nav, end), NO_STAMP, True


def worlds(rows: NavBlock, before: NavBlock | None) -> Iterator[tuple[bool, NavBlock]]:
    """Yield rows of one world each, and whether it is another one than that of the row before.

    A filter that is started anew knows its place by definition: better by far than the one before did.
    """
    variance_m2 = rows.pose_covariance[:, 0, 0] + rows.pose_covariance[:, 1, 1]
    last_m2 = before.pose_covariance[0, 0, 0] + before.pose_covariance[0, 1, 1] if before else 0.0
    anew = variance_m2 < STARTED_ANEW * np.concatenate([[last_m2], variance_m2[:-1]])
    starts = [0, *(i for i in np.flatnonzero(anew).tolist() if i > 0), length(rows)]
    for start, stop in pairwise(starts):
        yield bool(anew[start]), part(rows, start, stop)


def lost_yaws_ns(rows: NavBlock, before: NavBlock | None) -> list[int]:
    """Return the stamps of the rows with which the yaw gets lost, as in a gap in which a person may have turned."""
    variance_rad2 = rows.pose_covariance[:, 5, 5]
    last_rad2 = before.pose_covariance[0, 5, 5] if before else variance_rad2[0]
    earlier_rad2 = np.concatenate([[last_rad2], variance_rad2[:-1]])
    lost: Stamps = rows.stamp_ns[variance_rad2 > earlier_rad2 + LOST_YAW_RAD2]
    return lost.tolist()

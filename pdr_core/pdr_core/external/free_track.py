"""Our own track as their point sees it: smoothed over a stride where they follow the body, without jumps.

A foot stands and swings, a body goes evenly: the mean of the foot over one stride is where the body is, but for a
constant. What a filter is told makes its track jump. A step says by how much: the place where it began, as it is known
now, minus the place where the last one ended, as that was known then. All that lies before is moved along, so the track
is that of the steps alone, laid to where the person is now.

What a filter is told also turns it: by how much, the estimates before and after tell, less the rate between them. With
each turn taken back, the track is that of a person whom nobody has told anything since: the witness against a source.

Their point may lie beside her, so far ahead and to the left as she walks: where that is, the way over a stride tells.
"""

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, NO_STAMP, nanoseconds
from pdr_core.external.yaw_jumps import YawJumps
from pdr_core.records import Flags, Floats, NavBlock, Stamps, StepEvent, length

EVERY_NS = 50_000_000
KEPT = 16_000  # rows: some 13 minutes
STRIDE_NS = 1_100_000_000
WALKS_M = 0.3  # a stride so long has a direction
Complexes = np.ndarray
LATER_NS = 2**63 - 1
SPEED_NS = NANOSECONDS // 10


class FreeTrack:
    """Takes estimates and steps of a foot; tells where its body was."""

    def __init__(self, window_s: float, beside_m: tuple[float, float] = (0.0, 0.0)) -> None:
        self._half_ns = nanoseconds(window_s / 2.0)
        self._stride_ns = 2 * self._half_ns or STRIDE_NS
        self._beside = np.array(beside_m) @ [1.0, 1.0j]  # ahead and to the left, in the plane of complex numbers
        self._ahead: Complexes = np.zeros(0, np.complex128)  # where she walks, of length 1
        self._stamp_ns: Stamps = np.zeros(0, np.int64)
        self._position_m: Floats = np.zeros((0, 3))
        self._told_rad: Floats = np.zeros(0)  # by how much the track had been turned by what it was told
        self._moved_m: Floats = np.zeros((0, 3))  # and moved, where the foot stood then
        self._jumps = YawJumps()
        self._last_step: StepEvent | None = None
        self._horizon_ns = LATER_NS

    @property
    def last_ns(self) -> int:
        """The last stamp; NO_STAMP: none."""
        return int(self._stamp_ns[-1]) if len(self._stamp_ns) else NO_STAMP

    def add(self, nav: NavBlock) -> None:
        """Take later estimates."""
        if not length(nav):
            return
        told_rad = self._jumps.run(nav)
        picked = []
        latest_ns = self.last_ns
        for i, at_ns in enumerate(nav.stamp_ns.tolist()):
            if latest_ns == NO_STAMP or at_ns >= latest_ns + EVERY_NS:
                picked.append(i)
                latest_ns = at_ns
        if picked:
            self._stamp_ns = np.concatenate([self._stamp_ns, nav.stamp_ns[picked]])[-KEPT:]
            self._position_m = np.concatenate([self._position_m, nav.position_m[picked]])[-KEPT:]
            self._ahead = np.concatenate([self._ahead, self._directions(len(picked))])[-KEPT:]
            self._told_rad = np.concatenate([self._told_rad, told_rad[picked]])[-KEPT:]
            moved_m = self._moved_m[-1:] if len(self._moved_m) else np.zeros((1, 3))
            self._moved_m = np.concatenate([self._moved_m, np.repeat(moved_m, len(picked), axis=0)])[-KEPT:]

    def step(self, step: StepEvent) -> None:
        """Take a step: what its filter has been told since the last one moves what lies before.

        From then on nothing after its end counts: so the answer is the same whatever has come already.
        """
        self._horizon_ns = step.stamp_ns - EVERY_NS
        before, self._last_step = self._last_step, step
        self._jumps.expect(step.answer_due_ns)
        if before and before.stamp_ns == step.start_ns:
            moved_m = step.position_m - step.displacement_m - before.position_m
            self._position_m[self._stamp_ns < before.answer_due_ns] += moved_m
            self._moved_m[self._stamp_ns >= before.answer_due_ns] += moved_m

    def at(self, stamp_ns: Stamps) -> tuple[Floats, Flags]:
        """Return where the body was at stamps (n,), (n, 3), and at which of them that is known."""
        if len(self._stamp_ns) < 2 or not len(stamp_ns):
            return np.zeros((len(stamp_ns), 3)), np.zeros(len(stamp_ns), np.bool_)
        rows = self._around(stamp_ns)
        place_m = self._smoothed(stamp_ns, rows, self._position_m[rows])
        return place_m + self._beside_m(stamp_ns, rows, np.zeros(1)), self._known(stamp_ns)

    def untold(self, stamp_ns: Stamps) -> tuple[Floats, Flags]:
        """Return what `at` does, of a track that went on from the first stamp as if it had been told nothing since."""
        if len(self._stamp_ns) < 2 or not len(stamp_ns):
            return np.zeros((len(stamp_ns), 3)), np.zeros(len(stamp_ns), np.bool_)
        rows = self._around(stamp_ns)
        first = np.searchsorted(self._stamp_ns[rows], stamp_ns[0])
        back_rad = self._told_rad[rows][first] - self._told_rad[rows]
        moved_m = np.diff(self._position_m[rows], axis=0)
        c, s = np.cos(back_rad[1:]), np.sin(back_rad[1:])
        x, y = c * moved_m[:, 0] - s * moved_m[:, 1], s * moved_m[:, 0] + c * moved_m[:, 1]
        path_m = np.concatenate([np.zeros((1, 3)), np.cumsum(np.column_stack([x, y, moved_m[:, 2]]), axis=0)])
        path_m += self._position_m[rows][first] - path_m[first]
        return self._smoothed(stamp_ns, rows, path_m) + self._beside_m(stamp_ns, rows, back_rad), self._known(stamp_ns)

    def told(self, since_ns: int, until_ns: int) -> tuple[float, Floats]:
        """Return by how much what was told between two stamps has turned the track [rad], and moved the foot (3,)."""
        stamps = np.array([since_ns, until_ns])
        first, last = np.clip(np.searchsorted(self._stamp_ns, stamps), 0, len(self._stamp_ns) - 1)
        end_m, untold_m = self.at(stamps)[0][1], self.untold(stamps)[0][1]
        moved_m = self._moved_m[last] - self._moved_m[first] + end_m - untold_m
        return float(self._told_rad[last] - self._told_rad[first]), moved_m

    def moving(self, stamp_ns: Stamps) -> tuple[Floats, Floats, Flags]:
        """Return what `at` does, the velocities (n, 2) between, and at which stamps (n,) all of it is known."""
        (before_m, first), (now_m, known), (after_m, last) = (self.at(stamp_ns + s * SPEED_NS) for s in (-1, 0, 1))
        return now_m, (after_m - before_m)[:, :2] * (0.5 * NANOSECONDS / SPEED_NS), first & known & last

    def turning_lever(self, stamp_ns: Stamps, since_ns: int) -> Floats:
        """Return by how much places at stamps (n,) move with a turn rate, seen from the track at one, (n, 2) [m s]."""
        t, wanted = self._seconds(self._stamp_ns), self._seconds(stamp_ns)
        since_s = (since_ns - int(self._stamp_ns[0])) / NANOSECONDS
        moved = np.diff(self._position_m[:, :2], axis=0)
        grown = (t[1:, None] - since_s) * np.column_stack([-moved[:, 1], moved[:, 0]])
        levers = np.concatenate([np.zeros((1, 2)), np.cumsum(grown, axis=0)])
        return interpolated(wanted, t, levers) - interpolated(np.array([since_s]), t, levers)

    def _known(self, stamp_ns: Stamps) -> Flags:
        last_ns = min(self.last_ns, self._horizon_ns)
        after = np.clip(np.searchsorted(self._stamp_ns, stamp_ns), 1, len(self._stamp_ns) - 1)
        no_gap = self._stamp_ns[after] - self._stamp_ns[after - 1] <= EVERY_NS + GAP_NS
        return no_gap & (stamp_ns - self._half_ns >= self._stamp_ns[0]) & (stamp_ns + self._half_ns <= last_ns)

    def _around(self, stamp_ns: Stamps) -> slice:
        """Return the rows that are needed for stamps (n,)."""
        first_ns, last_ns = stamp_ns.min() - self._half_ns, stamp_ns.max() + self._half_ns
        begin, end = np.searchsorted(self._stamp_ns, [first_ns, last_ns])
        return slice(min(max(int(begin) - 1, 0), len(self._stamp_ns) - 2), int(end) + 1)

    def _smoothed(self, stamp_ns: Stamps, rows: slice, position_m: Floats) -> Floats:
        """Return the mean of a stride about stamps (n,), (n, 3), of places (k, 3) at the rows."""
        t = self._seconds(self._stamp_ns[rows])
        if self._half_ns == 0:
            return interpolated(self._seconds(stamp_ns), t, position_m)
        mean_m = 0.5 * (position_m[1:] + position_m[:-1]) * np.diff(t)[:, None]
        integral = np.concatenate([np.zeros((1, 3)), np.cumsum(mean_m, axis=0)])
        first, last = (interpolated(self._seconds(stamp_ns + s * self._half_ns), t, integral) for s in (-1, 1))
        return (last - first) * (0.5 * NANOSECONDS / self._half_ns)

    def _beside_m(self, stamp_ns: Stamps, rows: slice, turned_rad: Floats) -> Floats:
        """Return where their point is beside the body at stamps (n,), (n, 3), of a track turned at k rows, (k,)."""
        t, wanted = self._seconds(self._stamp_ns[rows]), self._seconds(stamp_ns + self._half_ns)
        way = self._beside * self._ahead[rows] * np.exp(1j * turned_rad)
        return interpolated(wanted, t, np.column_stack([way.real, way.imag, np.zeros(len(way))]))

    def _directions(self, count: int) -> Complexes:
        """Return where she walks at the last rows: along the way of the last stride, or as before while she stands."""
        position = self._position_m[:, 0] + 1j * self._position_m[:, 1]
        before = np.searchsorted(self._stamp_ns, self._stamp_ns[-count:] - self._stride_ns)
        ahead, out = self._ahead[-1] if len(self._ahead) else 1.0 + 0.0j, []
        for way in (position[-count:] - position[before]).tolist():
            ahead = way / abs(way) if abs(way) > WALKS_M else ahead
            out.append(ahead)
        return np.array(out)

    def _seconds(self, stamp_ns: Stamps) -> Floats:
        return (stamp_ns - self._stamp_ns[0]) / NANOSECONDS


def interpolated(wanted_s: Floats, known_s: Floats, values: Floats) -> Floats:
    """Return values (n, m) at wanted times, from those at ascending ones, linearly."""
    return np.column_stack([np.interp(wanted_s, known_s, column) for column in values.T])

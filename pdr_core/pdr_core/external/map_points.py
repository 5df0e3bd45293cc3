"""Points at which somebody says the person is, as they come: where our track lies on the map, from the second on.

A person who says so stands, so the clock of whoever hears her need not be finer than a second.
"""

from collections import deque
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.external.comparing import Comparing, RunningAte
from pdr_core.external.free_track import EVERY_NS, KEPT, LATER_NS, FreeTrack
from pdr_core.external.intake import Fix, FixIntake
from pdr_core.external.known_points import PLANE, between_known_points, corrected, grown_since
from pdr_core.notices import Tally
from pdr_core.params import ExternalParams
from pdr_core.records import Floats, Level, NavBlock, Notice, length
from pdr_core.records_external import ExternalComparison, ExternalFrame, FixBlock

EARLY = "a known point came before the first estimate: say it again"
ONE = "one point on the map is known: a second one, some way off, tells the heading"
PLACED = "the track lies on the map: {:.2f} m and {:.1f} deg well"
REFUSED = "a known point is left out: {}"


class Known(NamedTuple):
    """A point on our track and on the map."""

    ours_m: Floats  # (3,)
    map_m: Floats  # (3,)
    sd_m: float
    covariance: Floats  # (3, 3) of x, y and yaw on our track


class MapPoints:
    """Takes estimates of ours and known points."""

    def __init__(self, params: ExternalParams) -> None:
        self._params = params
        self._tally = Tally()
        self._intake = FixIntake(replace(params, apart_s=0.0), self._tally)  # she means each of them
        self._half_ns = nanoseconds(0.5 * params.body_window_s)
        self._begin()

    def _begin(self) -> None:
        self._track = FreeTrack(self._params.body_window_s)
        self._covariances: deque[tuple[int, Floats]] = deque(maxlen=KEPT)
        self._last: Known | None = None
        self._frame: ExternalFrame | None = None
        self._ate = RunningAte()

    def take(self, fixes: FixBlock, ours_ns: int | None = None) -> None:
        """Take points that came when our stamps had reached `ours_ns`; None: the last estimate."""
        ours_ns = self._track.last_ns if ours_ns is None else ours_ns
        if ours_ns == NO_STAMP:
            self._tally.add("known_point_early", Level.WARN, EARLY, int(fixes.stamp_ns[0]))
        self._intake.take(fixes, ours_ns)

    def add(self, nav: NavBlock) -> None:
        """Take our next estimates."""
        if not length(nav):
            return
        if self._track.last_ns != NO_STAMP and nav.stamp_ns[0] < self._track.last_ns:
            self._begin()
        self._track.add(nav)
        for i, at_ns in enumerate(nav.stamp_ns.tolist()):
            if not self._covariances or at_ns >= self._covariances[-1][0] + EVERY_NS:
                self._covariances.append((at_ns, nav.pose_covariance[i][PLANE]))
        self._look(self._track.last_ns - self._half_ns - nanoseconds(self._params.latency_s))

    def finish(self) -> None:
        """Take the points that wait for later estimates as said where the track ends."""
        if self._covariances:
            self._look(LATER_NS)

    def _look(self, until_ns: int) -> None:
        for fix in self._intake.until(until_ns):
            self._take(self._known(fix), fix[0])

    def _take(self, here: Known, at_ns: int) -> None:
        try:
            self._point(here, at_ns)
        except ValueError as error:
            self._tally.add("known_point_refused", Level.WARN, REFUSED.format(error), at_ns)

    def _known(self, fix: Fix) -> Known:
        """Return where our track was then, or began, or ended."""
        at_ns, map_m, sd_m = fix
        first_ns, last_ns = self._covariances[0][0], self._track.last_ns
        at_ns = max(min(at_ns, last_ns - self._half_ns), first_ns + self._half_ns)
        row = np.searchsorted([ns for ns, _ in self._covariances], at_ns, side="right") - 1
        return Known(self._track.at(np.array([at_ns]))[0][0], map_m, sd_m, self._covariances[row][1])

    def _point(self, here: Known, at_ns: int) -> None:
        """Place the track by one more point, if it is not the first; ValueError if that cannot be."""
        before = self._last
        if self._frame is None:
            self._last = here  # whichever of two points that do not agree was wrong: the next one will tell
        if before:
            self._place(before, here, at_ns)
        else:
            self._tally.add("known_point", Level.OK, ONE, at_ns)

    def _place(self, before: Known, here: Known, at_ns: int) -> None:
        grown = grown_since(before.covariance, here.covariance, here.ours_m[:2] - before.ours_m[:2])
        self._frame = self._corrected(self._frame, here, grown) if self._frame else self._first(before, here, grown)
        self._last = here
        self._ate.add(here.ours_m[:2], here.map_m[:2])
        sd_m = np.sqrt(np.linalg.eigvalsh(self._frame.place_covariance_m2(here.ours_m))[-1])
        text = PLACED.format(sd_m, np.degrees(np.sqrt(self._frame.covariance[2, 2])))
        self._tally.add("known_points", Level.OK, text, at_ns)

    def _first(self, before: Known, here: Known, grown: Floats) -> ExternalFrame:
        """Return the frame by two points, and how far our heading may have turned between them."""
        ours_m, map_m = np.array([before.ours_m, here.ours_m]), np.array([before.map_m, here.map_m])
        sd_m = float(np.hypot(before.sd_m, here.sd_m) / np.sqrt(2.0))
        frame = between_known_points(ours_m, grown[:2, :2], map_m, sd_m)
        frame.covariance[2, 2] += grown[2, 2]
        self._ate.add(before.ours_m[:2], before.map_m[:2])
        return frame

    def _corrected(self, frame: ExternalFrame, here: Known, grown: Floats) -> ExternalFrame:
        return corrected(frame, here.ours_m, grown, here.map_m, here.sd_m, self._params.gate)

    @property
    def comparison(self) -> ExternalComparison:
        """Where the track lies on the map."""
        return ExternalComparison(self._frame, self._ate.count, self._ate.ate_m)

    @property
    def notices(self) -> list[Notice]:
        """What came of the points."""
        return self._tally.notices


def compared_with(params: ExternalParams) -> Comparing | MapPoints:
    """Return what lays our track beside what they publish."""
    return MapPoints(params) if params.known_points else Comparing(params)

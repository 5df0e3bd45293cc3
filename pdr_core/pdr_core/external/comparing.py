"""Our track beside theirs, while both go on: the frame between them, and the ATE so far in constant memory.

With all places about their means, p of ours and z of theirs, D the sum of p' z and X that of p x z, the best turn and
shift leave the squares (closed form, Umeyama 1991 in the plane)

    sum |p|^2 + sum |z|^2 - 2 sqrt(D^2 + X^2).
"""

from collections import deque

import numpy as np

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.external.aligning import Priors, aligned, good
from pdr_core.external.free_track import LATER_NS, FreeTrack
from pdr_core.external.intake import Fix, FixIntake, as_fixes, beside_m
from pdr_core.external.refining import with_point
from pdr_core.notices import Tally
from pdr_core.params import ExternalParams
from pdr_core.records import Floats, Level, NavBlock, Notice, length
from pdr_core.records_external import ExternalComparison, ExternalFrame, FixBlock

PAIRS = 200  # fixes from which the frame is found
JUMP_M = 3.0  # a fix that jumps so far against the one before, beyond five deviations, is an outlier
RELOCATED = 5  # unless so many do in a row
OUTLIER = "fixes of the external source jump away: left out of the comparison"


class RunningAte:
    """Sums over pairs of places, (2,) each."""

    def __init__(self) -> None:
        self.count = 0
        self._origin: tuple[complex, complex] = (0j, 0j)
        self._sums = np.zeros(3, np.complex128)  # of p, of z, of conj(p) z
        self._squares = np.zeros(2)

    def add(self, ours_m: Floats, theirs_m: Floats) -> None:
        """Take a pair."""
        p, z = complex(*ours_m), complex(*theirs_m)
        if not self.count:
            self._origin = p, z
        p, z = p - self._origin[0], z - self._origin[1]
        self.count += 1
        self._sums += [p, z, p.conjugate() * z]
        self._squares += [abs(p) ** 2, abs(z) ** 2]

    @property
    def ate_m(self) -> float:
        """Horizontal RMSE after the best yaw and shift; NaN of no pair."""
        if not self.count:
            return float("nan")
        p, z, pz = self._sums / self.count
        spread = self._squares.sum() / self.count - abs(p) ** 2 - abs(z) ** 2
        return float(np.sqrt(max(spread - 2.0 * abs(pz - p.conjugate() * z), 0.0)))


class Comparing:
    """Takes estimates of ours and fixes of theirs."""

    def __init__(self, params: ExternalParams) -> None:
        self._params = params
        self._tally = Tally()
        self._intake = FixIntake(params, self._tally)
        self._wait_ns = nanoseconds(0.5 * params.body_window_s + params.latency_s + 2.0 * params.clock_sd_s)
        self._begin()

    def _begin(self) -> None:
        self._track = FreeTrack(self._params.body_window_s, beside_m(self._params))
        self._pairs: deque[Fix] = deque(maxlen=PAIRS)
        self._frame: ExternalFrame | None = None
        self._ate = RunningAte()
        self._off_m: Floats | None = None  # of the last pair
        self._jumped = 0
        self._named_ns = NO_STAMP  # the last outlier that was counted
        self._begun = self._intake.begun

    def take(self, fixes: FixBlock, ours_ns: int | None = None) -> None:
        """Take fixes that came when our stamps had reached `ours_ns`; None: the last estimate."""
        self._intake.take(fixes, self._track.last_ns if ours_ns is None else ours_ns)

    def add(self, nav: NavBlock) -> None:
        """Take our next estimates."""
        if not length(nav):
            return
        restarted = self._track.last_ns != NO_STAMP and nav.stamp_ns[0] < self._track.last_ns
        if restarted or self._begun != self._intake.begun > 1:
            self._begin()
        self._track.add(nav)
        self._look(self._track.last_ns - self._wait_ns)

    def finish(self) -> None:
        """Take it that no more estimates come."""
        self._look(LATER_NS)

    def _look(self, until_ns: int) -> None:
        new = self._intake.until(until_ns)
        self._pairs += new
        if new and not (self._seeks and self._align()) and self._frame:
            self._compare(new)

    @property
    def _seeks(self) -> bool:
        """More fixes tell more of the frame, or of the clock, which a straight line cannot tell."""
        seeks_clock = self._frame is not None and self._frame.clock_sd_s > self._params.aligned_sd_s
        return self._ate.count < PAIRS or seeks_clock

    def _align(self) -> bool:
        """Find the frame anew from all pairs so far, and compare them in it; return whether it was found."""
        coarse_ns, fixes = self._intake.coarse_ns, as_fixes(list(self._pairs))
        found = aligned(fixes, self._track, Priors(self._params.clock_sd_s, self._params.drift_sd_radps), coarse_ns)
        if found is None or not (self._frame or good(found, fixes, self._track, self._params)):
            return False
        self._frame, self._ate, self._off_m = found, RunningAte(), None
        self._compare(list(self._pairs))
        return True

    def _compare(self, fixes: list[Fix]) -> None:
        assert self._frame is not None
        rest_ns = self._frame.clock_ns - self._intake.coarse_ns
        for at_ns, theirs_m, sd_m in fixes:
            ours_m, known = self._track.at(np.array([at_ns - rest_ns]))
            if known[0] and self._goes_on(self._frame.ours_m(theirs_m) - ours_m[0], sd_m, at_ns):
                self._ate.add(ours_m[0, :2], theirs_m[:2])

    def _goes_on(self, off_m: Floats, sd_m: float, at_ns: int) -> bool:
        """Tell whether a fix lies where it can, seen from the one before."""
        before_m = np.zeros(3) if self._off_m is None else self._off_m
        jumps = bool(np.linalg.norm((off_m - before_m)[:2]) > JUMP_M + 5.0 * sd_m)
        self._jumped = self._jumped + 1 if jumps else 0
        if jumps and self._jumped < RELOCATED:
            if at_ns > self._named_ns:
                self._tally.add("external_outlier", Level.WARN, OUTLIER, at_ns)
                self._named_ns = at_ns
            return False
        self._off_m = off_m
        return True

    @property
    def comparison(self) -> ExternalComparison:
        """How both compare so far."""
        frame = with_point(self._frame, self._params.point_sd_m) if self._frame else None
        return ExternalComparison(frame, self._ate.count, self._ate.ate_m)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._tally.notices

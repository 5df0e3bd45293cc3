"""Fixes as they come: numbers only, in order, not more often than they tell something, on our clock but for a rest."""

from collections import deque

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP, nanoseconds
from pdr_core.external.aligning import Fixes
from pdr_core.notices import Tally
from pdr_core.params import ExternalParams
from pdr_core.records import Floats, Level, Notice
from pdr_core.records_external import FixBlock, about_up

BACK_NS = NANOSECONDS  # a clock that jumps back by more begins anew
NO_YAW = "the person is told from the pose of the external source, which says no orientation: left out"
NO_NUMBER = "fixes of the external source hold NaN or infinity: left out"
OUT_OF_ORDER = "fixes of the external source come late or twice: left out"
CLOCK_BACK = "the clock of the external source has jumped back: the frames are aligned anew"
CLOCKS_APART = "the external source's clock counts from another moment: set by what came together, and refined"

THEIRS = "theirs"  # `external.offset_from`
Fix = tuple[int, np.ndarray, float]  # stamp on our clock but for the rest, place (3,), deviation of x and y


class FixIntake:
    """Holds the fixes back until our track has come so far."""

    def __init__(self, params: ExternalParams, tally: Tally) -> None:
        self._params = params
        self._tally = tally
        self._offset_m = np.array([params.offset_x_m, params.offset_y_m, 0.0]) * (params.offset_from == THEIRS)
        self._waiting: deque[Fix] = deque()
        self._last_ns = NO_STAMP  # their clock
        self._taken_ns = NO_STAMP
        self.coarse_ns = 0  # their clock is ahead by so much, as far as the first fix showed
        self.begun = 0  # how often a clock began

    def take(self, fixes: FixBlock, ours_ns: int) -> None:
        """Take fixes that came when our stamps had reached `ours_ns`; NO_STAMP: none yet, so nothing to lay them to."""
        if ours_ns == NO_STAMP:
            return
        for i, at_ns in enumerate(fixes.stamp_ns.tolist()):
            if not (np.isfinite(fixes.position_m[i]).all() and np.isfinite(fixes.variance_m2[i]).all()):
                self._tally.add("external_no_number", Level.WARN, NO_NUMBER, at_ns)
            elif self._offset_m.any() and not np.isfinite(fixes.yaw_rad[i]):
                self._tally.add("external_no_yaw", Level.WARN, NO_YAW, at_ns)
            elif self._in_order(at_ns, ours_ns):
                place_m = self._person_m(fixes.position_m[i], fixes.yaw_rad[i])
                self._waiting.append((at_ns - self.coarse_ns, place_m, self._sd_m(fixes.variance_m2[i])))

    def _person_m(self, position_m: Floats, yaw_rad: float) -> Floats:
        """Return where the person is, (3,), as seen from a pose of theirs."""
        return position_m + about_up(yaw_rad) @ self._offset_m if self._offset_m.any() else position_m

    def until(self, ours_ns: int) -> list[Fix]:
        """Return the fixes up to a stamp of ours, each once."""
        out = []
        while self._waiting and self._waiting[0][0] <= ours_ns:
            out.append(self._waiting.popleft())
        return out

    def _in_order(self, at_ns: int, ours_ns: int) -> bool:
        """Tell whether a fix is a new one; the first of a clock sets it."""
        if self._last_ns != NO_STAMP and at_ns < self._last_ns - BACK_NS:
            self._tally.add("external_clock_back", Level.WARN, CLOCK_BACK, at_ns)
            self._last_ns = NO_STAMP
            self._waiting.clear()
        if self._last_ns == NO_STAMP:
            self._begin(at_ns, ours_ns)
        elif at_ns <= self._last_ns:
            self._tally.add("external_out_of_order", Level.WARN, OUT_OF_ORDER, at_ns)
            return False
        self._last_ns = at_ns
        if at_ns < self._taken_ns + nanoseconds(self._params.apart_s):
            return False
        self._taken_ns = at_ns
        return True

    def _begin(self, at_ns: int, ours_ns: int) -> None:
        self.begun += 1
        self._taken_ns = NO_STAMP
        apart_ns = at_ns - ours_ns
        far = abs(apart_ns) > nanoseconds(self._params.clock_same_s)
        self.coarse_ns = apart_ns if far else 0
        if far:
            self._tally.add("external_clocks_apart", Level.OK, CLOCKS_APART, at_ns)

    def _sd_m(self, variance_m2: np.ndarray) -> float:
        mean_m2 = float(np.mean(variance_m2[:2]))
        noise_m = float(np.sqrt(mean_m2)) if mean_m2 > 0.0 else self._params.sd_m
        return float(np.hypot(noise_m, self._params.point_sd_m))

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far."""
        return self._tally.notices


def beside_m(params: ExternalParams) -> tuple[float, float]:
    """Return where their point is seen from the person as she walks: ahead, and to the left."""
    seen = params.offset_from != THEIRS
    return (params.offset_x_m, params.offset_y_m) if seen else (0.0, 0.0)


def as_fixes(fixes: list[Fix]) -> Fixes:
    """Return fixes column by column."""
    stamps = np.array([at_ns for at_ns, _, _ in fixes], np.int64)
    places = np.array([place_m for _, place_m, _ in fixes], np.float64).reshape(-1, 3)
    return Fixes(stamps, places, np.array([sd_m for *_, sd_m in fixes]))

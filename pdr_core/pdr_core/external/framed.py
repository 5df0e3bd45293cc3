"""A source whose frame is known: each fix is judged, and what is believed says by how much our place is off."""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.external.free_track import FreeTrack
from pdr_core.external.intake import Fix
from pdr_core.external.refining import Apart, by_frame_m2, moves, refined, with_point
from pdr_core.external.trust import Seen, Trust
from pdr_core.notices import Tally
from pdr_core.params import ExternalParams
from pdr_core.records import Floats, Level, PositionError, StepEvent
from pdr_core.records_external import ExternalComparison, ExternalFrame

UNKNOWN_M2 = 1e6
TAKEN_BACK_SHARE = 0.5  # of the deviation before: a filter takes four fifths of what it is told so
KEPT_NS = 600 * NANOSECONDS
OUTLIER = "fixes of the external source lie too far from the track: not believed"
LET_GO = "the external source and the track part: it is not believed until they agree again"
TAKEN_BACK = "the external source agrees with the track again: it is believed"
CHANGES = {
    False: ("external_let_go", Level.WARN, LET_GO),
    True: ("external_taken_back", Level.OK, TAKEN_BACK),
}


class Told(NamedTuple):
    """What a filter is told: errors, estimated minus true; None: nothing."""

    place: PositionError | None = None
    turn: tuple[float, float] | None = None  # of the track, counter-clockwise, and its deviation [rad]


Off = tuple[Floats, float]  # a fix minus our place, (3,), and its deviation


class Framed:
    """Judges fixes, whose stamps are as `FixIntake` gives them, beside our track."""

    def __init__(
        self, frame: ExternalFrame, coarse_ns: int, at_ns: int, params: ExternalParams, track: FreeTrack, tally: Tally
    ) -> None:
        self.frame = frame
        self.strange: list[Fix] = []  # that were not believed since the last one that was
        self._coarse_ns = coarse_ns
        self._believed_ns = at_ns
        self._params, self._track, self._tally = params, track, tally
        self._trust = Trust(params)
        self._squares_m2, self._count = 0.0, 0  # of the distances of the fixes that were believed

    @property
    def holds(self) -> bool:
        """The source is believed."""
        return self._trust.holds

    @property
    def elsewhere(self) -> bool:
        """The source is not believed since it was elsewhere at once."""
        return not self._trust.holds and self._trust.elsewhere

    @property
    def comparison(self) -> ExternalComparison:
        """The frame, and how far the fixes that were believed lie from the track, in it (RMS)."""
        ate_m = float(np.sqrt(self._squares_m2 / self._count)) if self._count else float("nan")
        return ExternalComparison(with_point(self.frame, self._params.point_sd_m), self._count, ate_m)

    def told(self, fixes: list[Fix], step: StepEvent) -> Told:
        """Return what the fixes since the last step tell."""
        held = self._trust.holds
        offs = [off for fix in fixes if (off := self._judged(fix, step)) is not None]
        if held and not self._trust.holds:
            return self._taken_back(fixes[-1])
        return Told(self._mean(offs)) if offs and self._trust.holds else Told()

    def _judged(self, fix: Fix, step: StepEvent) -> Off | None:
        """Return how far a fix is from our track; None where it is not believed, or the frame may be off farther."""
        found = self._apart(fix, step)
        if found is None:
            return None
        apart, at_ns = found
        believed = self._believes(apart, at_ns)
        if believed and self._trust.holds and self._frame_sd_m(apart) > self._params.point_sd_m:
            self.frame = refined(self.frame, apart)
            apart, at_ns = self._apart(fix, step) or found
        self._keep(fix, apart, believed)
        self._judge(Seen(at_ns, self.frame.ours_m(fix[1])[:2], fix[2], step.yaw_sd_rad, believed))
        frame_sd_m = self._frame_sd_m(apart)
        return (apart.off_m, float(np.hypot(apart.sd_m, frame_sd_m))) if believed and frame_sd_m <= apart.sd_m else None

    def _frame_sd_m(self, apart: Apart) -> float:
        """Return how far the frame may be off where a fix is."""
        return float(np.sqrt(np.linalg.eigvalsh(by_frame_m2(self.frame, apart))[-1]))

    def _apart(self, fix: Fix, step: StepEvent) -> tuple[Apart, int] | None:
        """Return a fix beside our place, and its stamp on our clock; None: our place is not known."""
        their_ns, theirs_m, sd_m = fix
        at_ns = their_ns - (self.frame.clock_ns - self._coarse_ns)
        ours_m, velocity_mps, known = self._track.moving(np.array([at_ns]))
        if not known[0]:
            return None
        covariance_m2 = np.zeros((3, 3)) if step.position_covariance_m2 is None else step.position_covariance_m2
        H = moves(self.frame, ours_m[0, :2], velocity_mps[0])
        return Apart(self.frame.ours_m(theirs_m) - ours_m[0], H, covariance_m2[:2, :2], sd_m), at_ns

    def _believes(self, apart: Apart, at_ns: int) -> bool:
        """Tell whether a fix lies where it can; name it if not."""
        ours_m, _ = self._track.at(np.array([at_ns, max(self._believed_ns, at_ns - KEPT_NS)]))
        way_m = float(np.linalg.norm(ours_m[0] - ours_m[1]))
        covariance_m2 = apart.covariance_m2 + by_frame_m2(self.frame, apart)
        believed = self._trust.believes(apart.off_m[:2], covariance_m2, apart.sd_m, way_m)
        if not believed:
            self._tally.add("external_outlier", Level.WARN, OUTLIER, at_ns)
        elif self._trust.holds:
            self._believed_ns = at_ns
        return believed

    def _keep(self, fix: Fix, apart: Apart, believed: bool) -> None:
        if not believed:
            self.strange.append(fix)
        elif self._trust.holds:
            self.strange = []
            self._squares_m2 += float(apart.off_m[:2] @ apart.off_m[:2])
            self._count += 1

    def _judge(self, seen: Seen) -> None:
        """Judge the last while with one more fix, and name what has changed."""
        held, clock_sd_s = self._trust.holds, max(self.frame.clock_sd_s, self._params.aligned_sd_s)
        holds = self._trust.judge(seen, self._track, clock_sd_s)
        if held != holds:
            kind, level, text = CHANGES[holds]
            self._tally.add(kind, level, text, seen.stamp_ns)

    def _taken_back(self, last: Fix) -> Told:
        """Return what was told since the window began, as an error."""
        first = self._trust.begin_anew()
        turned_rad, moved_m = self._track.told(first.stamp_ns, last[0] - (self.frame.clock_ns - self._coarse_ns))
        variance_m2 = (TAKEN_BACK_SHARE * last[2]) ** 2
        place = PositionError(moved_m * [1.0, 1.0, 0.0], np.diag([variance_m2, variance_m2, UNKNOWN_M2]))
        return Told(place, (turned_rad, TAKEN_BACK_SHARE * first.yaw_sd_rad))

    def _mean(self, offs: list[Off]) -> PositionError:
        """Return the mean of several distances as the error of the place."""
        n = len(offs)
        variance_m2 = self._trust.doubt * float(np.mean([sd_m**2 for _, sd_m in offs])) / n
        mean_m = np.mean([off_m for off_m, _ in offs], axis=0)
        up_m2 = variance_m2 if self._params.height else UNKNOWN_M2
        if not self._params.height:
            mean_m[2] = 0.0
        return PositionError(-mean_m, np.diag([variance_m2, variance_m2, up_m2]))

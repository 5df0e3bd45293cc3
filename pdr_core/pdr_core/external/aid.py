"""What somebody else's fixes tell the filter of a foot: by how much its place is off, as the answer to a step.

While the frames are not known, every fix helps to align them (`aligning.py`). Once they are, the frame stays as it is:
if it went on following the filter, both would drift together, each proof of the other. So from then on "right" means
"as their frame says it", and a fix is a measurement of the foot's place with its own noise alone.

Where a source is let go of, what it has told in the window in which it went wrong is taken back as far as a filter
allows: the track without it is a measurement of place and heading, and nearly as good as before.

The fixes since the last step make one answer, the mean of their distances from our track with the variance of that
mean. Which fixes are among them is told by stamps: those at which the body's place was known when the step ended. The
filter's covariances of place with heading and biases do the rest: they are bounded too.
"""

from collections import deque

import numpy as np

from pdr_core.conventions import NANOSECONDS, NO_STAMP, nanoseconds
from pdr_core.external.aligning import Priors, aligned, good
from pdr_core.external.framed import Framed, Told
from pdr_core.external.free_track import FreeTrack
from pdr_core.external.intake import Fix, FixIntake, as_fixes, beside_m
from pdr_core.external.refining import given_clock
from pdr_core.notices import Tally
from pdr_core.params import ExternalParams
from pdr_core.records import Level, NavBlock, Notice, StepEvent, length
from pdr_core.records_external import ExternalComparison, ExternalFrame, FixBlock

PAIRS = 200  # fixes from which the frames are aligned
FROZEN_M = 0.5  # who walks so far does not stay at the same place to the last bit
ALIGNED = "the frame of the external source is known: {:.2f} m, {:.1f} deg and {:.2f} s well"
REALIGNED = "the external source is in another frame now, known {:.2f} m and {:.1f} deg well: the person is not moved"
FROZEN = "the external source says the same place while the person walks: left out"
SILENT = "the external source says nothing: the track goes on without"


class ExternalAid:
    """Takes estimates and steps of one foot and somebody else's fixes; answers each step."""

    def __init__(self, params: ExternalParams) -> None:
        self._params = params
        self._tally = Tally()
        self._intake = FixIntake(params, self._tally)
        self._priors = Priors(params.clock_sd_s, params.drift_sd_radps)
        self._begin()

    def _begin(self) -> None:
        self._framed: Framed | None = None  # None: their frame is not known yet
        self._track = FreeTrack(self._params.body_window_s, beside_m(self._params))
        self._pairs: deque[Fix] = deque(maxlen=PAIRS)
        self._begun = self._intake.begun
        self._last: Fix | None = None
        self._heard_ns = NO_STAMP  # of our stamps

    @property
    def frame(self) -> ExternalFrame | None:
        """Their frame from ours; None: not known yet."""
        return self._framed.frame if self._framed else None

    @property
    def comparison(self) -> ExternalComparison:
        """The frame, and how far the fixes that were believed lie from the track, in it (RMS)."""
        return self._framed.comparison if self._framed else ExternalComparison(None, 0, float("nan"))

    def take(self, fixes: FixBlock, ours_ns: int) -> None:
        """Take fixes that came when our stamps had reached `ours_ns`."""
        self._intake.take(fixes, ours_ns)

    def add(self, nav: NavBlock) -> None:
        """Take the foot's next estimates."""
        if length(nav) and self._track.last_ns != NO_STAMP and nav.stamp_ns[0] < self._track.last_ns - NANOSECONDS:
            self._begin()  # our clock has jumped back
        self._track.add(nav)

    def answer(self, step: StepEvent) -> Told:
        """Return by how much the foot's place is off as a step ends."""
        if self._begun != self._intake.begun and self._begun:
            self._begin()
        self._begun = self._intake.begun
        self._track.step(step)
        new = self._new(step)
        if self._framed is None:
            self._align(new, step)
            return Told()
        told = self._framed.told(new, step)
        if new and self._framed.elsewhere:
            self._align_anew(self._framed.strange[-PAIRS:], step)
        return told

    def _new(self, step: StepEvent) -> list[Fix]:
        """Return the fixes whose places of ours are known as the step ends, frozen ones left out."""
        rest_ns = self.frame.clock_ns - self._intake.coarse_ns if self.frame else 0
        until_ns = step.stamp_ns - nanoseconds(0.5 * self._params.body_window_s + self._params.latency_s)
        found = self._intake.until(until_ns + rest_ns)
        self._heard_ns = found[-1][0] - rest_ns if found else self._heard_ns
        if self._heard_ns != NO_STAMP and until_ns - self._heard_ns > nanoseconds(self._params.silent_s):
            self._tally.add("external_silent", Level.WARN, SILENT, step.stamp_ns)
        return [fix for fix in found if not self._frozen(fix, rest_ns)]

    def _frozen(self, fix: Fix, rest_ns: int) -> bool:
        """Tell whether a fix is the last one again, to the last bit, though the person has walked."""
        last = self._last
        if last is None or not np.array_equal(last[1], fix[1]):
            self._last = fix
            return False
        places_m, known = self._track.at(np.array([last[0], fix[0]]) - rest_ns)
        frozen = bool(known.all() and np.linalg.norm(places_m[1] - places_m[0]) > FROZEN_M)
        if frozen:
            self._tally.add("external_frozen", Level.WARN, FROZEN, fix[0])
        return frozen

    def _align(self, new: list[Fix], step: StepEvent) -> None:
        """Look whether the frames can be told by now."""
        self._pairs += new
        if new and (frame := self._found(list(self._pairs))):
            self._take_on(frame, step, "external_aligned", Level.OK, ALIGNED)

    def _align_anew(self, strange: list[Fix], step: StepEvent) -> None:
        """Look whether what is not believed agrees on another frame over a window."""
        whole = strange[-1][0] - strange[0][0] >= nanoseconds(self._params.window_s)
        if whole and (frame := self._found(strange)):
            self._take_on(frame, step, "external_realigned", Level.WARN, REALIGNED)

    def _found(self, pairs: list[Fix]) -> ExternalFrame | None:
        fixes = as_fixes(pairs)
        frame = aligned(fixes, self._track, self._priors, self._intake.coarse_ns)
        return frame if frame and good(frame, fixes, self._track, self._params) else None

    def _take_on(self, frame: ExternalFrame, step: StepEvent, kind: str, level: Level, text: str) -> None:
        """Judge by this frame from now on, in which our track lies as it does: so nobody is moved."""
        self._framed = Framed(frame, self._intake.coarse_ns, step.stamp_ns, self._params, self._track, self._tally)
        known = given_clock(frame).pose_covariance(step.position_m)
        sd_m, yaw_sd_deg = np.sqrt(np.linalg.eigvalsh(known[:2, :2])[-1]), np.degrees(np.sqrt(known[2, 2]))
        self._tally.add(kind, level, text.format(sd_m, yaw_sd_deg, frame.clock_sd_s), step.stamp_ns)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far, and what was found."""
        return self._tally.notices

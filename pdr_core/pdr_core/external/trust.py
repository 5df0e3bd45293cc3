"""Whether their fixes are believed: each by itself, and all of the last while together.

One fix is not believed whose distance r from our track, with the covariance S of both, has r' S^-1 r beyond the gate.
A source that goes wrong slowly passes that gate for ever, and takes the person along. So over a window the fixes are
laid beside our track as it is without what they have told in it (`FreeTrack.untold`: a filter that follows a drift
across its way turns its heading until there is none): on a line r(t) = a + b t the slope b is the speed at which both
part. With the noise s of the fixes, our heading's deviation y as the window begins at the walking speed v, the share q
by which our lengths may be off, and what a turn by a makes of the distance d between their point and the one that we
compare with, clocks that differ by c included,

    b' b / (s^2 / sum (t - mean t)^2 + (v y)^2 + (v q)^2 + (3/2 a)^2 (d^2 + (v c)^2) / T^2)

(a step amid a window of the length T has the slope 3/2 of its height over T) is chi-square with two degrees of freedom
while both are right. From `SUSPECT` on the fixes count less, their variance grows with its square: until it is sure,
little of a drift is taken in. Beyond the gate the source is let go, and also where most fixes of the window are not
believed. It is taken back when both judge it well over a whole new window.
"""

from collections import deque
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS, nanoseconds
from pdr_core.external.free_track import FreeTrack
from pdr_core.params import ExternalParams
from pdr_core.records import Floats

FEWEST = 6  # fixes in a window that tells something
FULL = 0.7  # of its length is covered
BELIEVED_SHARE, LOST_SHARE = 0.8, 0.4  # so many are believed of a source to be taken back, and to be let go
ALONE_M = 3.0  # a fix so far from the median of the window is wrong by itself
SUSPECT = 4.6  # chi-square, 2 degrees of freedom, 90 %


class Seen(NamedTuple):
    """A fix, laid into our frame."""

    stamp_ns: int
    place_m: Floats  # (2,)
    sd_m: float
    yaw_sd_rad: float  # of our track then
    believed: bool


class Trust:
    """Judges a source while the person walks."""

    def __init__(self, params: ExternalParams) -> None:
        self._params = params
        self._clock_sd_s = 0.0
        self._window: deque[Seen] = deque()
        self.holds = True  # the source is believed
        self.elsewhere = False  # it was let go of with its last fixes far off, not as one that goes away
        self.doubt = 1.0  # by what the variance of its fixes grows

    def believes(self, off_m: Floats, covariance_m2: Floats, sd_m: float, way_m: float) -> bool:
        """Tell whether one fix is believed that is `off_m` (2,) from a place of ours with a covariance (2, 2).

        `way_m` is what was walked since the last one that was.
        """
        S = covariance_m2 + (sd_m**2 + (self._params.drift_share * way_m) ** 2) * np.eye(2)
        return float(off_m @ np.linalg.solve(S, off_m)) <= self._params.gate

    def begin_anew(self) -> Seen:
        """Begin a new window, over which the source must prove itself; return the first fix of the old one."""
        first = self._window[0]
        self._window.clear()
        return first

    def judge(self, seen: Seen, track: FreeTrack, clock_sd_s: float) -> bool:
        """Take a fix into the window; return whether the source is believed now."""
        self._clock_sd_s = clock_sd_s
        self._window.append(seen)
        while self._window[0].stamp_ns < seen.stamp_ns - nanoseconds(self._params.window_s):
            self._window.popleft()
        share = sum(one.believed for one in self._window) / len(self._window)
        if self.holds:
            tells = len(self._window) >= FEWEST
            self.holds = not tells or (share > LOST_SHARE and self._parting(track) <= self._params.window_gate)
            self.elsewhere = not any(one.believed for one in list(self._window)[-FEWEST:])
        elif self._full and share >= BELIEVED_SHARE:
            self.holds = self._parting(track) <= SUSPECT
        return self.holds

    @property
    def _full(self) -> bool:
        span_ns = self._window[-1].stamp_ns - self._window[0].stamp_ns
        return len(self._window) >= FEWEST and span_ns >= FULL * nanoseconds(self._params.window_s)

    def _parting(self, track: FreeTrack) -> float:
        """Return the normalised square of the speed at which the source and our own track part."""
        stamps = np.array([one.stamp_ns for one in self._window], np.int64)
        ours_m, known = track.untold(stamps)
        off_m = np.array([one.place_m for one in self._window]) - ours_m[:, :2]
        known &= np.linalg.norm(off_m - np.median(off_m, axis=0), axis=1) < ALONE_M
        if known.sum() < FEWEST:
            return 0.0
        t = (stamps[known] - stamps[known][0]) / NANOSECONDS
        parting_mps, about = slope_mps(t, off_m[known]), float(np.sum((t - t.mean()) ** 2))
        noise = float(np.mean([one.sd_m**2 for one in self._window])) / about
        variance = noise + self._own_variance(t, ours_m[known, :2], self._window[0].yaw_sd_rad)
        parting = float(parting_mps @ parting_mps / variance)
        self.doubt = max(1.0, parting / SUSPECT) ** 2
        return parting

    def _own_variance(self, t: Floats, ours_m: Floats, yaw_sd_rad: float) -> float:
        """Return the variance [m^2/s^2] that our own track gives the slope: heading, lengths, and turns."""
        span_s, half = max(float(t[-1]), 1.0), len(t) // 2
        v = float(np.linalg.norm(ours_m[-1] - ours_m[0])) / span_s
        before, after = slope_mps(t[: half + 1], ours_m[: half + 1]), slope_mps(t[half:], ours_m[half:])
        cross, dot = before[0] * after[1] - before[1] * after[0], float(before @ after)
        apart_m2 = self._params.point_sd_m**2 + float(before @ before) * self._clock_sd_s**2
        turned = (1.5 * np.arctan2(cross, dot) / span_s) ** 2 * apart_m2
        return v**2 * (yaw_sd_rad**2 + self._params.drift_share**2) + float(turned)


def slope_mps(t: Floats, places_m: Floats) -> Floats:
    """Return the slope of a line through places (n, 2) over times (n,) [s]."""
    about = t - t.mean()
    return about @ places_m / max(float(about @ about), 1e-9)

"""How their frame and clock lie to ours, from fixes and our track: least squares that know how our track drifts.

A fix z at their stamp s is, with p the track of ours, g what a turn rate of the track has moved by the last fix, seen
from there (`FreeTrack.turning_lever`), c a place of ours amid the fixes, and noise n,

    z = R(yaw) (p(t) - drift g(t) - c) + m + n,      t = s - clock,

with five unknowns: yaw, m (2), clock, drift. Each Gauss-Newton step takes the derivatives

    by yaw: R (p - drift g - c) turned by a right angle;   by m: 1;   by clock: -R v(t);   by drift: -R g

with v the speed of p - drift g.

Clock and drift have a prior: nobody's clock is off by minutes after the first look, and no gyro turns freely. On a
straight line at one speed v the clock only moves along it, as m does: R v clock and m cannot be told apart, their
deviations stay large, and only a turn or a stop tells them (`refining.py`). A fix counts by Huber's weight, and not at
all beyond `LOST` deviations. The first guess is the turn and shift, through two fixes, with which most others agree: so
outliers have no say in it. The covariance is that of the weighted fit, larger where the fixes scatter by more than they
say.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.external.free_track import SPEED_NS, FreeTrack
from pdr_core.external.refining import given_clock
from pdr_core.params import ExternalParams
from pdr_core.records import Flags, Floats, Stamps
from pdr_core.records_external import ExternalFrame, about_up

YAW, X, Y, CLOCK, DRIFT, SIZE = 0, 1, 2, 3, 4, 5
HUBER, LOST = 2.5, 6.0  # deviations
ITERATIONS = 12
CLOSE = np.array([1e-5, 1e-4, 1e-4, 1e-4, 1e-7])  # smaller changes are none
AGREE_M = 2.5  # fixes agree with a guess that knows neither clock nor drift
BASE_M = 3.0  # a shorter way has no direction to speak of
GUESSES = 24  # first and last fixes of a guess are taken from so many
FEWEST, SHARE = 8, 0.7  # fixes that agree, at least


class Fixes(NamedTuple):
    """n fixes by stamps on our clock, but for the unknown part of the offset."""

    stamp_ns: Stamps  # (n,)
    position_m: Floats  # (n, 3) their frame
    sd_m: Floats  # (n,) of x and y


class Priors(NamedTuple):
    """What is known of clock and drift beforehand."""

    clock_sd_s: float
    drift_sd_radps: float


class Fit(NamedTuple):
    """The best five unknowns, about a place of ours."""

    x: Floats  # (5,)
    covariance: Floats  # (5, 5)
    about_m: Floats  # (2,)


def aligned(fixes: Fixes, track: FreeTrack, priors: Priors, coarse_ns: int) -> ExternalFrame | None:
    """Return their frame from ours, as our track lies at the last fix; None where the fixes do not agree on one.

    `coarse_ns` is what their clock has been set back by already.
    """
    ours_m, known = track.at(fixes.stamp_ns)
    usable = Fixes(fixes.stamp_ns[known], fixes.position_m[known], fixes.sd_m[known])
    guess = guessed(ours_m[known, :2], usable.position_m[:, :2])
    if guess is None:
        return None
    fit = fitted(usable, track, priors, guess)
    if fit is None:
        return None
    ours_m, known = track.at(usable.stamp_ns - round(fit.x[CLOCK] * NANOSECONDS))
    shift_m = np.append(fit.x[X : Y + 1] - about_up(fit.x[YAW])[:2, :2] @ fit.about_m, 0.0)
    shift_m[2] = np.median((usable.position_m - ours_m)[known, 2])
    order = [X, Y, YAW, CLOCK]
    clock_ns = coarse_ns + round(fit.x[CLOCK] * NANOSECONDS)
    return ExternalFrame(float(fit.x[YAW]), shift_m, clock_ns, fit.covariance[np.ix_(order, order)], fit.about_m)


def good(frame: ExternalFrame, fixes: Fixes, track: FreeTrack, params: ExternalParams) -> bool:
    """Tell whether a frame is known well enough where the last of n fixes was, and its yaw, but for the clock."""
    last_m = track.at(fixes.stamp_ns[-1:])[0][0]
    known = given_clock(frame).pose_covariance(last_m)
    place_m2 = float(np.linalg.eigvalsh(known[:2, :2])[-1])
    limits = max(params.aligned_sd_m, params.point_sd_m), params.aligned_sd_rad
    return bool((np.sqrt([place_m2, known[2, 2]]) <= limits).all())


def guessed(ours_m: Floats, theirs_m: Floats) -> tuple[float, Floats] | None:
    """Return the yaw and shift (2,), through two fixes, with which most of n agree, (n, 2) both; None: too few do."""
    n = len(ours_m)
    some = np.unique(np.linspace(0, max(n - 1, 0), min(n, GUESSES)).astype(int))
    i, j = (some[which] for which in np.triu_indices(len(some), 1))
    ours, theirs = ours_m[j] - ours_m[i], theirs_m[j] - theirs_m[i]
    length_m, their_length_m = np.linalg.norm(ours, axis=1), np.linalg.norm(theirs, axis=1)
    alike = (length_m >= BASE_M) & (np.abs(length_m - their_length_m) < AGREE_M)
    if not alike.any():
        return None
    yaws_rad = (np.arctan2(theirs[:, 1], theirs[:, 0]) - np.arctan2(ours[:, 1], ours[:, 0]))[alike]
    z, p = (c[..., 0] + 1j * c[..., 1] for c in (theirs_m, ours_m))  # a turn of the plane is a product
    turns = np.exp(1j * yaws_rad)
    shifts = 0.5 * (z[i] + z[j])[alike] - turns * 0.5 * (p[i] + p[j])[alike]
    agree = np.sum(np.abs(z - turns[:, None] * p - shifts[:, None]) < AGREE_M, axis=1)
    best = int(agree.argmax())
    if agree[best] < max(FEWEST, SHARE * n):
        return None
    return float(yaws_rad[best]), np.array([shifts[best].real, shifts[best].imag])


def fitted(fixes: Fixes, track: FreeTrack, priors: Priors, guess: tuple[float, Floats]) -> Fit | None:
    """Return the best unknowns, from a guess of yaw and shift; None where too few fixes agree with them."""
    about_m = track.at(fixes.stamp_ns)[0][:, :2].mean(axis=0)
    x: Floats = np.zeros(SIZE)
    x[YAW], x[X : Y + 1] = guess[0], about_up(guess[0])[:2, :2] @ about_m + guess[1]
    information = np.zeros(SIZE)
    information[[CLOCK, DRIFT]] = priors.clock_sd_s**-2.0, max(priors.drift_sd_radps, 1e-9) ** -2.0
    for _ in range(ITERATIONS):
        residual_m, J, known = linearised(fixes, track, x, about_m)
        d = np.linalg.norm(residual_m, axis=1) / fixes.sd_m
        weight = np.where(known & (d < limit(d, known)), np.minimum(1.0, HUBER / np.maximum(d, 1e-9)), 0.0)
        weight /= fixes.sd_m**2
        N = np.einsum("nia,n,nib->ab", J, weight, J) + np.diag(information)
        change = np.linalg.solve(N, np.einsum("nia,n,ni->a", J, weight, residual_m) - information * x)
        x = x + change
        if (np.abs(change) < CLOSE).all():
            break
    believed = weight > 0.0
    if believed.sum() < FEWEST or believed.sum() < SHARE * len(d):
        return None
    scatter = float(np.sum(weight * np.sum(residual_m**2, axis=1)) / max(2 * int(believed.sum()) - SIZE, 1))
    return Fit(x, np.linalg.inv(N) * max(scatter, 1.0), about_m)


def limit(d: Floats, known: Flags) -> float:
    """Return the normalised residual beyond which a fix does not count: wider while the fit is still poor."""
    return LOST * max(1.0, float(np.median(d[known]))) if known.any() else LOST


def linearised(fixes: Fixes, track: FreeTrack, x: Floats, about_m: Floats) -> tuple[Floats, Floats, Flags]:
    """Return residuals (n, 2), what the unknowns move, (n, 2, 5), and which of the fixes can be used."""
    at_ns, since_ns = fixes.stamp_ns - round(x[CLOCK] * NANOSECONDS), int(fixes.stamp_ns[-1])
    ours_m, lever, known = drifting(track, at_ns, x[DRIFT], since_ns)
    (before_m, _, _), (after_m, _, after_known) = (
        drifting(track, at_ns + s * SPEED_NS, x[DRIFT], since_ns) for s in (-1, 1)
    )
    velocity_mps = (after_m - before_m) * (0.5 * NANOSECONDS / SPEED_NS)
    known = known & after_known
    R = about_up(x[YAW])[:2, :2]
    turned_m = (ours_m - about_m) @ R.T
    J = np.zeros((len(at_ns), 2, SIZE))
    J[:, 0, YAW], J[:, 1, YAW] = -turned_m[:, 1], turned_m[:, 0]
    J[:, 0, X] = J[:, 1, Y] = 1.0
    J[:, :, CLOCK], J[:, :, DRIFT] = -velocity_mps @ R.T, -lever @ R.T
    return fixes.position_m[:, :2] - turned_m - x[X : Y + 1], J, known


def drifting(track: FreeTrack, at_ns: Stamps, drift_radps: float, since_ns: int) -> tuple[Floats, Floats, Flags]:
    """Return our places at stamps without a drift, (n, 2), what it moves, (n, 2), and which of them are known."""
    ours_m, known = track.at(at_ns)
    lever = track.turning_lever(at_ns, since_ns)
    return ours_m[:, :2] - drift_radps * lever, lever, known

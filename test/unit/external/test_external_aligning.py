"""Their frame and clock from fixes: exact without noise, honest with it, and undecided where nothing decides."""

import numpy as np
import pytest
from external_cases import BEGIN_NS, SPEED_MPS, seen_fixes, track_of, way
from scipy.stats import chi2

from pdr_core.external.aligning import CLOCK, DRIFT, SIZE, YAW, Priors, X, Y, aligned, good, linearised
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import ExternalParams
from pdr_core.records_external import about_up

TIGHT, USUAL = Priors(10.0, 1.0), Priors(0.5, 1e-3)
SHIFT_M = np.array([40.0, -7.0, 2.0])


@pytest.mark.parametrize("yaw_rad", [-3.1, -1.0, 0.0, 2.0])
@pytest.mark.parametrize("clock_s", [-1.7, 0.0, 0.4, 1.9])
def test_without_noise_the_frame_and_the_clock_come_out_exactly(yaw_rad, clock_s):
    t, places_m = way(60.0, [20.0, 40.0])
    fixes = seen_fixes(t, places_m, yaw_rad, SHIFT_M, clock_s)
    found = aligned(fixes, track_of(t, places_m), TIGHT, 0)
    assert wrapped_rad(found.yaw_rad - yaw_rad) == pytest.approx(0.0, abs=1e-4)
    np.testing.assert_allclose(found.shift_m, SHIFT_M, atol=5e-3)
    assert found.clock_ns * 1e-9 == pytest.approx(clock_s, abs=2e-3)


def test_a_track_that_turns_too_far_does_not_spoil_the_frame():
    """The gyro's drift is an unknown of its own: the frame is that of the track as it lies at the last fix."""
    t, true_m = way(100.0, [20.0, 40.0, 60.0, 80.0])
    drift = 8e-4
    turned = np.exp(1j * drift * t[:-1]) * np.diff(true_m[:, 0] + 1j * true_m[:, 1])
    path = np.concatenate([[0.0], np.cumsum(turned)])
    track = track_of(t, np.column_stack([path.real, path.imag, np.zeros(len(t))]))
    fixes = seen_fixes(t, true_m, 0.7, SHIFT_M, 0.4)
    last_s = (fixes.stamp_ns[-1] - BEGIN_NS) * 1e-9 - 0.4
    found = aligned(fixes, track, Priors(0.5, 1e-2), 0)
    assert found.yaw_rad == pytest.approx(0.7 - drift * last_s, abs=2e-3)
    ours_m = track.at(fixes.stamp_ns[-1:] - found.clock_ns)[0]
    np.testing.assert_allclose(found.theirs_m(ours_m), fixes.position_m[-1:], atol=0.05)
    rigid = aligned(fixes, track, Priors(0.5, 1e-9), 0)
    assert abs(rigid.yaw_rad - 0.7 + drift * last_s) > 0.02


def test_the_derivatives_are_those_of_the_residuals():
    t, places_m = way(40.0, [15.0])
    track, about_m = track_of(t, places_m), np.array([10.0, 3.0])
    fixes = seen_fixes(t, places_m, 0.9, SHIFT_M, 0.2)
    x = np.array([1.0, 5.0, -3.0, 0.3, 2e-3])
    _, J, known = linearised(fixes, track, x, about_m)
    away = np.abs((fixes.stamp_ns - fixes.stamp_ns[0]) * 1e-9 + 2.0 - 15.0) > 2.0  # where the speed is even
    for axis, h in ((YAW, 1e-6), (X, 1e-4), (Y, 1e-4), (CLOCK, 1e-2), (DRIFT, 1e-6)):
        e = h * np.eye(SIZE)[axis]
        low, high = (linearised(fixes, track, x + s * e, about_m)[0] for s in (-1.0, 1.0))
        slope, at = -(high - low) / (2 * h), known & away
        np.testing.assert_allclose(slope[at], J[at, :, axis], rtol=2e-3, atol=2e-3)


def test_on_a_straight_line_the_clock_and_the_shift_along_it_cannot_be_told_apart():
    t, places_m = way(60.0)
    fixes = seen_fixes(t, places_m, 0.0, SHIFT_M, 0.4, seed=1)
    frame = aligned(fixes, track_of(t, places_m), USUAL, 0)
    along, across, _, clock = np.sqrt(np.diag(frame.covariance))
    assert clock == pytest.approx(USUAL.clock_sd_s, rel=0.05)  # no better than before
    assert along == pytest.approx(SPEED_MPS * USUAL.clock_sd_s, rel=0.1)
    assert across < 0.5 * along
    assert frame.covariance[0, 3] == pytest.approx(along * clock, rel=0.05)  # one and the same error
    assert good(frame, fixes, track_of(t, places_m), ExternalParams())  # which matters nowhere on that line
    t, places_m = way(60.0, [20.0, 40.0])
    fixes = seen_fixes(t, places_m, 0.0, SHIFT_M, 0.4, seed=1)
    turned = aligned(fixes, track_of(t, places_m), USUAL, 0)
    assert np.sqrt(turned.covariance[3, 3]) < 0.1
    assert good(turned, fixes, track_of(t, places_m), ExternalParams())


def test_the_covariance_is_honest_over_seeds():
    """NEES of x, y, yaw and clock, between both 95 % bounds over 80 seeds."""
    t, places_m = way(60.0, [20.0, 40.0])
    track, squares = track_of(t, places_m), []
    for seed in range(80):
        frame = aligned(seen_fixes(t, places_m, 2.0, SHIFT_M, 0.0, seed=seed), track, Priors(0.5, 1e-9), 0)
        true_m = about_up(2.0)[:2, :2] @ frame.about_m + SHIFT_M[:2]
        said_m = about_up(frame.yaw_rad)[:2, :2] @ frame.about_m + frame.shift_m[:2]
        error = np.append(said_m - true_m, [wrapped_rad(frame.yaw_rad - 2.0), frame.clock_ns * 1e-9])
        squares.append(error @ np.linalg.solve(frame.covariance, error))
    low, high = chi2.ppf([0.025, 0.975], 4 * 80) / 80
    assert low < np.mean(squares) < high


def test_outliers_have_no_say():
    t, places_m = way(60.0, [20.0, 40.0])
    fixes = seen_fixes(t, places_m, 2.0, SHIFT_M, 0.4, seed=3)
    clean = aligned(fixes, track_of(t, places_m), USUAL, 0)
    wrong_m = fixes.position_m.copy()
    wrong_m[::5] += [100.0, -40.0, 0.0]
    dirty = aligned(fixes._replace(position_m=wrong_m), track_of(t, places_m), USUAL, 0)
    assert dirty.yaw_rad == pytest.approx(clean.yaw_rad, abs=0.01)
    np.testing.assert_allclose(dirty.shift_m[:2], clean.shift_m[:2], atol=0.2)


def test_fixes_that_agree_on_nothing_give_no_frame():
    t, places_m = way(60.0, [20.0])
    fixes = seen_fixes(t, places_m, 2.0, SHIFT_M, 0.0)
    rng = np.random.default_rng(1)
    anywhere = fixes._replace(position_m=50.0 * rng.standard_normal((56, 3)))
    assert aligned(anywhere, track_of(t, places_m), USUAL, 0) is None
    still = np.zeros_like(places_m)
    assert aligned(seen_fixes(t, still, 0.0, SHIFT_M, 0.0, seed=1), track_of(t, still), USUAL, 0) is None

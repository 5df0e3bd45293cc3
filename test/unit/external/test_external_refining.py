"""What a straight line could not tell of a frame: told by the fixes after a turn, with an honest covariance."""

import numpy as np
import pytest
from external_cases import SPEED_MPS, seen_fixes, some, track_of, way
from scipy.stats import chi2

from pdr_core.conventions import NANOSECONDS
from pdr_core.external.aligning import Priors, aligned, good
from pdr_core.external.refining import Apart, by_frame_m2, given_clock, moves, refined, with_point
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import ExternalParams
from pdr_core.records_external import ExternalFrame, about_up

SHIFT_M, YAW_RAD = np.array([40.0, -7.0, 2.0]), 2.0
T, PLACES_M = way(60.0, [30.0])
STRAIGHT = 27  # fixes before the turn
PRIORS = Priors(0.5, 1e-9)


def apart_of(frame, fixes, i, track):
    """A fix beside the place of a track that is known exactly."""
    ours_m, velocity_mps, known = track.moving(fixes.stamp_ns[i : i + 1] - frame.clock_ns)
    assert known[0]
    off_m = frame.ours_m(fixes.position_m[i]) - ours_m[0]
    return Apart(off_m, moves(frame, ours_m[0, :2], velocity_mps[0]), np.zeros((2, 2)), float(fixes.sd_m[i]))


def found(clock_s, seed, until):
    """The frame after the straight part, and as the fixes up to one have refined it."""
    track, fixes = track_of(T, PLACES_M), seen_fixes(T, PLACES_M, YAW_RAD, SHIFT_M, clock_s, seed=seed)
    frame = first = aligned(some(fixes, 0, STRAIGHT), track, PRIORS, 0)
    for i in range(STRAIGHT, until):
        frame = refined(frame, apart_of(frame, fixes, i, track))
    return first, frame, fixes, track


def test_what_moves_a_fix_is_the_derivative():
    covariance = np.diag([1.0, 1.0, 0.1, 0.5])
    frame = ExternalFrame(0.7, SHIFT_M, 10**8, covariance, np.array([4.0, -2.0]))
    track, at_ns = track_of(T, PLACES_M), seen_fixes(T, PLACES_M, 0.0, SHIFT_M, 0.0).stamp_ns[10:11]

    def expected_m(x, y, turn_rad, clock_s):
        about_m = np.append(frame.about_m, 0.0)
        yaw_rad = frame.yaw_rad + turn_rad
        shift_m = frame.theirs_m(about_m) + [x, y, 0.0] - about_up(yaw_rad) @ about_m  # noqa: RUF005
        ours_m = track.at(at_ns - frame.clock_ns - round(clock_s * NANOSECONDS))[0][0]
        return (about_up(yaw_rad) @ ours_m + shift_m)[:2]

    ours_m, velocity_mps, _ = track.moving(at_ns - frame.clock_ns)
    H = about_up(frame.yaw_rad)[:2, :2] @ moves(frame, ours_m[0, :2], velocity_mps[0])
    for axis, h in enumerate((1e-4, 1e-4, 1e-6, 1e-2)):
        e = h * np.eye(4)[axis]
        np.testing.assert_allclose((expected_m(*e) - expected_m(*-e)) / (2 * h), H[:, axis], atol=1e-4)


def test_a_straight_line_leaves_the_clock_open_and_the_turn_tells_it():
    first, after, fixes, track = found(0.6, 3, STRAIGHT + 10)
    assert first.clock_sd_s > 0.45
    assert good(first, some(fixes, 0, STRAIGHT), track, ExternalParams())
    assert np.sqrt(given_clock(first).covariance[3, 3]) == pytest.approx(0.0, abs=1e-6)
    on_line = np.sqrt(np.linalg.eigvalsh(by_frame_m2(first, apart_of(first, fixes, STRAIGHT - 2, track)))[-1])
    beyond = np.sqrt(np.linalg.eigvalsh(by_frame_m2(first, apart_of(first, fixes, STRAIGHT + 6, track)))[-1])
    assert on_line < 0.25
    assert beyond == pytest.approx(np.sqrt(2.0) * SPEED_MPS * first.clock_sd_s, rel=0.1)
    assert after.clock_sd_s < 0.1
    assert after.clock_ns / NANOSECONDS == pytest.approx(0.6, abs=0.25)


def test_where_their_point_lies_is_in_every_fix_and_stays_in_the_covariance():
    frame = found(0.0, 1, STRAIGHT)[1]
    added = with_point(frame, 0.1).place_covariance_m2(np.array([90.0, 4.0])) - frame.place_covariance_m2([90.0, 4.0])
    np.testing.assert_allclose(added, 0.005 * np.eye(2), atol=1e-12)


@pytest.mark.parametrize("until", [STRAIGHT + 2, STRAIGHT + 20])
def test_the_covariance_is_honest_before_the_turn_and_after_it(until):
    """NEES of x, y, yaw and clock over 150 clocks and noises, between both 99.9 % bounds."""
    rng, squares = np.random.default_rng(7), []
    for seed in range(150):
        clock_s = float(np.clip(PRIORS.clock_sd_s * rng.standard_normal(), -1.5, 1.5))
        frame = found(clock_s, seed, until)[1]
        about_m = np.append(frame.about_m, 0.0)
        off_m = frame.theirs_m(about_m) - about_up(YAW_RAD) @ about_m - SHIFT_M
        error = np.array([*off_m[:2], wrapped_rad(frame.yaw_rad - YAW_RAD), frame.clock_ns / NANOSECONDS - clock_s])
        squares.append(error @ np.linalg.solve(frame.covariance, error))
    low, high = chi2.ppf([0.0005, 0.9995], 4 * 150) / 150
    print(np.mean(squares), low, high)
    assert low < np.mean(squares) < high

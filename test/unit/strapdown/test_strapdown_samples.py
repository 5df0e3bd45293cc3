"""What each kind of sample says of its interval, on a swing between two rests whose axis and force both turn."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.strapdown.mechanisation import advance
from pdr_core.strapdown.samples import AVERAGES, KINDS, MEANS, POINTS, between

FINE = 40_000
TIME_S = np.linspace(0.0, 1.0, FINE + 1)
BUMP = np.sin(np.pi * TIME_S)[:, None] ** 4  # all that moves begins and ends in rest
RATE = BUMP * np.stack([7.0 + 0.0 * TIME_S, 6.0 * np.sin(5.0 * TIME_S), 5.0 * np.cos(7.0 * TIME_S)], axis=1)
FORCE = BUMP * np.stack([20.0 * np.cos(4.0 * TIME_S), 15.0 * np.sin(9.0 * TIME_S), 10.0 + 0.0 * TIME_S], axis=1)


def moved(kind, rate, force):
    """Return the speed and the attitude after a second from samples (n + 1, 3) of a kind."""
    position, velocity, quat, dt = np.zeros(3), np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), 1.0 / (len(rate) - 1)
    rate, force = ([tuple(row) for row in x.tolist()] for x in (rate, force))
    for i in range(1, len(rate)):
        turn, before, after = between(kind, rate[i - 1], rate[i], force[i - 1], force[i], dt)
        advance(position, velocity, quat, turn, before, after, dt, 0.0)
    return velocity, Rotation.from_quat(quat)


TRUE_SPEED, TRUE_ATTITUDE = moved(POINTS, RATE, FORCE)


def points(n):
    return RATE[:: FINE // n], FORCE[:: FINE // n]


def averages(n):
    """What a sensor gives that averages: each sample the mean since the one before."""
    pieces = ((0.5 * (x[:-1] + x[1:])).reshape(n, FINE // n, 3).mean(axis=1) for x in (RATE, FORCE))
    return tuple(np.vstack([np.zeros(3), mean]) for mean in pieces)


def errors(kind, samples):
    speed, attitude = moved(kind, *samples)
    return np.linalg.norm(speed - TRUE_SPEED), (attitude.inv() * TRUE_ATTITUDE).magnitude()


def test_averages_need_the_coning_and_the_sculling():
    plain_mps, plain_rad = errors(MEANS, averages(100))
    speed_mps, turn_rad = errors(AVERAGES, averages(100))
    assert plain_rad > 1e-4
    assert turn_rad < 0.05 * plain_rad
    assert plain_mps > 1e-3
    assert speed_mps < 0.1 * plain_mps
    finer = errors(AVERAGES, averages(200))
    np.testing.assert_allclose(np.array([speed_mps, turn_rad]) / finer, 8.0, rtol=0.05)  # third order


def test_without_the_sculling_the_speed_is_off():
    rate, force = averages(100)
    rows, none = [tuple(row) for row in rate.tolist()], (0.0, 0.0, 0.0)
    coned = [between(AVERAGES, rows[i - 1], rows[i], none, none, 0.01)[0] for i in range(1, 101)]
    speed_mps, turn_rad = errors(MEANS, (np.vstack([np.zeros(3), coned]), force))
    with_it_mps, with_it_rad = errors(AVERAGES, (rate, force))
    assert turn_rad == pytest.approx(with_it_rad, abs=1e-12)
    assert speed_mps > 10.0 * with_it_mps


def test_points_are_followed_with_an_error_of_fourth_order():
    found = np.array([errors(POINTS, points(n)) for n in (50, 100)])
    np.testing.assert_allclose(found[0] / found[1], 16.0, rtol=0.05)
    assert found[1].max() < 3e-6


def test_straight_lines_between_points_are_a_worse_guess():
    at = np.arange(0.0, 100.01, 0.05)
    lines = tuple(np.stack([np.interp(at, np.arange(101), x[:, k]) for k in range(3)], axis=1) for x in points(100))
    assert min(np.array(errors(POINTS, lines)) / errors(POINTS, points(100))) > 100.0


def test_what_a_sensor_has_integrated_is_taken_as_it_is():
    last, now, force = (1.0, -2.0, 3.0), (4.0, 5.0, -6.0), (7.0, 8.0, 9.0)
    assert between(MEANS, last, now, last, force, 0.01) == (now, force, force)
    assert between(AVERAGES, now, now, force, force, 0.0) == (now, force, force)


def test_a_rate_that_does_not_change_needs_no_correction():
    now, last_force, force = (4.0, 5.0, -6.0), (1.0, 2.0, 3.0), (7.0, 8.0, 9.0)
    assert between(POINTS, now, now, last_force, force, 0.01) == (now, last_force, force)


def test_the_kinds_are_three():
    assert sorted(KINDS.values()) == [0, 1, 2]

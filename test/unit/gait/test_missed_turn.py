"""What a foot turns while its gyro sleeps is learnt from the strides in which it does not."""

import numpy as np
import pytest

from pdr_core.gait.missed_turn import LEAST, MissedTurn, Pivot

HABIT, SLOPES, SD_RAD = np.array([0.05, -0.2, 0.03]), np.array([0.06, 0.3]), 0.02


def learnt(n, stumbles=0, seed=2):
    rng = np.random.default_rng(seed)
    missed = MissedTurn()
    for i in range(n + stumbles):
        signs = np.array([rng.normal([0.0, 6.0, 1.0], [0.5, 1.5, 0.5]), rng.normal(0.0, 0.2, 3)])
        turn = HABIT + SLOPES @ signs + rng.normal(0.0, SD_RAD, 3) + (np.array([0.0, 1.0, 2.0]) if i >= n else 0.0)
        missed.learn(signs, turn, 0.07 * turn)
    return missed


def test_it_tells_a_turn_by_its_signs_and_how_well():
    signs = np.array([[0.2, 7.0, 0.5], [0.1, 0.3, -0.1]])
    told = learnt(400).told(signs)
    assert told.turn_rad == pytest.approx(HABIT + SLOPES @ signs, abs=0.01)
    assert told.sd_rad == pytest.approx(SD_RAD, rel=0.15)
    assert told.mean_time_s == pytest.approx(0.07)


def test_the_noise_of_few_turns_is_not_taken_for_less_than_it_is():
    """A plane through n turns takes as many of their 3 n freedoms as it has numbers: what is left over is scaled up."""
    variances = [learnt(10, seed=seed).told(np.zeros((2, 3))).sd_rad ** 2 for seed in range(300)]
    assert np.mean(variances) == pytest.approx(SD_RAD**2, rel=0.06)


def test_a_stumble_moves_the_noise_and_not_the_habit():
    signs = np.array([[0.0, 6.0, 1.0], [0.0, 0.0, 0.0]])
    steady, stumbled = learnt(40).told(signs), learnt(40, 3).told(signs)
    assert stumbled.turn_rad == pytest.approx(steady.turn_rad, abs=0.01)
    assert stumbled.sd_rad > 5.0 * steady.sd_rad


def test_too_few_turns_tell_nothing():
    few = learnt(LEAST - 1)
    assert not few.ready
    with pytest.raises(ValueError, match="too few"):
        few.told(np.zeros((2, 3)))


def test_signs_that_are_all_alike_tell_their_habit():
    missed = MissedTurn()
    for _ in range(LEAST):
        missed.learn(np.ones((1, 3)), HABIT, 0.1 * HABIT)
    assert missed.told(np.ones((1, 3))).turn_rad == pytest.approx(HABIT)


def test_the_pivot_is_the_mean_of_most():
    pivot = Pivot(np.array([-0.05, -0.06, -0.04, -0.05, 1.5]))
    assert pivot.mean_rad == pytest.approx(-0.05, abs=0.006)
    assert 0.0 < pivot.sd_rad < 0.02

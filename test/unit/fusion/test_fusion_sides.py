"""Which foot is the left one: the outer foot of a turn goes farther."""

import numpy as np
import pytest
from fusion_cases import in_turn, step

from pdr_core.fusion.sides import Sides

WIDTH_M = 0.25
RNG = np.random.default_rng(4)


def judged(turns_rad, names=("left", "right"), noise_m=0.03, speeding_m=0.0):
    """Walk these turns of a stride, (n,), with feet WIDTH_M apart; return the verdict."""
    headings = np.cumsum(turns_rad)
    outer_m = 0.5 * WIDTH_M * np.asarray(turns_rad)
    length_m = 1.3 + speeding_m * np.arange(len(turns_rad)) + noise_m * RNG.standard_normal((2, len(turns_rad)))
    lefts = [step(i + 1, headings[i], length_m[0, i] - outer_m[i]) for i in range(len(headings))]
    rights = [
        step(i + 1, headings[i], length_m[1, i] + speeding_m / 2 + outer_m[i], late_s=0.55)
        for i in range(len(headings))
    ]
    sides = Sides(names)
    for foot, event in in_turn(lefts, rights):
        sides.take(foot, event)
    return sides


CORNERS = ([0.0] * 6 + [0.5] * 3) * 4
BOTH_WAYS = ([0.0] * 6 + [0.5] * 3 + [0.0] * 6 + [-0.5] * 3) * 3


@pytest.mark.parametrize("turns", [CORNERS, BOTH_WAYS, [0.2] * 60])
def test_swapped_feet_are_told_from_others(turns):
    assert not judged(turns).swapped
    assert judged(turns, names=("right", "left")).swapped
    assert judged(turns).width_m == pytest.approx(WIDTH_M, abs=0.08)


def test_a_straight_walk_tells_nothing():
    for _ in range(20):
        turns = 0.05 * RNG.standard_normal(60)
        assert not judged(turns).swapped
        assert not judged(turns, names=("right", "left")).swapped


def test_a_person_who_speeds_up_evenly_in_a_turn_tells_nothing_false():
    assert judged([0.1] * 60, noise_m=0.0, speeding_m=0.01).width_m == pytest.approx(WIDTH_M, abs=1e-3)


def test_noisy_strides_are_rarely_called_swapped():
    assert sum(judged(CORNERS, noise_m=0.4).swapped for _ in range(100)) == 0

"""Headings of strides and the straight test (paper 004, eq. 5-7)."""

import numpy as np
import pytest
from fusion_cases import step

from pdr_core.fusion.stride_headings import Straight, StrideHeadings, walking_direction_rad

FIVE_DEG = np.radians(5.0)


def headings(angles_rad, lengths_m=None):
    found = StrideHeadings(Straight(np.radians(4.0), np.radians(6.0)), shortest_m=0.4)
    for i, angle_rad in enumerate(angles_rad):
        found.add(step(i + 1, angle_rad, lengths_m[i] if lengths_m else 1.4), taken_rad=0.0)
    return found


def test_six_strides_in_one_direction_are_straight_even_across_half_a_turn():
    wobble = np.radians([2, -2, 1, -1, 2, -2])
    assert headings(wobble).straight
    assert headings(np.pi + wobble).straight
    assert abs(headings(np.pi + wobble).mean_rad()) == pytest.approx(np.pi, abs=1e-9)


@pytest.mark.parametrize(
    "angles_deg",
    [
        [0, 0, 0, 0, 0],  # five are not enough: the current one and five before it
        [0, 0, 0, 0, 0, 9],  # the latest one turns
        [0, 4, 8, 12, 16, 20],  # a curve
        [6, -6, 6, -6, 6, -6],  # a patterned walk
    ],
)
def test_what_is_not_straight(angles_deg):
    assert not headings(np.radians(angles_deg)).straight


def test_a_short_stride_and_a_lost_one_end_the_line():
    assert not headings([0.0] * 6, [1.4] * 5 + [0.3]).straight
    found = headings([0.0] * 6)
    found.add(step(8, 0.0), taken_rad=0.0)
    assert not found.straight


def test_a_track_that_was_turned_back_is_still_straight():
    found = headings([FIVE_DEG] * 5)
    found.add(step(6, 0.0), taken_rad=FIVE_DEG)
    assert found.straight
    assert found.variance_rad2 == pytest.approx(0.0, abs=1e-12)


def test_the_walking_direction_is_the_mean_of_both_feet():
    assert walking_direction_rad([np.radians(170), np.radians(-170)]) == pytest.approx(np.pi)
    assert walking_direction_rad([0.1, 0.3]) == pytest.approx(0.2)

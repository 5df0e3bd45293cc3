"""The straight-walk test and the spread of headings."""

import numpy as np
import pytest

from pdr_core.heading.spread import Spread
from pdr_core.heading.straight import LastStrides
from pdr_core.params import HeadingParams


def last(degrees, strides: int = 3, limit_deg: float = 5.0) -> LastStrides:
    found = LastStrides(strides, np.radians(limit_deg))
    for heading_deg in degrees:
        found.add(np.radians(heading_deg))
    return found


@pytest.mark.parametrize("turn_deg", [0.0, 90.0, 179.0, 180.0, 270.0])
def test_straight_is_straight_in_every_direction(turn_deg: float) -> None:
    assert last(np.array([0.0, 4.0, -4.0]) + turn_deg).straight
    assert not last(np.array([0.0, 8.0, -4.0]) + turn_deg).straight


def test_fewer_strides_than_asked_for_are_not_straight() -> None:
    assert not last([10.0, 10.0]).straight
    assert last([10.0, 10.0, 10.0]).straight


def test_only_the_last_strides_count() -> None:
    assert last([90.0, 1.0, 0.0, -1.0]).straight


@pytest.mark.parametrize("bend_deg", [8.0, 10.0, 12.0])
def test_a_bend_is_seen_by_default_while_it_lies_among_the_strides(bend_deg: float) -> None:
    p = HeadingParams()
    bent = LastStrides(p.straight_strides, p.straight_max_rad)
    straight = []
    for heading_deg in [0.0] * 6 + [bend_deg] * 6:
        bent.add(np.radians(heading_deg))
        straight.append(bent.straight)
    assert straight[5]
    assert straight[-1]
    assert not all(straight[6:9])


def test_they_turn_with_the_track() -> None:
    found = last([179.0, 180.0, 181.0])
    found.turn(np.radians(10.0))
    assert found.mean_rad == pytest.approx(np.radians(-170.0))
    assert found.straight


def test_the_spread_begins_with_a_guess_and_becomes_that_of_the_strides() -> None:
    rng = np.random.default_rng(3)
    spread = Spread(np.radians(2.0))
    assert np.degrees(np.sqrt(spread.variance_rad2)) == pytest.approx(2.0)
    headings = LastStrides(4, 1.0)
    for heading_rad in np.radians(5.0) * rng.standard_normal(4000):
        headings.add(heading_rad)
        if len(headings.headings_rad) == 4:
            spread.add(headings.deviations_rad[-1], 4)
    assert np.degrees(np.sqrt(spread.variance_rad2)) == pytest.approx(5.0, rel=0.05)

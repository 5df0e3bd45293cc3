"""What is taken for the direction of a step: its displacement, or the foot that stands after it."""

import numpy as np
import pytest

from pdr_core.heading import HeadingConstraint
from pdr_core.params import HeadingParams
from pdr_core.records import HeadingSource, StepEvent


def step(number, heading_rad, yaw_rad):
    """Return a step of a filter whose yaw becomes less sure."""
    displacement_m = 1.2 * np.array([np.cos(heading_rad), np.sin(heading_rad), 0.0])
    ns = number * 1_500_000_000
    sd_rad = 0.01 * number
    return StepEvent(number, ns - 1_500_000_000, ns, np.zeros(3), displacement_m, 1e-4 * np.eye(3), yaw_rad, sd_rad, ns)


def answers(direction, headings_rad, yaws_rad):
    """Return what the dominant direction says of steps."""
    constraint = HeadingConstraint(HeadingParams(constraint="dominant", walking_direction=direction))
    steps = [step(i, h, y) for i, (h, y) in enumerate(zip(headings_rad, yaws_rad, strict=True), 1)]
    return [constraint.answer(s) for s in steps]


def test_the_foot_may_point_elsewhere_and_shows_the_drift_that_displacements_hide():
    drift = np.radians([0.0, 0.0, 0.0, 0.0, 2.0])
    noise = np.radians([40.0, -30.0, 25.0, -35.0, 30.0])  # displacements go anywhere
    foot = answers("foot", noise, 0.3 + drift)
    assert [a.source for a in foot] == [HeadingSource.NONE] * 4 + [HeadingSource.STRAIGHT_WALK]
    assert foot[4].yaw_error_rad > np.radians(2.0)
    assert all(a.source is HeadingSource.NONE for a in answers("stride", noise, 0.3 + drift))
    stride = answers("stride", drift, noise)
    assert stride[4].yaw_error_rad == pytest.approx(foot[4].yaw_error_rad, abs=1e-9)


def test_a_foot_whose_yaw_is_no_number_says_nothing():
    broken = answers("foot", np.zeros(7), [0.0, 0.0, 0.0, 0.0, 0.0, np.nan, 0.0])
    assert all(np.isfinite(a.yaw_error_rad) for a in broken)
    assert [a.source for a in broken[4:]] == [HeadingSource.STRAIGHT_WALK, HeadingSource.NONE, HeadingSource.NONE]

"""Angles that begin anew after a period."""

import numpy as np
import pytest

from pdr_core.maths.circular import circular_mean_rad, wrapped_rad


@pytest.mark.parametrize("period_rad", [2.0 * np.pi, np.pi, np.pi / 2.0])
def test_an_angle_is_the_same_but_for_whole_periods(period_rad: float) -> None:
    for angle_rad in np.linspace(-20.0, 20.0, 401):
        wrapped = wrapped_rad(angle_rad, period_rad)
        assert -period_rad / 2.0 <= wrapped < period_rad / 2.0
        assert (angle_rad - wrapped) / period_rad == pytest.approx(round((angle_rad - wrapped) / period_rad), abs=1e-9)


def test_the_mean_of_directions_on_both_sides_of_180_degrees_lies_between_them() -> None:
    assert abs(circular_mean_rad(np.radians([178.0, -176.0]))) == pytest.approx(np.radians(179.0))
    assert circular_mean_rad(np.radians([10.0, 20.0, 30.0])) == pytest.approx(np.radians(20.0))


def test_no_angle_has_no_mean() -> None:
    with pytest.raises(ValueError, match="no mean"):
        circular_mean_rad([])

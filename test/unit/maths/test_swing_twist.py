"""A turn is taken apart into its twist about an axis and the shortest turn of the axis."""

import numpy as np
import pytest

from pdr_core.maths.quaternion import from_rotation_vector, matrix, multiply, turn_about_up_rad
from pdr_core.maths.swing_twist import shortest_turn, twist_rad

UP = np.array([0.0, 0.0, 1.0])
LEVEL = np.array([0.0, 0.0, 0.0, 1.0])


def unit(vector):
    return np.asarray(vector) / np.linalg.norm(vector)


@pytest.mark.parametrize("after", [[1.0, 2.0, 3.0], [0.0, 1.0, -0.9], [0.0, 0.0, 1.0]])
def test_the_shortest_turn_moves_the_axis_and_has_no_twist(after):
    turn = shortest_turn(UP, unit(after))
    assert matrix(np.array(turn)) @ UP == pytest.approx(unit(after))
    assert twist_rad(turn, UP) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("angle", [-3.0, -0.4, 0.0, 0.9, 3.1])
def test_a_twist_before_or_after_a_shortest_turn_is_found_again(angle):
    up, after = unit([0.2, -0.5, 0.8]), unit([0.9, 0.3, 0.4])
    tilt, twist = shortest_turn(up, after), from_rotation_vector(angle * up)
    assert twist_rad(multiply(tilt, twist), up) == pytest.approx(angle)
    assert twist_rad(multiply(from_rotation_vector(angle * after), tilt), after) == pytest.approx(angle)


def test_about_the_vertical_it_is_the_turn_about_up():
    turn = from_rotation_vector((0.3, -0.8, 0.5))
    assert twist_rad(turn, UP) == pytest.approx(turn_about_up_rad(LEVEL, turn))


def test_opposite_axes_have_no_shortest_turn():
    assert shortest_turn(UP, -UP) == (0.0, 0.0, 0.0, 1.0)

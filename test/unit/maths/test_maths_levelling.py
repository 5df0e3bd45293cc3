import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pdr_core.maths import quaternion
from pdr_core.maths.levelling import levelled, off_vertical

G = 9.81


@given(st.integers(0, 2**32 - 1), st.floats(-3.1, 3.1))
def test_any_mounting_is_levelled(seed, yaw_rad):
    mounting = Rotation.random(random_state=seed)
    force = mounting.inv().apply([0.0, 0.0, G])
    attitude = Rotation.from_quat(levelled(force, yaw_rad))
    np.testing.assert_allclose(attitude.apply(force), [0.0, 0.0, G], atol=1e-12)
    assert abs((quaternion.yaw_rad(attitude.as_quat()) - yaw_rad + np.pi) % (2 * np.pi) - np.pi) < 1e-6
    about_vertical = (attitude * mounting.inv()).as_rotvec()  # only a turn about the vertical is left open
    np.testing.assert_allclose(about_vertical[:2], 0.0, atol=1e-6)


@pytest.mark.parametrize("up", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)])
@pytest.mark.parametrize("yaw_rad", [0.0, 1.0])
def test_every_side_up(up, yaw_rad):
    force = G * np.array(up, float)
    np.testing.assert_allclose(Rotation.from_quat(levelled(force, yaw_rad)).apply(force), [0, 0, G], atol=1e-12)


def test_the_one_sided_arctangent_of_gui_fails_upside_down():
    force = np.array([0.5, 0.0, -G])
    gui_roll = -np.arctan(force[0] / force[2])  # eq. 2, about his front axis; right-front-up
    still_down = Rotation.from_euler("y", gui_roll).apply(force)
    assert still_down[2] < 0.0
    assert Rotation.from_quat(levelled(force, 0.0)).apply(force)[2] > 0.0


def test_the_shortest_turn_lays_the_force_on_the_vertical():
    for seed in range(5):
        q = Rotation.random(random_state=seed).as_quat()
        force = np.random.default_rng(seed).standard_normal(3)
        about_x, about_y, angle = off_vertical(q, force)
        up = (Rotation.from_rotvec([about_x, about_y, 0.0]) * Rotation.from_quat(q)).apply(force)
        np.testing.assert_allclose(up, [0.0, 0.0, np.linalg.norm(force)], atol=1e-12)
        assert angle == pytest.approx(np.hypot(about_x, about_y))
    assert off_vertical(np.array([0.0, 0.0, 0.0, 1.0]), (0.0, 0.0, -9.8))[2] == pytest.approx(np.pi)

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pdr_core.maths import quaternion

SEEDS = st.integers(0, 2**32 - 1)
ANGLES = st.floats(-np.pi, np.pi)


def two_rotations(seed):
    return Rotation.random(2, random_state=seed)


def same_rotation(q, expected):
    return (Rotation.from_quat(q).inv() * expected).magnitude() < 1e-12


@given(SEEDS)
def test_products_turn_like_those_of_scipy(seed):
    p, q = two_rotations(seed)
    assert same_rotation(quaternion.multiply(p.as_quat(), q.as_quat()), p * q)


@given(SEEDS, st.floats(0.0, 12.0))
def test_the_exponential_map_is_that_of_scipy(seed, angle_rad):
    vector = angle_rad * Rotation.random(random_state=seed).apply([1.0, 0.0, 0.0])
    np.testing.assert_allclose(np.linalg.norm(quaternion.from_rotation_vector(vector)), 1.0, rtol=1e-14)
    assert same_rotation(quaternion.from_rotation_vector(vector), Rotation.from_rotvec(vector))


@given(st.floats(1e-12, 1e-6))
def test_a_tiny_turn_keeps_all_its_digits(angle_rad):
    np.testing.assert_allclose(
        quaternion.from_rotation_vector(np.array([angle_rad, 0, 0]))[0], angle_rad / 2, rtol=1e-12
    )


@given(SEEDS)
def test_the_matrix_is_that_of_scipy(seed):
    p, _ = two_rotations(seed)
    np.testing.assert_allclose(quaternion.matrix(p.as_quat()), p.as_matrix(), atol=1e-14)


@given(ANGLES, ANGLES, ANGLES)
def test_roll_pitch_yaw_are_about_fixed_axes(roll_rad, pitch_rad, yaw_rad):
    expected = Rotation.from_euler("xyz", [roll_rad, pitch_rad, yaw_rad])
    assert same_rotation(quaternion.from_euler(roll_rad, pitch_rad, yaw_rad), expected)


@given(SEEDS)
def test_the_yaw_is_the_direction_of_the_x_axis(seed):
    p, _ = two_rotations(seed)
    x, y, _ = p.apply([1.0, 0.0, 0.0])
    np.testing.assert_allclose(quaternion.yaw_rad(p.as_quat()), np.arctan2(y, x), atol=1e-9)


@given(SEEDS, st.floats(1e-3, 1e3))
def test_normalising_keeps_the_direction(seed, factor):
    q = Rotation.random(random_state=seed).as_quat()
    np.testing.assert_allclose(quaternion.normalised(factor * q), q, atol=1e-14)

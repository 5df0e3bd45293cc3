"""The mounting from strides: exact directions, outliers, doubt."""

import numpy as np
import pytest
from gait_cases import analysed, smooth_walk
from scipy.spatial.transform import Rotation

from pdr_core.gait.initial_orientation import aligned, continuous, euler_rad, rest_orientation, walking_frame
from pdr_core.gait.installation import BIAS_TILT_RAD, ENOUGH, FEWEST, Installation, WalkedStride, direction, mounting
from pdr_core.maths.quaternion import from_euler, matrix, yaw_rad

RNG = np.random.default_rng(3)


def walked(R_body_from_foot, sd_rad=0.0, turned_rad=0.0):
    """A stride of a foot that is mounted so, seen with errors; `turned_rad` is how far beside the body's x it goes."""
    noise = Rotation.from_rotvec(sd_rad * RNG.standard_normal((2, 3)))
    ahead = R_body_from_foot.T @ [np.cos(turned_rad), np.sin(turned_rad), 0.0]
    return WalkedStride(noise.apply(R_body_from_foot.T[:, 2]), noise.apply(ahead))


def installation(strides):
    found = Installation()
    found._strides.extend(strides)
    return found


def test_exact_strides_give_the_mounting_exactly():
    for seed in range(10):
        R = Rotation.random(random_state=seed).as_matrix()
        found = mounting([walked(R)] * 4)
        np.testing.assert_allclose(matrix(found.quat_xyzw), R, atol=1e-12)
        assert (found.yaw_sd_rad, found.strides) == (pytest.approx(0.0, abs=1e-7), 4)
        assert found.tilt_sd_rad == pytest.approx(BIAS_TILT_RAD)


def test_the_deviation_is_that_of_the_mean():
    R = Rotation.random(random_state=5).as_matrix()
    errors, said = [], []
    for _ in range(100):
        found = mounting([walked(R, sd_rad=0.05) for _ in range(12)])
        x_rad = np.arcsin((R @ matrix(found.quat_xyzw).T)[1, 0])
        errors.append(x_rad)
        said.append(found.yaw_sd_rad)
    assert np.std(errors) == pytest.approx(0.05 / np.sqrt(24.0), rel=0.3)
    assert 0.8 < np.mean(said) / np.std(errors) < 2.2  # both stances of a stride count as one


def test_a_few_strides_aside_do_not_count():
    R = Rotation.random(random_state=6).as_matrix()
    strides = [walked(R, 0.01) for _ in range(12)] + [walked(R, 0.01, turned_rad=1.0) for _ in range(2)]
    found = installation(strides).found()
    assert np.arccos(matrix(found.quat_xyzw)[0] @ R[0]) < 0.01


@pytest.mark.parametrize(("turned_rad", "others"), [(np.pi, 6), (np.pi / 2.0, 6), (np.pi, 3)])
def test_strides_that_do_not_agree_tell_nothing(turned_rad, others):
    """Half of them go backwards or sideways, or a third backwards."""
    R = Rotation.random(random_state=7).as_matrix()
    strides = [walked(R, 0.01) for _ in range(6)] + [walked(R, 0.01, turned_rad) for _ in range(others)]
    assert installation(strides).found() is None
    assert "do not agree" in installation(strides).doubt()


def test_few_strides_tell_it_only_at_the_end_of_a_recording():
    few = installation([walked(np.eye(3))] * (ENOUGH - 1))
    assert few.found() is None
    assert few.doubt() == f"{ENOUGH - 1} straight strides were found, and it takes {ENOUGH}"
    assert few.found(FEWEST) is not None
    assert installation([walked(np.eye(3))]).found(FEWEST) is None


def test_strides_that_are_too_uncertain_have_to_be_more():
    strides = [walked(np.eye(3), 0.13) for _ in range(ENOUGH)]
    assert installation(strides).found() is None
    assert installation([walked(np.eye(3), 0.13) for _ in range(40)]).found() is not None


def test_opposite_directions_have_no_middle():
    assert direction(np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])).spread_rad == np.pi


def test_a_backward_walk_is_not_told_from_a_forward_one():
    """What is known of it is said in the documentation: the body's x points to the heel."""
    sim, _ = smooth_walk(mounting_yaw_rad=np.pi)
    forward, backward = analysed(smooth_walk()[0].imu).mounting, analysed(sim.imu).mounting
    turn = Rotation.from_quat(forward.quat_xyzw).inv() * Rotation.from_quat(backward.quat_xyzw)
    assert turn.magnitude() == pytest.approx(np.pi, abs=0.02)


@pytest.mark.parametrize(
    "angles", [(0.3, -0.7, 2.0), (-3.0, 1.5, -3.1), (0.0, np.pi / 2.0, 0.7), (0.4, -np.pi / 2.0, 1.0)]
)
def test_the_angles_give_the_rotation_back(angles):
    R = matrix(from_euler(*angles))
    np.testing.assert_allclose(matrix(from_euler(*euler_rad(R))), R, atol=1e-9)


def test_a_resting_sensor_is_level_in_the_world():
    for seed in range(5):
        R_world_from_sensor = Rotation.random(random_state=seed).as_matrix()
        quat = rest_orientation(9.8 * R_world_from_sensor.T[:, 2])
        np.testing.assert_allclose(matrix(quat)[2], R_world_from_sensor[2], atol=1e-12)
        assert yaw_rad(quat) == pytest.approx(0.0, abs=1e-9)


def test_after_the_alignment_the_body_at_rest_looks_ahead():
    """Qiu table 2: (0, 0, 0, 1) here, which Qiu writes (1, 0, 0, 0)."""
    R_body_from_foot = Rotation.random(random_state=8)
    heading_rad = 2.4
    foot = Rotation.from_euler("z", heading_rad) * R_body_from_foot
    found = mounting([walked(R_body_from_foot.as_matrix())] * 3)
    before = walking_frame(np.tile(foot.as_quat(), (3, 1)), heading_rad)
    np.testing.assert_allclose(aligned(before, found), np.tile([0.0, 0.0, 0.0, 1.0], (3, 1)), atol=1e-9)
    assert np.abs(before[0] - [0.0, 0.0, 0.0, 1.0]).max() > 0.1


def test_orientations_do_not_jump_to_their_negative():
    quat = Rotation.from_euler("z", np.linspace(3.0, 10.0, 50)).as_quat()
    quat[20:30] *= -1.0
    out = continuous(quat)
    assert out[0, 3] >= 0.0
    assert np.abs(np.diff(out, axis=0)).max() < 0.2
    np.testing.assert_allclose(np.abs(np.einsum("ij,ij->i", out, quat)), 1.0)

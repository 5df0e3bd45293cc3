"""The heading by the field, whose truth is a field turned into the axes of a foot."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.attitude import field
from pdr_core.attitude.settings import settings
from pdr_core.attitude.sphere import tangents
from pdr_core.params import Params

STEP = 1e-6
NORTH = np.array([1.2e-5, 1.6e-5, -4.0e-5])
SETTINGS = settings(Params())


@pytest.mark.parametrize("seed", range(5))
def test_h_is_the_derivative_of_the_azimuth(seed):
    turn = Rotation.random(random_state=seed)
    measured = turn.inv().apply(NORTH)
    H = field.jacobian(turn.as_quat(), NORTH)
    for axis in np.eye(3):

        def azimuth(angle, axis=axis):
            world = (Rotation.from_rotvec(angle * axis) * turn).apply(measured)
            return np.arctan2(world[1], world[0])

        numeric = (azimuth(STEP) - azimuth(-STEP)) / (2 * STEP)
        assert H[0, :4] @ tangents(turn.as_quat()) @ axis / 2.0 == pytest.approx(numeric, abs=1e-7)
    assert np.all(H[0, 4:] == 0.0)


@pytest.mark.parametrize("yaw_error_rad", [-3.0, -0.4, 0.0, 1e-3, 2.0])
def test_the_residual_is_what_the_yaw_lacks(yaw_error_rad):
    world = Rotation.from_euler("z", -yaw_error_rad).apply(NORTH)
    assert field.residual(world, NORTH)[0] == pytest.approx(yaw_error_rad)


@pytest.mark.parametrize(
    ("change", "disturbed"),
    [
        (lambda m: Rotation.from_euler("z", 2.0).apply(m), False),
        (lambda m: 1.05 * m, False),
        (lambda m: 1.2 * m, True),
        (lambda m: 0.8 * m, True),
        (lambda m: Rotation.from_euler("x", 0.2).apply(m), True),  # as strong, but less steep
    ],
)
def test_strength_and_dip_tell_a_disturbed_field_and_its_direction_does_not(change, disturbed):
    assert field.disturbed(np.array(change(NORTH)), NORTH, SETTINGS) == disturbed


def test_the_gain_turns_about_the_vertical_alone():
    rng = np.random.default_rng(3)
    q, K = Rotation.random(random_state=3).as_quat(), rng.standard_normal((7, 1))
    angles = 2.0 * tangents(q).T @ K[:4, 0]
    alone = field.heading_alone(K.copy(), q)
    np.testing.assert_allclose(2.0 * tangents(q).T @ alone[:4, 0], [0.0, 0.0, angles[2]], atol=1e-14)
    bias = Rotation.from_quat(q).apply(alone[4:, 0])
    np.testing.assert_allclose(bias, [0.0, 0.0, Rotation.from_quat(q).apply(K[4:, 0])[2]], atol=1e-14)

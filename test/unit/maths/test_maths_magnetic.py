import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pdr_core.maths.magnetic import dip_rad, level_field, magnetic_yaw_rad, up_in_body

SEEDS = st.integers(0, 2**32 - 1)
YAWS = st.floats(-np.pi, np.pi)
TILTS = st.floats(-1.5, 1.5)
NORM_TESLA, DIP_RAD = 50e-6, np.deg2rad(60.0)
EARTH_FIELD = NORM_TESLA * np.array([0.0, np.cos(DIP_RAD), -np.sin(DIP_RAD)])  # ENU, declination zero


def angle(difference_rad):
    return (difference_rad + np.pi) % (2 * np.pi) - np.pi


@given(YAWS, TILTS, YAWS, YAWS)
def test_the_field_shows_the_yaw_whatever_the_tilt_and_the_yaw_believed(yaw, pitch, roll, believed):
    field = Rotation.from_euler("xyz", [roll, pitch, yaw]).inv().apply(EARTH_FIELD)
    tilted = Rotation.from_euler("xyz", [roll, pitch, believed]).as_quat()
    assert abs(angle(magnetic_yaw_rad(tilted, field) - yaw)) < 1e-9


@pytest.mark.parametrize(
    ("towards", "yaw_deg"), [((0, 1), 0.0), ((1, 0), 90.0), ((0, -1), 180.0), ((-1, 0), -90.0)], ids=list("ENWS")
)
def test_a_level_foot_that_faces_each_way(towards, yaw_deg):
    ahead, left = towards  # where magnetic north lies, seen from the foot
    field = np.array([ahead, left, -1.7])
    assert np.rad2deg(magnetic_yaw_rad(np.array([0.0, 0.0, 0.0, 1.0]), field)) == pytest.approx(yaw_deg)


@given(TILTS, YAWS, SEEDS)
def test_the_level_field_is_qius_formula(pitch, roll, seed):
    field = np.random.default_rng(seed).normal(size=3)
    (mx, my, mz), sp, cp, stt, ct = field, np.sin(roll), np.cos(roll), np.sin(pitch), np.cos(pitch)
    up = 9.81 * np.array([-stt, sp * ct, cp * ct])
    expected = [mx * ct + (my * sp + mz * cp) * stt, my * cp - mz * sp, -mx * stt + (my * sp + mz * cp) * ct]
    np.testing.assert_allclose(level_field(up, field), expected, atol=1e-12)
    np.testing.assert_allclose(
        Rotation.from_euler("xyz", [roll, pitch, 0.0]).apply(field), level_field(up, field), atol=1e-12
    )


@given(SEEDS)
def test_the_dip_is_the_angle_below_the_horizon(seed):
    attitude = Rotation.random(random_state=seed)
    field = attitude.inv().apply(EARTH_FIELD)
    up = up_in_body(attitude.as_quat())
    np.testing.assert_allclose(up, attitude.inv().apply([0.0, 0.0, 1.0]), atol=1e-12)
    assert dip_rad(np.array(up) * 9.81, field) == pytest.approx(DIP_RAD)


def test_a_foot_on_its_tip_gives_numbers():
    vertical = Rotation.from_euler("y", -90, degrees=True).as_quat()
    assert np.isfinite(magnetic_yaw_rad(vertical, EARTH_FIELD))
    assert np.isfinite(level_field(np.array([1.0, 0.0, 0.0]), EARTH_FIELD)).all()

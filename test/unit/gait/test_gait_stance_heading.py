"""Heading by the field of a standing foot, with the gyro off."""

import numpy as np
import pytest

from pdr_core.gait.stance_heading import PLACES, StanceHeading, field_of
from pdr_core.gait.stands import Stand
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import from_euler, matrix
from pdr_core.params import DeadReckoningParams, FilterParams
from pdr_core.records_gait import Angle

EARTH = np.array([0.0, 2.1e-5, -4.3e-5])
CLEAN, PARAMS = FilterParams(), DeadReckoningParams()
WORLD_RAD = 0.9  # the world's x is not east: nobody knows where north lies in odom


def stand(yaw, field=EARTH, roll=0.05, pitch=-0.1, seen=True) -> Stand:
    """A foot that stands so, in a field (east, north, up)."""
    R = matrix(from_euler(roll, pitch, yaw + WORLD_RAD))
    return Stand(0, R.T @ np.array([0.0, 0.0, 9.81]), R.T @ field, seen, None)


def taught(fields=(EARTH,) * 20, yaws=None) -> StanceHeading:
    stage = StanceHeading(CLEAN, PARAMS)
    for i, field in enumerate(fields):
        yaw = 0.4 * i if yaws is None else yaws[i]
        stage.learn(stand(yaw, field), Angle(wrapped_rad(yaw), 0.02))
    return stage


def disturbed(rng, share=0.3):
    return EARTH + share * np.linalg.norm(EARTH) * rng.standard_normal(3) / np.sqrt(3.0)


@pytest.mark.parametrize("yaw", [-3.1, -1.0, 0.0, 2.0, 3.1])
def test_a_clean_field_is_a_compass_however_the_foot_is_tilted(yaw):
    stage = taught()
    told = stage.heading(stand(yaw, roll=0.2, pitch=0.3))
    assert wrapped_rad(told.rad - yaw) == pytest.approx(0.0, abs=1e-9)
    assert told.sd_rad == CLEAN.field_heading_sd_rad


def test_too_few_places_tell_nothing():
    assert taught([EARTH] * (PLACES - 1)).heading(stand(0.0)) is None


@pytest.mark.parametrize("bent", [1.05 * EARTH, EARTH + np.array([0.0, 3e-6, 0.0])])
def test_another_strength_or_dip_is_no_clean_field(bent):
    told = taught().heading(stand(0.3, bent))
    assert told.sd_rad >= PARAMS.field_disturbed_sd_rad


def test_after_a_disturbance_as_many_places_must_agree_as_have_found_north():
    stage = taught()
    stage.heading(stand(0.0, 1.2 * EARTH))
    sds = [stage.heading(stand(0.0)).sd_rad for _ in range(PLACES)]
    assert sds[-2] >= PARAMS.field_disturbed_sd_rad
    assert sds[-1] == CLEAN.field_heading_sd_rad


def test_an_azimuth_that_wanders_finds_no_north():
    """Strength and dip alone would call it clean."""
    turned = [matrix(from_euler(0.0, 0.0, 0.3 * (i % 2))) @ EARTH for i in range(20)]
    assert taught(turned).heading(stand(0.0)).sd_rad >= PARAMS.field_disturbed_sd_rad


def test_in_a_building_the_heading_is_off_as_far_as_it_says():
    squares = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        stage = taught([disturbed(rng) for _ in range(30)])
        for _ in range(5):
            told = stage.heading(stand(1.0, disturbed(rng)))
            squares.append(wrapped_rad(told.rad - 1.0) ** 2 / (told.sd_rad**2 + told.common_sd_rad**2))
    assert 0.3 < np.mean(squares) < 1.3


def test_fields_of_every_direction_tell_nothing():
    rng = np.random.default_rng(1)
    assert taught([disturbed(rng, 20.0) for _ in range(40)]).heading(stand(0.0)) is None


def test_an_uncalibrated_magnetometer_is_no_compass():
    """Its offset turns with the foot, so after a turn strength and dip are others."""
    offset = np.array([1.5e-5, -1e-5, 0.0])
    stage = StanceHeading(CLEAN, PARAMS)
    for _ in range(20):
        one = stand(0.0)
        stage.learn(Stand(0, one.force_mps2, one.field_tesla + offset, True, None), Angle(0.0, 0.01))
    turned = stand(2.0)
    told = stage.heading(Stand(0, turned.force_mps2, turned.field_tesla + offset, True, None))
    assert told.sd_rad >= PARAMS.field_disturbed_sd_rad


def test_no_field_and_no_numbers_tell_nothing():
    stage = taught()
    assert field_of(stand(0.0, seen=False)) is None
    assert stage.heading(stand(0.0, seen=False)) is None
    assert stage.heading(stand(0.0, np.full(3, np.nan))) is None
    stage.learn(stand(0.0), Angle(np.nan, 0.1))
    assert stage.heading(stand(0.5)).rad == pytest.approx(0.5)

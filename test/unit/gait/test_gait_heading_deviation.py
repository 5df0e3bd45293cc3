"""The angle from where a foot points to where its person walks."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from dead_reckoning_cases import left_foot, step_event, tracked
from scipy.stats import chi2

from pdr_core.gait.heading_deviation import (
    UNKNOWN,
    HeadingDeviation,
    chord_rad,
    direction_of_displacement,
    direction_of_velocity,
)
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import from_euler, yaw_rad
from pdr_core.params import DeadReckoningParams
from pdr_core.records import NavBlock, part
from pdr_core.records_gait import Angle, Behaviour

PARAMS = DeadReckoningParams()
TABLE_4_DEG = (29.2, 5.8, 15.6, 8.7)


def learnt(pairs, behaviour=Behaviour.WALKING, yaw_sd_rad=0.0):
    """Learn from (direction, yaw before, yaw after)."""
    known = HeadingDeviation(PARAMS)
    for direction, before, after in pairs:
        known.learn(behaviour, step_event(direction), before, Angle(after, yaw_sd_rad))
    return known.deviation(behaviour)


@pytest.mark.parametrize("toe_out_deg", TABLE_4_DEG)
def test_the_testers_of_table_4_are_recovered_within_a_degree(toe_out_deg):
    walk = left_foot(toe_out_rad=np.radians(toe_out_deg))
    nav, steps = tracked(walk.imu)
    by_place, by_speed = HeadingDeviation(PARAMS), HeadingDeviation(PARAMS)
    yaw_before = yaw_rad(nav.quat_xyzw[0])
    for step in steps:
        rows = slice(*np.searchsorted(nav.stamp_ns, [step.start_ns, step.stamp_ns + 1]))
        after = Angle(step.yaw_rad, step.yaw_sd_rad)
        by_place.learn(Behaviour.WALKING, step, yaw_before, after)
        by_speed.learn(
            Behaviour.WALKING, step, yaw_before, after, direction_of_velocity(part(nav, rows.start, rows.stop))
        )
        yaw_before = step.yaw_rad
    # the left foot points to the left, so the person walks to its right
    found_deg = [np.degrees(known.deviation(Behaviour.WALKING).rad) for known in (by_place, by_speed)]
    assert found_deg[0] == pytest.approx(-toe_out_deg, abs=1.0)
    # the foot tips towards its toes as it flies, not towards where it goes: so the speed shows an eighth too much
    assert found_deg[1] == pytest.approx(-toe_out_deg, abs=0.13 * toe_out_deg + 0.3)


def test_a_sensor_worn_back_to_front_wraps():
    directions = np.radians([178.0, -178.0, 179.0, -179.0] * 10)
    assert abs(wrapped_rad(learnt([(d, 0.0, 0.0) for d in directions]).rad - np.pi)) < np.radians(0.5)


def test_in_a_turn_the_stride_goes_half_way():
    """Zhou's heading at the ground hit would show 20 deg less."""
    yaws = np.radians(40.0) * np.arange(20)
    found = learnt([(chord_rad(a, b) + 0.1, a, b) for a, b in pairwise(yaws)])
    assert found.rad == pytest.approx(0.1, abs=0.01)


def test_the_error_of_the_yaw_is_in_both_and_does_not_count():
    """A track that is turned by nobody knows how much tells the deviation all the same."""
    sure = HeadingDeviation(PARAMS)
    for _ in range(30):
        sure.learn(Behaviour.WALKING, step_event(0.2, sd_rad=0.5), 0.0, Angle(0.0, 0.5))
    assert sure.deviation(Behaviour.WALKING).sd_rad < 0.03


def test_each_behaviour_has_its_own():
    known = HeadingDeviation(PARAMS)
    for behaviour, direction in ((Behaviour.WALKING, 0.3), (Behaviour.RUNNING, -0.1)):
        for _ in range(20):
            known.learn(behaviour, step_event(direction), 0.0, Angle(0.0, 0.0))
    assert known.deviation(Behaviour.WALKING).rad == pytest.approx(0.3, abs=1e-3)
    assert known.deviation(Behaviour.RUNNING).rad == pytest.approx(-0.1, abs=1e-3)
    assert known.deviation(Behaviour.SWING) == UNKNOWN


def test_what_is_no_number_or_no_stride_tells_nothing():
    known = HeadingDeviation(PARAMS)
    known.learn(Behaviour.WALKING, step_event(0.3), 0.0, Angle(0.0, 0.0))
    before = known.deviation(Behaviour.WALKING)
    for step, yaw in (
        (step_event(np.nan), 0.0),
        (step_event(0.3, sd_rad=np.nan), 0.0),
        (step_event(0.3), np.nan),
        (step_event(2.0, length_m=0.0), 0.0),
        (step_event(2.0, length_m=0.2), 0.0),
    ):
        known.learn(Behaviour.WALKING, step, 0.0, Angle(yaw, 0.0))
    np.testing.assert_allclose(known.deviation(Behaviour.WALKING), before, atol=1e-4)


def test_a_clock_that_jumps_back_does_no_harm():
    known = HeadingDeviation(PARAMS)
    for _ in range(10):
        known.learn(Behaviour.WALKING, step_event(0.3, duration_s=-1e6), 0.0, Angle(0.0, 0.0))
    assert known.deviation(Behaviour.WALKING).rad == pytest.approx(0.3, abs=1e-3)


def test_a_few_strides_backwards_hardly_count():
    strides = [(0.1, 0.0, 0.0)] * 30 + [(0.1 + np.pi * 0.9, 0.0, 0.0)] * 3
    assert abs(learnt(strides).rad - 0.1) < np.radians(5.0)


def test_the_speed_is_that_of_one_moment_and_of_any_quadrant():
    """Zhou's component-wise maxima of a walk to the south-west would be those of a foot that stands."""
    speed = np.array([0.0, 1.0, 4.0, 2.0, 0.0])
    quat = np.tile(from_euler(0.0, 0.0, 0.7), (5, 1))
    ahead = np.array([-0.6, -0.8])
    foot = ahead @ np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])
    velocity = np.column_stack([speed[:, None] * foot, np.zeros(5)])
    twist = np.tile(np.diag([0.04] * 6), (5, 1, 1))
    pose = np.tile(np.diag([0.0] * 5 + [0.01**2]), (5, 1, 1))
    nav = NavBlock(np.arange(5), np.zeros((5, 3)), quat, velocity, np.zeros((5, 3)), pose, twist)
    found = direction_of_velocity(nav)
    assert found.rad == pytest.approx(np.arctan2(-0.8, -0.6), abs=1e-9)
    assert found.sd_rad == pytest.approx(np.hypot(0.2 / 4.0, 0.01), rel=1e-6)
    assert direction_of_velocity(nav._replace(velocity_mps=0.0 * velocity)) == UNKNOWN
    velocity[1] = np.nan
    assert direction_of_velocity(nav._replace(velocity_mps=velocity)).rad == pytest.approx(found.rad)
    assert direction_of_velocity(part(nav, 0, 0)) == UNKNOWN


def test_the_displacement_counts_from_x_counter_clockwise():
    assert direction_of_displacement(step_event(2.5, sd_rad=0.02)).rad == pytest.approx(2.5)


def test_it_is_as_uncertain_as_it_says():
    """NEES of 200 walks whose deviation wanders as the model has it, between both chi-square bounds at each epoch."""
    rng, runs, strides = np.random.default_rng(1), 200, 60
    quick = replace(PARAMS, deviation_gate=1e9)
    squares = np.empty((runs, strides))
    for run in range(runs):
        known, rate, deviation = HeadingDeviation(quick), 0.0, rng.uniform(-3.0, 3.0)
        rate = quick.deviation_rate_walk_radps * rng.standard_normal()
        for i in range(strides):
            deviation += rate + quick.deviation_walk_rad * rng.standard_normal()
            rate += quick.deviation_rate_walk_radps * rng.standard_normal()
            turn = 0.3 * rng.standard_normal()
            scatter = np.hypot(quick.deviation_scatter_rad, quick.turn_scatter * turn)
            noise = 0.05 * rng.standard_normal() + scatter * rng.standard_normal()
            yaw_error = 0.4 * rng.standard_normal()  # in track and yaw alike
            step = step_event(deviation + 0.5 * turn + noise + yaw_error, sd_rad=np.hypot(0.4, 0.05))
            known.learn(Behaviour.WALKING, step, yaw_error, Angle(turn + yaw_error, 0.4))
            found = known.deviation(Behaviour.WALKING)
            squares[run, i] = (wrapped_rad(found.rad - deviation) / found.sd_rad) ** 2
    mean = squares[:, 2:].mean(axis=0)
    low, high = chi2.ppf([0.025, 0.975], runs) / runs
    assert np.mean((mean > low) & (mean < high)) > 0.85
    assert low < mean.mean() < high

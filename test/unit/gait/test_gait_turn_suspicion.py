"""Turns by the push across the walk."""

import numpy as np
import pytest
from dead_reckoning_cases import judged_without_gyro, left_foot

from pdr_core.gait.stands import Stands
from pdr_core.gait.turn_suspicion import TurnSuspicion, across_mps
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import DeadReckoningParams

PARAMS = DeadReckoningParams()


def strides(**more):
    """Impulses and true turns of the strides of a corridor walk; with the sensor's mounting."""
    walk = left_foot(walk="corridor", length_m=100.0, sensor="consumer", **more)
    stage = Stands(PARAMS)
    stands = stage.run(judged_without_gyro(walk.imu)) + stage.finish()
    yaws = [yaw_rad(walk.motion.quat_xyzw[np.searchsorted(walk.imu.stamp_ns, s.stamp_ns)]) for s in stands]
    return [s.impulse_mps for s in stands[1:]], np.array([wrapped_rad(t) for t in np.diff(yaws)])


def taught(impulses, turns, deviation_rad=0.0):
    suspicion = TurnSuspicion(PARAMS)
    for impulse, turn in zip(impulses, turns, strict=True):
        suspicion.learn(across_mps(impulse, deviation_rad), float(turn))
    return suspicion


def test_a_simulated_person_that_turns_is_suspected_and_one_that_does_not_is_not():
    impulses, turns = strides(shock_mps2=40.0)
    half = len(turns) // 2
    suspicion = taught(impulses[:half], turns[:half], -0.12)
    suspected = np.array([suspicion.suspected(across_mps(i, -0.12)) for i in impulses[half:]])
    turning = np.abs(turns[half:]) > np.radians(15.0)
    assert turning.sum() >= 4
    assert suspected[turning].all()
    assert not suspected[np.abs(turns[half:]) < np.radians(5.0)].any()


def test_to_the_left_the_foot_is_pushed_to_the_left():
    impulses, turns = strides()
    pushed = np.array([across_mps(i, -0.12) for i in impulses])
    usual = np.median(pushed)
    assert (np.sign(pushed - usual) == np.sign(turns))[np.abs(turns) > 0.3].all()


def test_however_the_sensor_is_turned_on_the_foot_the_push_is_the_same():
    """The deviation has the mounting in it, so the axis across the walk is the same; but not the bias along it."""
    plain, _ = strides()
    turned, _ = strides(mounting_yaw_rad=2.0)
    one = [across_mps(i, -0.12) for i in plain]
    other = [across_mps(i, -0.12 - 2.0) for i in turned]
    np.testing.assert_allclose(other - np.median(other), one - np.median(one), atol=0.1)


def test_the_line_of_a_person_is_learnt_and_the_noise_with_it():
    rng = np.random.default_rng(4)
    suspicion = TurnSuspicion(PARAMS)
    for _ in range(200):
        impulse = rng.normal(0.3, 0.4)
        turn = 0.8 * (impulse - 0.3)
        suspicion.learn(impulse, turn + np.hypot(0.1, PARAMS.turn_sd_share * turn) * rng.standard_normal())
    assert suspicion.turn(0.8).rad == pytest.approx(0.4, abs=0.05)
    assert suspicion.turn(0.3).rad == pytest.approx(0.0, abs=0.03)
    assert suspicion.turn(0.3).sd_rad == pytest.approx(0.1, rel=0.25)
    assert suspicion.turn(0.8).sd_rad > suspicion.turn(0.3).sd_rad


def test_the_turn_is_off_as_far_as_it_says():
    """Mean normalised square of 100 persons after 30 strides, each with a line of the prior."""
    rng, squares = np.random.default_rng(5), []
    for _ in range(400):
        slope, offset = rng.normal(0.5, 0.2), rng.normal(0.0, 0.3)
        suspicion = TurnSuspicion(PARAMS)
        for i in range(31):
            turn = rng.choice([0.0, 0.0, 0.6, -0.6])
            impulse = (turn + np.hypot(0.26, 0.3 * turn) * rng.standard_normal() - offset) / slope
            if i == 30:
                told = suspicion.turn(impulse)
                squares.append(((told.rad - turn) / told.sd_rad) ** 2)
            suspicion.learn(impulse, turn)
    assert 0.3 < np.mean(squares) < 1.5  # one who does not turn is told too much: a line through noise is too flat


def test_before_anything_is_known_everything_is_suspected_or_uncertain():
    suspicion = TurnSuspicion(PARAMS)
    assert suspicion.suspected(None)
    assert suspicion.suspected(np.nan)
    assert suspicion.turn(None) == (0.0, PARAMS.held_turn_sd_rad)
    assert suspicion.turn(np.nan) == (0.0, PARAMS.held_turn_sd_rad)
    assert suspicion.turn(0.3).sd_rad > PARAMS.turn_sd_rad


def test_what_is_no_number_teaches_nothing():
    suspicion = TurnSuspicion(PARAMS)
    before = suspicion.turn(0.4)
    suspicion.learn(np.nan, 0.1)
    suspicion.learn(0.1, np.nan)
    assert suspicion.turn(0.4) == before

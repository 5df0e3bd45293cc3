"""Gui's own motion, as printed."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.simulation.gui_motion import (
    MAX_PITCH_RAD,
    STANCE_S,
    STEP_HEIGHT_M,
    STEP_LENGTH_M,
    SWING_S,
    TURN_S,
    GuiCourse,
    Phase,
    steps,
    turn,
)


def yaw(motion):
    return Rotation.from_quat(motion.quat_xyzw).as_euler("ZYX")[:, 0]


def test_position_and_attitude_do_not_jump():
    motion = GuiCourse([Phase(0.5), *steps(2), *turn(1.3), *steps(1)]).at(np.arange(0.0, 6.0, 1e-4))
    assert np.abs(np.diff(motion.position_m, axis=0)).max() < 2.0 * 1e-4  # top speed pi / 2 * 1.2 m/s
    assert np.abs(np.diff(motion.velocity_mps, axis=0)).max() < 12.0 * 1e-4
    attitude = Rotation.from_quat(motion.quat_xyzw)
    assert (attitude[:-1].inv() * attitude[1:]).magnitude().max() < 5.0 * 1e-4


def test_one_step_has_the_numbers_of_table_1():
    assert (STEP_LENGTH_M, STEP_HEIGHT_M, SWING_S, STANCE_S, MAX_PITCH_RAD, TURN_S) == (1.2, 0.15, 1.0, 0.5, 0.6, 0.5)
    middle = GuiCourse(steps(1)).at(np.array([0.5]))
    np.testing.assert_allclose(middle.position_m, [[0.6, 0.0, 0.15]])
    toe = Rotation.from_quat(middle.quat_xyzw).apply([1.0, 0.0, 0.0])[0]
    np.testing.assert_allclose(toe, [np.cos(0.6), 0.0, np.sin(0.6)], atol=1e-12)  # up
    ends = GuiCourse(steps(1)).at(np.array([1.0, 1.5])).position_m
    np.testing.assert_allclose(ends, [[1.2, 0, 0]] * 2, atol=1e-12)


def test_the_stance_flags_are_guis_phases():
    time = np.arange(0.0, 6.0, 0.01) + 0.001
    motion = GuiCourse([*steps(2), *turn(np.pi / 2), *steps(1)]).at(time)
    expected = np.array([t % 1.5 >= 1.0 if t < 3.0 else (3.5 <= t < 4.0 or t >= 5.0) for t in time])
    np.testing.assert_array_equal(motion.stance, expected)
    np.testing.assert_array_equal(motion.still, expected)


@pytest.mark.parametrize("joint_s", [1.0, 1.5])
def test_at_a_jump_of_the_acceleration_a_sample_is_the_mean_of_both_sides_and_swing(joint_s):
    motion = GuiCourse(steps(2)).at(joint_s + np.array([-1e-6, -1e-10, 1e-10, 1e-6]))
    assert np.ptp(motion.acceleration_mps2[:, 0]) == pytest.approx(0.6 * np.pi**2, rel=1e-6)
    between = 0.5 * (motion.acceleration_mps2[0] + motion.acceleration_mps2[3])
    np.testing.assert_allclose(motion.acceleration_mps2[1:3], [between] * 2, atol=1e-3)
    assert motion.stance.tolist() == ([False, False, False, True] if joint_s == 1.0 else [True, False, False, False])


def test_a_turn_is_on_the_spot_and_left_is_positive():
    end = GuiCourse([*turn(np.pi / 2), *steps(1)]).at(np.array([0.25, 0.5, 3.0]))
    np.testing.assert_allclose(yaw(end), [np.pi / 4, np.pi / 2, np.pi / 2])
    np.testing.assert_allclose(end.position_m[1], 0.0, atol=1e-15)
    np.testing.assert_allclose(end.position_m[2], [0.0, 1.2, 0.0], atol=1e-12)

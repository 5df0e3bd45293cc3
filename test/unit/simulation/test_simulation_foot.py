"""The smooth foot moves as feet do."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import SimulationParams
from pdr_core.simulation.foot_motion import SENSOR_HEIGHT_M, FootCourse
from pdr_core.simulation.gait import RUN, STAIRS_DOWN, STAIRS_UP, WALK, Stride
from pdr_core.simulation.walk import course

RATE_HZ = 500.0
FIGURES = {  # foot rate [rad/s], acceleration [m/s^2], swing [s], stance [s], still share of the stance
    "walk": (WALK, (6, 10), (30, 60), (0.4, 0.6), (0.5, 0.7), (0.4, 0.6)),
    "run": (RUN, (8, 16), (40, 90), (0.4, 0.6), (0.18, 0.22), (0.05, 0.15)),
    "sprint": (RUN.paced(2.0), (12, 30), (80, 160), (0.3, 0.45), (0.12, 0.16), (0.05, 0.15)),
}


def walked(strides):
    path = FootCourse(strides)
    return path, path.at(np.arange(0.0, path.duration_s, 1.0 / RATE_HZ))


def in_world(motion):
    """The rate in the world frame."""
    return Rotation.from_quat(motion.quat_xyzw).apply(motion.rate_radps)


def of(walk, **params):
    path = course(SimulationParams(motion="smooth", walk=walk, **params))
    return path.at(np.arange(0.0, path.duration_s, 1.0 / RATE_HZ))


@pytest.mark.parametrize("name", FIGURES)
def test_a_gait_has_realistic_figures(name):
    gait, rates, accelerations, swings, stances, stills = FIGURES[name]
    _, motion = walked([Stride(gait)] * 5)
    assert rates[0] < np.linalg.norm(motion.rate_radps, axis=1).max() < rates[1]
    assert accelerations[0] < np.linalg.norm(motion.acceleration_mps2, axis=1).max() < accelerations[1]
    edges = np.flatnonzero(np.diff(motion.stance.astype(int))) / RATE_HZ
    swing, stance = np.diff(edges)[::2], np.diff(edges)[1::2]
    assert swings[0] <= swing.min() <= swing.max() <= swings[1]
    assert stances[0] <= stance.min() <= stance.max() <= stances[1]
    inside = slice(round(edges[1] * RATE_HZ) + 1, round(edges[2] * RATE_HZ))
    assert stills[0] < motion.still[inside].mean() < stills[1]


def test_in_stance_the_sensor_rolls_about_the_contact_below_it():
    motion = of("mixed")
    w, v = in_world(motion)[motion.stance], motion.velocity_mps[motion.stance]
    np.testing.assert_allclose(v, np.cross(w, [0.0, 0.0, SENSOR_HEIGHT_M]), atol=1e-12)
    assert np.abs(v).max() > 0.3


def test_in_swing_the_contact_moves():
    motion = of("straight")
    swing = ~motion.stance
    slip = motion.velocity_mps - np.cross(in_world(motion), [0.0, 0.0, SENSOR_HEIGHT_M])
    assert np.linalg.norm(slip[swing], axis=1).max() > 4.0
    deep = np.convolve(swing, np.ones(21), "same") == 21  # 20 ms from toe-off and heel strike
    assert np.linalg.norm(slip[deep], axis=1).min() > 1e-3


def test_a_foot_that_is_flat_is_perfectly_still():
    _, motion = walked([Stride(WALK, turn_rad=0.3), Stride(WALK, pause_s=1.0)])
    assert motion.still.sum() / RATE_HZ == pytest.approx(6.0 + 2 * WALK.flat_s + 1.0, abs=0.03)
    level = Rotation.from_quat(motion.quat_xyzw[motion.still]).apply([0.0, 0.0, 1.0])
    np.testing.assert_array_equal(level, np.tile([0.0, 0.0, 1.0], (len(level), 1)))


def test_the_heel_comes_down_first_and_leaves_first():
    path, motion = walked([Stride(WALK)] * 2)
    toe_up = Rotation.from_quat(motion.quat_xyzw).apply([1.0, 0.0, 0.0])[:, 2]
    strike = np.searchsorted(np.arange(len(toe_up)) / RATE_HZ, path.strikes_s)
    toe_off = np.flatnonzero(motion.stance[:-1] & ~motion.stance[1:])
    assert toe_up[strike].min() > 0.2
    assert toe_up[toe_off].max() < -0.4
    assert np.abs(motion.rate_radps[[*strike, *toe_off], 1]).min() > 1.0  # it comes down and leaves turning


def test_a_turn_is_walked_along_an_arc_in_swing_alone():
    motion = of("curve", walk_length_m=30.0)
    yaw = np.unwrap(Rotation.from_quat(motion.quat_xyzw).as_euler("ZYX")[:, 0])
    assert yaw[-1] == pytest.approx(2 * np.pi)
    assert np.abs(np.diff(yaw)[motion.stance[1:] & motion.stance[:-1]]).max() < 1e-12
    radius = WALK.length_m / (2.0 * np.sin(np.pi / 21))  # 21 chords
    contacts = motion.position_m[motion.still, :2]
    np.testing.assert_allclose(np.linalg.norm(contacts - [0.0, radius], axis=1), radius)


def test_stairs_keep_the_floors_apart():
    height = of("stairs").position_m[:, 2]
    still = of("stairs").still
    assert height.max() == pytest.approx(9 * 0.34 + 0.12, abs=1e-3)
    assert height[-1] == pytest.approx(0.0, abs=1e-12)
    floors, counts = np.unique(np.round(height[still], 6), return_counts=True)
    assert len(floors) == 10
    assert set(np.argsort(counts)[-2:]) == {0, 9}


@pytest.mark.parametrize(("gait", "climb_m"), [(STAIRS_UP, 0.34), (STAIRS_DOWN, -0.34)])
def test_on_stairs_the_foot_clears_the_higher_step(gait, climb_m):
    _, motion = walked([Stride(gait, climb_m=climb_m)])
    assert motion.position_m[:, 2].max() == pytest.approx(max(0.0, climb_m) + gait.lift_m, abs=1e-4)
    assert motion.position_m[-1, 2] == pytest.approx(climb_m)

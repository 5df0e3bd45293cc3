"""The walk round a campus after Gui figure 6, and Gui's steps along arcs."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import SimulationParams
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.campus import ARC_DEG, HEADINGS_DEG, SHORTEST_M, campus
from pdr_core.simulation.gui_motion import GuiCourse, Phase, step


@pytest.mark.parametrize("stride_m", [1.2, 1.4])
@pytest.mark.parametrize("length_m", [100.0, 250.0, 590.0])
def test_it_has_its_length_and_closes(length_m, stride_m):
    paces = campus(length_m, stride_m)
    turn, chord = np.array([p.turn_rad for p in paces]), np.array([p.length_m for p in paces])
    heading = np.cumsum(turn) - 0.5 * turn
    assert chord.sum() == pytest.approx(length_m)
    np.testing.assert_allclose([chord @ np.cos(heading), chord @ np.sin(heading)], 0.0, atol=1e-9)
    assert np.degrees(turn.sum()) == pytest.approx(360.0)
    assert np.abs(chord / stride_m - 1.0).max() < 0.15
    assert np.abs(np.degrees(turn[turn > 0.0]) - ARC_DEG).max() < 1.0


def test_a_shorter_walk_than_the_curves_need_is_the_shortest():
    assert campus(10.0, 1.2) == campus(SHORTEST_M, 1.2)


def test_its_lines_lead_in_directions_of_no_building():
    for spacing_deg in (30.0, 45.0, 90.0):
        off = np.array(HEADINGS_DEG) % spacing_deg
        assert (np.minimum(off, spacing_deg - off) >= 5.0).sum() >= 3


@pytest.mark.parametrize("motion", ["gui", "smooth"])
def test_both_motions_walk_it(motion):
    walk = simulated_walk(SimulationParams(motion=motion, walk="campus", walk_length_m=150.0, sensor_model="ideal"))
    position_m, quat = walk.motion.position_m, walk.motion.quat_xyzw
    np.testing.assert_allclose(position_m[-1], 0.0, atol=1e-9)
    assert np.ptp(position_m[:, :2], axis=0).min() > 20.0
    yaw = np.unwrap(Rotation.from_quat(quat).as_euler("ZYX")[:, 0])
    assert np.degrees(yaw[-1]) == pytest.approx(360.0, abs=1e-6)


def test_a_step_along_an_arc_leads_along_its_chord_and_rate_and_attitude_agree():
    course = GuiCourse([Phase(0.5), *step(1.2, 0.3), *step(1.0, -0.2)])
    time_s = np.arange(0.0, course.duration_s, 1e-3)
    motion = course.at(time_s)
    ends = [motion.position_m[np.searchsorted(time_s, end_s + 0.1)] for end_s in (1.5, 3.0)]
    np.testing.assert_allclose(ends[0][:2], 1.2 * np.array([np.cos(0.15), np.sin(0.15)]), atol=1e-9)
    np.testing.assert_allclose((ends[1] - ends[0])[:2], [np.cos(0.2), np.sin(0.2)], atol=1e-9)
    attitude = Rotation.from_quat(motion.quat_xyzw)
    turned = (attitude[:-2].inv() * attitude[2:]).as_rotvec() / 2e-3
    swing = ~motion.stance[:-2] & ~motion.stance[2:]
    np.testing.assert_allclose(turned[swing], motion.rate_radps[1:-1][swing], atol=2e-4)
    velocity = (motion.position_m[2:] - motion.position_m[:-2]) / 2e-3
    np.testing.assert_allclose(velocity[swing], motion.velocity_mps[1:-1][swing], atol=1e-4)

"""Exact derivatives: every motion against numerical differentiation of its own position and attitude."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import SimulationParams
from pdr_core.simulation.courses import strides
from pdr_core.simulation.gui_motion import GuiCourse, Phase, steps, turn
from pdr_core.simulation.two_feet import both_feet
from pdr_core.simulation.walk import course

H = 1e-5
CORRIDOR = SimulationParams(walk="corridor", walk_length_m=20.0)
GUI = [Phase(0.5), *steps(2), *turn(1.3), *steps(1)]
JOINTS = np.cumsum([0.0] + [p.duration_s for p in GUI])
COURSES = {
    "gui": GuiCourse(GUI),
    **{
        f"{walk} at pace {pace}": course(SimulationParams(motion="smooth", walk=walk, walk_length_m=20.0, pace=pace))
        for walk, pace in (("rectangle", 1.0), ("curve", 1.0), ("stairs", 1.0), ("run", 2.0), ("mixed", 1.3))
    },
    **both_feet(strides("corridor", 20.0, 1.0), CORRIDOR),
}


@pytest.fixture(params=COURSES)
def around(request):
    """The motion just before, at and just after many times."""
    path = COURSES[request.param]
    time = np.linspace(0.01, path.duration_s - 0.01, 20_011)
    if request.param == "gui":  # its acceleration jumps at the joints
        time = time[np.abs(time[:, None] - JOINTS).min(1) > 3 * H]
    return [path.at(time + s * H) for s in (-1, 0, 1)]


def test_the_velocity_is_that_of_the_position(around):
    before, at, after = around
    np.testing.assert_allclose((after.position_m - before.position_m) / (2 * H), at.velocity_mps, atol=1e-6)
    assert np.abs(at.velocity_mps).max() > 1.0


def test_the_acceleration_is_that_of_the_velocity(around):
    before, at, after = around
    np.testing.assert_allclose((after.velocity_mps - before.velocity_mps) / (2 * H), at.acceleration_mps2, atol=3e-5)


def test_the_rate_turns_the_attitude(around):
    before, _, after = (Rotation.from_quat(m.quat_xyzw) for m in around)
    np.testing.assert_allclose((before.inv() * after).as_rotvec() / (2 * H), around[1].rate_radps, atol=1e-5)


@pytest.mark.parametrize("name", [name for name in COURSES if name != "gui"])
def test_a_smooth_foot_has_no_steps_of_acceleration_or_jerk(name):
    m = COURSES[name].at(np.arange(0.0, COURSES[name].duration_s, 1e-4))
    for column in (m.acceleration_mps2, np.gradient(m.rate_radps, 1e-4, axis=0)):
        jerk = np.abs(np.diff(column, axis=0)).max() / 1e-4
        assert jerk < 60.0 * np.abs(column).max()  # within 1/60 s; a step would be within 1e-4 s
        snap = np.abs(np.diff(column, 2, axis=0)).max() / 1e-8
        assert snap < 120.0**2 * np.abs(column).max()

"""The named walks."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.parameter import ParameterError, meta
from pdr_core.params import SimulationParams
from pdr_core.simulation import simulated_walk, walk_duration_s

WALKS = meta(SimulationParams.__dataclass_fields__["walk"]).choices
LEVEL = ("rectangle", "straight", "still")
BOTH = pytest.mark.parametrize("motion", ["gui", "smooth"])


@pytest.mark.parametrize(("motion", "walk"), [("gui", w) for w in LEVEL] + [("smooth", w) for w in WALKS])
def test_every_walk_begins_and_ends_at_rest(motion, walk):
    sim = simulated_walk(SimulationParams(motion=motion, walk=walk))
    still = sim.motion.still
    assert still[:598].all()
    assert still[-596:].all()
    np.testing.assert_array_equal(sim.motion.position_m[0], 0.0)
    np.testing.assert_array_equal(sim.truth.position_m, sim.motion.position_m)
    np.testing.assert_array_equal(sim.truth.stamp_ns, sim.imu.stamp_ns)
    assert still.all() == (walk == "still")


@pytest.mark.parametrize("walk", [w for w in WALKS if w not in (*LEVEL, "campus")])
def test_gui_has_no_other_walks(walk):
    with pytest.raises(ParameterError, match=r"only rectangle, .* and campus; set simulation\.motion to smooth"):
        walk_duration_s(SimulationParams(motion="gui", walk=walk))


@BOTH
@pytest.mark.parametrize("length_m", [3.0, 24.0, 36.0, 100.0])
def test_the_rectangle_closes(motion, length_m):
    walk = simulated_walk(SimulationParams(motion=motion, walk="rectangle", walk_length_m=length_m))
    np.testing.assert_allclose(walk.motion.position_m[-1], 0.0, atol=1e-9)
    yaw = np.unwrap(Rotation.from_quat(walk.motion.quat_xyzw).as_euler("ZYX")[:, 0])
    assert yaw[-1] == pytest.approx(2 * np.pi)
    walked = np.linalg.norm(np.diff(walk.motion.position_m[:, :2], axis=0), axis=1).sum()
    least_m = 4.8 if motion == "gui" else 22.4  # its corners are walked
    assert walked == pytest.approx(max(length_m, least_m), abs=3.0)


@BOTH
@pytest.mark.parametrize(("walk", "least_m"), [("straight", 11.0), ("still", 0.0)])
def test_straight_and_still(motion, walk, least_m):
    params = SimulationParams(motion=motion, walk=walk, walk_length_m=12.0)
    end_m = simulated_walk(params).motion.position_m[-1]
    assert least_m <= end_m[0] <= least_m + 2.0
    np.testing.assert_allclose(end_m[1:], 0.0, atol=1e-12)


def test_the_pace_makes_strides_longer_and_quicker():
    usual, fast = (SimulationParams(motion="smooth", walk="run", walk_length_m=30.0, pace=p) for p in (1.0, 2.0))
    speeds = []
    for params in (usual, fast):
        motion = simulated_walk(params).motion
        speeds.append(motion.position_m[-1, 0] / (walk_duration_s(params) - 6.0))
    assert speeds[0] == pytest.approx(3.0, rel=0.01)
    assert speeds[1] == pytest.approx(6.0, rel=0.01)


def test_the_mixed_walk_holds_runs_turns_a_stand_and_a_shuffle():
    motion = simulated_walk(SimulationParams(motion="smooth", walk="mixed")).motion
    edges = np.flatnonzero(np.diff(motion.stance.astype(int)))
    stances_s, strides_m = (
        np.diff(edges)[1::2] / 200.0,
        np.linalg.norm(np.diff(motion.position_m[edges[::2]], axis=0), axis=1),
    )
    assert stances_s.min() < 0.3
    assert stances_s.max() > 2.0
    assert strides_m.max() > 2.0
    assert strides_m.min() < 0.6
    yaw = np.unwrap(Rotation.from_quat(motion.quat_xyzw).as_euler("ZYX")[:, 0])
    assert yaw[-1] == pytest.approx(np.pi)
    assert yaw.max() > np.pi + 0.5

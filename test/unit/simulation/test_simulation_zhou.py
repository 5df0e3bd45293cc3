"""Zhou's walks and testers: where the foot stands, how it points, what it does."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.maths.circular import wrapped_rad
from pdr_core.parameter import ParameterError
from pdr_core.params import SimulationParams
from pdr_core.records_gait import Behaviour
from pdr_core.simulation import simulated_feet, simulated_walk
from pdr_core.simulation.foot_motion import FootCourse, stands
from pdr_core.simulation.gait import WALK, Stride
from pdr_core.simulation.testers import RUNNING_SHARE, TESTERS, footprints
from pdr_core.simulation.walk import personal_strides, walker
from pdr_core.simulation.zhou_courses import LAP_M, corners, octagon


def smooth(**more):
    return SimulationParams(motion="smooth", **more)


def test_the_octagon_closes_in_laps_and_has_eight_corners_each():
    strides = octagon(2.0 * LAP_M, WALK)
    places = stands(strides)
    assert sum(s.gait.length_m for s in strides) == pytest.approx(2.0 * LAP_M)
    np.testing.assert_allclose(places[[len(strides) // 2, -1], :2], 0.0, atol=1e-9)
    at = corners(strides)
    assert len(at) == 16
    np.testing.assert_allclose(np.degrees(wrapped_rad_of(places[at, 3] - places[[i - 1 for i in at], 3])), 22.5)
    assert np.ptp(np.linalg.norm(places[at[:8], :2] - places[at[:8], :2].mean(axis=0), axis=1)) < 1e-9


def wrapped_rad_of(angles):
    return np.array([wrapped_rad(float(angle)) for angle in angles])


@pytest.mark.parametrize("deviation_rad", [0.5, -0.2])
def test_the_foot_points_away_from_its_way_by_the_deviation(deviation_rad):
    walk = simulated_walk(smooth(walk="octagon", walk_length_m=LAP_M, heading_deviation_rad=deviation_rad))
    straight = simulated_walk(smooth(walk="octagon", walk_length_m=LAP_M))
    still = walk.motion.still
    yaw = Rotation.from_quat(walk.motion.quat_xyzw[still]).as_euler("ZYX")[:, 0]
    way = Rotation.from_quat(straight.motion.quat_xyzw[still]).as_euler("ZYX")[:, 0]
    np.testing.assert_allclose(wrapped_rad_of(way - yaw), deviation_rad, atol=1e-9)
    np.testing.assert_allclose(walk.motion.position_m[still], straight.motion.position_m[still], atol=1e-9)


def test_a_runner_points_by_a_share_of_it():
    strides = personal_strides(smooth(walk="transitions", walk_length_m=60.0))
    tester = TESTERS["none"]._replace(deviation_rad=0.4)
    yaw_rad = footprints(strides, tester, 0.0, 1)[:, 3]
    ran = np.array([False, *(s.gait.behaviour is Behaviour.RUNNING for s in strides)])
    np.testing.assert_allclose(yaw_rad, np.where(ran, -0.4 * RUNNING_SHARE, -0.4))


def test_the_transitions_are_a_swing_a_walk_a_run_and_a_walk():
    params = smooth(walk="transitions", walk_length_m=60.0)
    strides = personal_strides(params)
    behaviours = [s.gait.behaviour for s in strides]
    changes = [b for b, before in zip(behaviours, [None, *behaviours], strict=False) if b is not before]
    assert changes == [Behaviour.SWING, Behaviour.WALKING, Behaviour.RUNNING, Behaviour.WALKING]
    motion = simulated_walk(params).motion
    on_the_spot = motion.position_m[: round(200 * (3.0 + sum(s.duration_s for s in strides[:4])))]
    assert np.abs(on_the_spot[-1]).max() < 1e-9
    assert 0.1 <= on_the_spot[:, 0].max() < 0.15
    assert motion.position_m[-1, 0] == pytest.approx(60.0, abs=3.0)


@pytest.mark.parametrize(
    ("name", "stature_m", "deviation_deg"), [("a", 1.75, 29.2), ("b", 1.80, 5.8), ("c", 1.58, 15.6), ("d", 1.60, 8.7)]
)
def test_the_testers_are_those_of_table_4(name, stature_m, deviation_deg):
    tester = TESTERS[name]
    assert (tester.stature_m, np.degrees(tester.deviation_rad)) == (stature_m, pytest.approx(deviation_deg))
    strides = personal_strides(smooth(walk="octagon", walk_length_m=LAP_M, tester=name))
    stride_s = np.array([s.gait.duration_s for s in strides])
    assert stride_s.mean() == pytest.approx(1.2 * (stature_m / 1.75) ** 0.5, rel=0.03)  # Table 8
    assert 0.005 < stride_s.std() / stride_s.mean() < 0.04
    length_m = np.array([s.gait.length_m for s in strides])
    assert length_m.sum() == pytest.approx(LAP_M, rel=0.05)
    np.testing.assert_allclose(length_m * stride_s, length_m[0] * stride_s[0])  # each the root of the speed


def test_a_tester_steps_beside_the_way_and_no_farther_the_longer_the_walk():
    strides = personal_strides(smooth(walk="octagon", walk_length_m=4.0 * LAP_M, tester="a"))
    beside_m = footprints(strides, TESTERS["a"], 0.018, 1)[:, :2] - stands(strides)[:, :2]
    assert beside_m[1:-1].std() == pytest.approx(0.018, rel=0.1)
    assert not beside_m[[0, -1]].any()


def test_seeds_differ_and_the_same_seed_walks_the_same():
    first, again, other = (personal_strides(smooth(walk="octagon", tester="c", seed=seed)) for seed in (1, 1, 2))
    assert first == again
    assert [s.gait.duration_s for s in first] != [s.gait.duration_s for s in other]


def test_the_usual_person_walks_as_before():
    strides = [Stride(WALK)] * 5
    np.testing.assert_array_equal(footprints(strides, TESTERS["none"], 0.018, 1), stands(strides))
    time_s = np.arange(0.0, 5.0, 0.01)
    same = FootCourse(strides).at(time_s), FootCourse(strides, stands(strides)).at(time_s)
    np.testing.assert_array_equal(same[0].position_m, same[1].position_m)


def test_what_contradicts_itself_is_refused():
    with pytest.raises(ParameterError, match="leave out one"):
        walker(smooth(tester="a", heading_deviation_rad=0.1))
    with pytest.raises(ParameterError, match="both feet"):
        simulated_feet(smooth(tester="a"))

"""The walks of Qiu section 3."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import SimulationParams
from pdr_core.simulation.foot_motion import FootCourse
from pdr_core.simulation.gait import WALK, Stride
from pdr_core.simulation.qiu_courses import FEWEST, LAP_M, lap, qiu_rectangle, stair_climb, track
from pdr_core.simulation.walk import course


def walked(strides):
    path = FootCourse(strides)
    motion = path.at(np.arange(0.0, path.duration_s, 0.01))
    return motion.position_m, np.degrees(np.unwrap(Rotation.from_quat(motion.quat_xyzw).as_euler("ZYX")[:, 0]))


def length_m(strides):
    return sum(s.gait.length_m for s in strides)


@pytest.mark.parametrize(("count", "metres"), [(57, 49.51), (60, 48.73), (55, 51.33), (FEWEST, 20.0)])
def test_the_rectangle_has_ten_right_turns_and_as_many_strides_and_metres_as_asked(count, metres):
    strides = qiu_rectangle(count, metres)
    assert len(strides) == count
    assert length_m(strides) == pytest.approx(metres)
    position_m, heading_deg = walked(strides)
    assert heading_deg[0] == 0.0
    assert heading_deg[-1] == pytest.approx(-900.0)
    assert np.diff(heading_deg).max() < 1e-9  # to the right only
    assert np.linalg.norm(position_m[-1]) < 2.0


def test_both_laps_of_the_rectangle_close():
    strides = qiu_rectangle(57, 49.51)
    turned_deg = np.degrees(np.cumsum([s.turn_rad for s in strides]))
    ends = np.flatnonzero(np.abs(turned_deg + 720.0) < 1e-9)
    np.testing.assert_allclose(walked(strides[: ends[0] + 1])[0][-1], 0.0, atol=1e-9)
    half = (ends[0] + 1) // 2
    np.testing.assert_allclose(walked(strides[:half])[0][-1], 0.0, atol=1e-9)


def test_too_few_strides_become_as_many_as_there_must_be():
    strides = qiu_rectangle(9, 9.0)
    assert len(strides) == FEWEST
    assert length_m(strides) == pytest.approx(FEWEST)


@pytest.mark.parametrize("count", [297, 306, 321])
def test_a_lap_closes_and_is_as_long_as_lane_4(count):
    strides = lap(count)
    assert len(strides) == count
    assert length_m(strides) == pytest.approx(LAP_M, rel=1e-4)  # chords are shorter
    lengths_m = [s.gait.length_m for s in strides]
    assert max(lengths_m) / min(lengths_m) < 1.02
    position_m, heading_deg = walked(strides)
    np.testing.assert_allclose(position_m[-1], 0.0, atol=1e-6)
    assert heading_deg[-1] == pytest.approx(360.0)
    assert np.ptp(position_m[:, 1]) == pytest.approx(80.9, abs=0.1)  # two radii of the lane
    assert np.ptp(position_m[:, 0]) == pytest.approx(84.39 + 80.9, abs=0.1)


def test_two_laps_may_differ():
    strides = track([307, 306])
    assert len(strides) == 613
    np.testing.assert_allclose(walked(strides)[0][-1], 0.0, atol=1e-6)


def test_the_stairs_are_twenty_steps_of_16_by_30_cm():
    strides = stair_climb([Stride(WALK)] * 2)
    climbing = [s for s in strides if s.climb_m]
    assert len(climbing) == 10
    position_m, heading_deg = walked(strides)
    np.testing.assert_allclose(position_m[-1], [4 * 1.4 + 6.0, 0.0, 3.2], atol=1e-9)
    np.testing.assert_allclose(heading_deg, 0.0, atol=1e-12)


@pytest.mark.parametrize(
    ("walk", "metres", "strides"), [("qiu_rectangle", 50.0, 57), ("track", 36.0, 302), ("track", 850.0, 604)]
)
def test_the_named_walks(walk, metres, strides):
    path = course(SimulationParams(motion="smooth", walk=walk, walk_length_m=metres))
    assert len(path.strikes_s) == strides


def test_the_level_walk_before_and_after_the_stairs_is_as_long_as_asked():
    path = course(SimulationParams(motion="smooth", walk="stair_climb", walk_length_m=8.4))
    assert len(path.strikes_s) == 10 + 6

"""Whole walks with level ground: floors are level and known as well as they say, stairs and ramps stay."""

import numpy as np
import pytest
from test_eskf_floor import LEVEL, Z

from pdr_core.bench.believed_walk import RATE_HZ, Ground, believed_walk, told
from pdr_core.bench.consistency import nees, spread, truly_judged
from pdr_core.conventions import stamp_ns_from_seconds
from pdr_core.eskf import ZuptFilter
from pdr_core.intake import Ingestion
from pdr_core.params import Params, PlaceParams, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import joined, part
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.foot_motion import FootCourse
from pdr_core.simulation.gait import WALK, Stride
from pdr_core.simulation.walk import walked

RUNS = 50


def estimated(walk, params):
    chain = FootInertial(params)
    outputs = [chain.run(walk.imu), chain.finish()]
    return joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps]


def simulated(name, rate_hz=200.0):
    sim = SimulationParams(motion="smooth", walk=name, sample_rate_hz=rate_hz, sensor_model="consumer")
    return simulated_walk(sim)


def heights(walk, steps):
    """Return the estimated and the true heights of the stances."""
    at = np.searchsorted(walk.imu.stamp_ns, [s.stamp_ns for s in steps])
    return np.array([s.position_m[Z] for s in steps]), walk.motion.position_m[at, Z]


@pytest.mark.parametrize("name", ["stairs", "mixed", "rectangle", "run"])
def test_the_height_stays_true_and_the_rest_as_it_was(name):
    walk = simulated(name)
    (nav, steps), (without, steps_without) = estimated(walk, LEVEL), estimated(walk, Params())
    found, true = heights(walk, steps)
    drifted, _ = heights(walk, steps_without)
    assert np.abs(found - true).max() < 0.025 < np.abs(drifted - true).max()
    assert np.abs(np.diff(found) - np.diff(true)).max() < 0.01
    np.testing.assert_array_equal(nav.position_m[:, :2], without.position_m[:, :2])
    for name in ("quat_xyzw", "velocity_mps", "rate_radps", "twist_covariance"):
        np.testing.assert_array_equal(getattr(nav, name), getattr(without, name))


@pytest.mark.parametrize("rate_hz", [50.0, 1000.0])
def test_the_rate_hardly_matters(rate_hz):
    walk = simulated("stairs", rate_hz)
    found, true = heights(walk, estimated(walk, LEVEL)[1])
    assert np.abs(found - true).max() < 0.03


def test_a_walk_cut_into_pieces_gives_the_same_bits():
    walk, chain = simulated("mixed"), FootInertial(LEVEL)
    pieces = [chain.run(part(walk.imu, i, i + 37)).nav for i in range(0, len(walk.imu.stamp_ns), 37)]
    np.testing.assert_array_equal(
        joined([*pieces, chain.finish().nav]).position_m, estimated(walk, LEVEL)[0].position_m
    )


@pytest.mark.parametrize(("slope", "kept"), [(0.01, 0.1), (0.05, 0.85), (0.08, 1.0)])
def test_only_a_gentle_ramp_is_taken_for_level(slope, kept):
    ramp = [Stride(WALK)] * 5 + [Stride(WALK, climb_m=slope * WALK.length_m)] * 10
    walk = walked(FootCourse(ramp), SimulationParams())
    nav, _ = estimated(walk, LEVEL)
    assert nav.position_m[-1, Z] / walk.motion.position_m[-1, Z] == pytest.approx(kept, abs=0.1)


def uneven(off_m):
    """Return a walk whose foot comes down so much off the floor."""
    course = FootCourse([Stride(WALK, climb_m=climb_m) for climb_m in np.diff(off_m)])
    time_s = np.arange(round(course.duration_s * RATE_HZ)) / RATE_HZ
    return Ground(stamp_ns_from_seconds(time_s), course.at(time_s))


def test_heights_are_as_uncertain_as_they_say():
    knows = changed(told(), "filter", level_ground=True, zero_velocity_sd_mps=0.005)
    squares = []
    for seed in range(RUNS):
        where = uneven(np.random.default_rng([seed, 7]).normal(0.0, knows.filter.floor_sd_m, 13))
        walk = believed_walk(where, knows.filter, True, seed)
        f = ZuptFilter(knows.filter, PlaceParams())
        nav, steps = f.run(truly_judged(Ingestion(knows.intake).run(walk.imu), where.motion.still))
        at = np.searchsorted(nav.stamp_ns, [s.stamp_ns for s in steps + f.finish()])
        squares.append(nees(nav.position_m[at, Z:3] - walk.position_m[at, Z:3], nav.pose_covariance[at, Z:3, Z:3]))
    found = spread("heights", 1, np.array(squares))
    assert found.inside >= 0.8

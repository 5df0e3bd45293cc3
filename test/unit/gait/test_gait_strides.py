"""Strides in figures against the truth of simulated walks."""

from dataclasses import fields, replace

import numpy as np
import pytest
from gait_cases import analysed, smooth_walk, tipped_s

from pdr_core.conventions import NANOSECONDS
from pdr_core.gait.stride_analysis import WAITING
from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline import FootGait, FootInertial, FootOutput, SmoothedFoot
from pdr_core.records import NOT_NUMBERED, ImuBlock, part
from pdr_core.records_gait import CYCLE_POINTS
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.gait import RISE_M, RUN, STAIRS_UP, WALK


@pytest.fixture(scope="module")
def straight():
    sim, foot = smooth_walk()
    return sim, foot, analysed(sim.imu)


@pytest.fixture(scope="module")
def struck():
    """The shocks leave velocities that are not there, so only the times of this walk are exact."""
    sim, foot = smooth_walk(shock_mps2=60.0)
    return sim, foot, analysed(sim.imu)


def numbers(stride):
    """Every figure of a stride as an array."""
    values = [getattr(stride, f.name) for f in fields(stride) if f.name != "step"]
    return [np.asarray(value, float) for value in values if value is not None]


def test_lengths_times_and_speed_of_a_walk(straight):
    _, _, walk = straight
    inner = walk.strides[1:-1]
    assert len(walk.strides) == round(30.0 / WALK.length_m)
    whole_s = WALK.heel_off_s + WALK.swing_s + WALK.strike_s + WALK.flat_s
    np.testing.assert_allclose([s.step.length_m for s in walk.strides], WALK.length_m, atol=0.005)
    np.testing.assert_allclose([s.duration_s for s in inner], whole_s, atol=0.011)
    np.testing.assert_allclose([s.cadence_per_min for s in inner], 120.0 / whole_s, rtol=0.011)
    np.testing.assert_allclose([s.speed_mps for s in inner], WALK.length_m / whole_s, rtol=0.015)


def test_the_foot_leaves_the_ground_and_comes_down_when_it_does(struck):
    """The simulated foot is tipped farthest a share of the swing after the toe has left the ground."""
    _, foot, walk = struck
    toe_off_s, strike_s = (np.array(walk.each(n)) / NANOSECONDS for n in ("toe_off_ns", "heel_strike_ns"))
    np.testing.assert_allclose(toe_off_s, tipped_s(foot, WALK.swing_s), atol=0.011)
    np.testing.assert_allclose(strike_s, foot.strikes_s, atol=0.011)
    np.testing.assert_allclose(walk.each("swing_s"), 0.85 * WALK.swing_s, atol=0.016)
    parts_s = np.array(walk.each("swing_s")[:-1]) + walk.each("stance_s")[:-1]
    np.testing.assert_allclose(parts_s, walk.each("duration_s")[:-1], atol=1e-9)


def test_clearance_and_pitch(straight):
    _, _, walk = straight
    np.testing.assert_allclose(walk.each("clearance_m"), WALK.lift_m, atol=0.003)
    np.testing.assert_allclose(walk.each("pitch_max_rad"), WALK.push_pitch_rad, atol=0.01)
    np.testing.assert_allclose(walk.each("pitch_min_rad"), WALK.strike_pitch_rad, atol=0.01)


def test_the_pitch_over_the_cycle(straight):
    sim, _, walk = straight
    stride = walk.strides[5]
    x, y, z, w = sim.motion.quat_xyzw.T
    pitch_rad = np.arcsin(np.clip(2.0 * (w * y - x * z), -1.0, 1.0))
    times_ns = np.linspace(stride.step.start_ns, stride.step.stamp_ns, CYCLE_POINTS)
    true_rad = np.interp(times_ns, sim.imu.stamp_ns, pitch_rad)
    np.testing.assert_allclose(stride.pitch_cycle_rad, true_rad, atol=0.01)
    assert stride.pitch_cycle_rad.max() == pytest.approx(stride.pitch_max_rad, abs=0.01)


def test_a_stride_that_ends_in_a_pause_has_no_duration(straight):
    *_, walk = straight
    last = walk.strides[-1]
    assert [last.duration_s, last.stance_s, last.speed_mps, last.cadence_per_min, last.pitch_cycle_rad] == [None] * 5
    assert last.swing_s > 0.0
    assert last.pitch_max_rad == pytest.approx(WALK.push_pitch_rad, abs=0.01)
    assert all(duration is not None for duration in walk.each("duration_s")[:-1])


def test_turns_are_those_of_the_walk_and_do_not_jump():
    sim, _ = smooth_walk("rectangle", walk_length_m=60.0)
    walk = analysed(sim.imu)
    turns = np.array(walk.each("turn_rad"))
    assert np.sum(turns) == pytest.approx(2.0 * np.pi, abs=0.02)
    assert np.count_nonzero(turns > 0.3) == 12
    changes = [c for c in walk.each("heading_change_rad") if c is not None]
    assert len(changes) == len(walk.strides) - 1
    assert np.abs(changes).max() < 0.6
    assert np.sum(changes) == pytest.approx(2.0 * np.pi - turns[0], abs=0.3)


def test_stairs_by_their_steps():
    sim, _ = smooth_walk("stairs", walk_length_m=28.0)
    walk = analysed(sim.imu)
    climbs = np.array([s.step.displacement_m[2] for s in walk.strides])
    up, down = walk.strides[10:19], walk.strides[-9:]
    assert np.count_nonzero(climbs > 0.08) == np.count_nonzero(climbs < -0.08) == 9
    np.testing.assert_allclose([s.step.displacement_m[2] for s in up], RISE_M, rtol=0.02)
    np.testing.assert_allclose([s.step.displacement_m[2] for s in down], -RISE_M, rtol=0.02)
    np.testing.assert_allclose([s.pitch_max_rad for s in up], STAIRS_UP.push_pitch_rad, atol=0.02)
    true_m = clearance_of_stairs_m(sim, up[4].step)
    assert up[4].clearance_m == pytest.approx(true_m, abs=0.01)


def clearance_of_stairs_m(sim, step):
    """How high the true foot goes above the line between both footfalls."""
    rows = slice(*np.searchsorted(sim.imu.stamp_ns, [step.start_ns, step.stamp_ns + 1]))
    place_m = sim.motion.position_m[rows]
    whole_m = place_m[-1] - place_m[0]
    share = np.clip((place_m - place_m[0])[:, :2] @ whole_m[:2] / (whole_m[:2] @ whole_m[:2]), 0.0, 1.0)
    return (place_m[:, 2] - place_m[0, 2] - share * whole_m[2]).max()


def test_a_run():
    sim, _ = smooth_walk("run", walk_length_m=45.0)
    walk = analysed(sim.imu)
    inner = walk.strides[1:-1]
    whole_s = RUN.heel_off_s + RUN.swing_s + RUN.strike_s + RUN.flat_s
    np.testing.assert_allclose([s.duration_s for s in inner], whole_s, atol=0.04)
    np.testing.assert_allclose([s.clearance_m for s in inner], RUN.lift_m, atol=0.02)
    np.testing.assert_allclose([s.pitch_max_rad for s in inner], RUN.push_pitch_rad, atol=0.03)


@pytest.mark.parametrize("mounting", [(3.1, 0.0, 0.0), (0.0, np.pi / 2.0, 0.3), (-1.2, 0.5, 2.0)])
def test_pitch_does_not_depend_on_the_mounting(mounting):
    """Upside down, with x straight down, and askew."""
    roll, pitch, yaw = mounting
    sim, _ = smooth_walk(mounting_roll_rad=roll, mounting_pitch_rad=pitch, mounting_yaw_rad=yaw)
    walk = analysed(sim.imu)
    assert len(walk.strides) == 21
    np.testing.assert_allclose(walk.each("pitch_max_rad"), WALK.push_pitch_rad, atol=0.015)
    np.testing.assert_allclose(walk.each("pitch_min_rad"), WALK.strike_pitch_rad, atol=0.015)
    np.testing.assert_allclose(walk.each("clearance_m"), WALK.lift_m, atol=0.01)


def test_steps_on_the_spot_have_turns_but_no_direction():
    walk = analysed(simulated_walk(SimulationParams(walk="rectangle", walk_length_m=20.0)).imu)
    spot = [s for s in walk.strides if s.step.length_m < 0.2]
    assert spot
    assert all(s.heading_change_rad is None for s in spot)
    assert np.sum(walk.each("turn_rad")) == pytest.approx(2.0 * np.pi, abs=0.05)


def without(imu, start_s, stop_s):
    """The samples outside of a time."""
    time_s = (imu.stamp_ns - imu.stamp_ns[0]) / NANOSECONDS
    rows = (time_s < start_s) | (time_s >= stop_s)
    return ImuBlock._make(column[rows] for column in imu)


def test_of_a_stride_with_a_gap_only_its_ends_are_known(straight):
    sim, foot, whole = straight
    walk = analysed(without(sim.imu, foot.strikes_s[9] - 0.3, foot.strikes_s[9] - 0.15))
    holed = [s for s in walk.strides if s.step.start_ns < (foot.strikes_s[9] - 0.2) * NANOSECONDS < s.step.stamp_ns]
    (stride,) = holed
    known = (stride.swing_s, stride.clearance_m, stride.pitch_max_rad, stride.toe_off_ns, stride.pitch_cycle_rad)
    assert known == (None,) * 5
    assert stride.duration_s == pytest.approx(whole.strides[9].duration_s, abs=0.05)
    others = [s for s in walk.strides[:-1] if s is not stride]
    assert all(s.swing_s and s.pitch_cycle_rad is not None for s in others)


def test_wherever_a_walk_is_cut_its_strides_are_the_same(straight):
    sim, _, whole = straight
    for cuts in (range(1, len(sim.imu.stamp_ns)), range(7, len(sim.imu.stamp_ns), 777)):
        cut = analysed(sim.imu, cuts)
        assert len(cut.strides) == len(whole.strides)
        for one, other in zip(cut.strides, whole.strides, strict=True):
            for a, b in zip(numbers(one), numbers(other), strict=True):
                np.testing.assert_array_equal(a, b)


def test_smoothed_walks_get_the_same_analysis(straight):
    sim, _, whole = straight
    chain, gait = SmoothedFoot(Params()), FootGait()
    chain.run(sim.imu)
    strides = [s for output in chain.finish() for s in gait.run(output)] + gait.finish()
    assert [s.step.index for s in strides] == [s.step.index for s in whole.strides]
    np.testing.assert_allclose([s.clearance_m for s in strides], WALK.lift_m, atol=0.003)
    np.testing.assert_allclose([s.pitch_min_rad for s in strides], WALK.strike_pitch_rad, atol=0.01)


def test_steps_that_were_said_by_nodes_are_found_by_their_stamps(straight):
    """They come before their samples and do not know their numbers."""
    sim, _, whole = straight
    output = FootInertial(Params()).run(sim.imu)
    steps = [replace(s.step, sample_numbers=NOT_NUMBERED) for s in whole.strides[:-1]]
    gait, half = FootGait(), len(sim.imu.stamp_ns) // 2
    first = gait.run(FootOutput(part(output.judged, 0, half), part(output.nav, 0, half), steps))
    strides = first + gait.run(FootOutput(part(output.judged, half), part(output.nav, half), [])) + gait.finish()
    for one, other in zip(strides, whole.strides, strict=False):
        for a, b in zip(numbers(one), numbers(other), strict=True):
            np.testing.assert_array_equal(a, b)
    assert len(strides) == len(steps)


def test_strides_wait_for_the_walking_direction_but_not_for_ever():
    """A walk along a tight circle never goes straight."""
    sim, _ = smooth_walk("curve", walk_length_m=16.0)
    imu = sim.imu
    walk = analysed(imu)
    assert walk.mounting is None
    assert walk.each("pitch_max_rad") == [None] * len(walk.strides)
    assert [n.kind for n in walk.notices] == ["no_mounting"]
    assert None not in walk.each("clearance_m")
    assert len(walk.strides) < WAITING

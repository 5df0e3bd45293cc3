"""A foot whose gyro is switched: one track without jumps, few strides with the gyro, the same however it is cut."""

from itertools import pairwise

import numpy as np
import pytest

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootAdaptive, FootInertial
from pdr_core.records import joined, length, part
from pdr_core.records_power import Mode
from pdr_core.simulation import simulated_walk

RATE_HZ = 100
CALIBRATION_M, WALK_M = 30.0, 120.0
PARAMS = changed(Params(), "power", calibration_m=CALIBRATION_M, examine_every_s=20.0)
WALK = simulated_walk(
    SimulationParams(motion="smooth", walk="straight", walk_length_m=WALK_M, sample_rate_hz=float(RATE_HZ))
)


def told(chain, pieces):
    """Return all estimates with their verdicts and all steps."""
    outputs = [*map(chain.run, pieces), chain.finish()]
    steps = [step for output in outputs for step in output.steps]
    return joined([o.judged for o in outputs]), joined([o.nav for o in outputs]), steps


@pytest.fixture(scope="module")
def walked():
    chain = FootAdaptive(PARAMS)
    return chain, *told(chain, [WALK.imu])


def test_the_gyro_is_on_for_l0_and_for_the_examinations_alone(walked):
    chain, _, _, _ = walked
    modes = [command.mode for command in chain.commands]
    assert modes[:4] == [Mode.INITIALISING, Mode.DEAD_RECKONING, Mode.EXAMINING, Mode.DEAD_RECKONING]
    assert set(modes) <= {Mode.INITIALISING, Mode.DEAD_RECKONING, Mode.EXAMINING, Mode.STANDING}
    assert 0.2 < chain.energy.gyro_on_share < 0.55
    assert chain.energy.sensor_saved_share > 0.35
    assert chain.energy.duration_s == pytest.approx(np.ptp(WALK.imu.stamp_ns) * 1e-9, abs=0.1)


def test_every_stride_is_there_once_and_as_long_as_it_is(walked):
    _, _, _, steps = walked
    _, _, with_gyro = told(FootInertial(Params()), [WALK.imu])
    assert len(steps) == len(with_gyro)
    assert [step.index for step in steps] == list(range(1, len(steps) + 1))
    assert sum(step.length_m for step in steps) == pytest.approx(WALK_M, rel=0.03)
    ends = np.array([step.stamp_ns for step in steps])
    assert (np.diff(ends) > 0).all()


def test_the_track_has_no_jump_and_no_gap_and_ends_where_the_walk_does(walked):
    _, judged, nav, _ = walked
    assert np.array_equal(judged.imu.stamp_ns, nav.stamp_ns)
    steps_s = np.diff(nav.stamp_ns) * 1e-9
    assert steps_s.min() > 0.0
    assert steps_s.max() < 0.1
    moved_m = np.linalg.norm(np.diff(nav.position_m[:, :2], axis=0), axis=1)
    fastest_mps = np.linalg.norm(np.diff(WALK.motion.position_m[:, :2], axis=0), axis=1).max() * RATE_HZ
    assert (moved_m / steps_s).max() < 1.3 * fastest_mps
    assert np.linalg.norm(nav.position_m[-1, :2] - WALK.motion.position_m[-1, :2]) < 0.05 * WALK_M
    assert all(np.isfinite(column).all() for column in nav)


@pytest.mark.parametrize("pieces", [3, 211])
def test_however_the_recording_is_cut_the_track_is_the_same(walked, pieces):
    chain, _, nav, steps = walked
    cuts = np.linspace(0, length(WALK.imu), pieces + 1).astype(int)
    again = FootAdaptive(PARAMS)
    _, cut_nav, cut_steps = told(again, [part(WALK.imu, a, b) for a, b in pairwise(cuts)])
    assert again.commands == chain.commands
    assert np.array_equal(cut_nav.position_m, nav.position_m)
    assert [step.stamp_ns for step in cut_steps] == [step.stamp_ns for step in steps]


def test_before_l0_it_is_the_filter_to_the_last_bit():
    _, nav, steps = told(FootAdaptive(changed(PARAMS, "power", calibration_m=1e4)), [WALK.imu])
    _, with_gyro, same = told(FootInertial(Params()), [WALK.imu])
    assert np.array_equal(nav.position_m, with_gyro.position_m)
    assert [s.stamp_ns for s in steps] == [s.stamp_ns for s in same]


def test_a_clock_that_jumps_back_while_the_gyro_is_off_costs_no_track():
    stamps = WALK.imu.stamp_ns.copy()
    stamps[60 * RATE_HZ :] -= 3600 * 1_000_000_000
    chain = FootAdaptive(PARAMS)
    _, nav, steps = told(chain, [WALK.imu._replace(stamp_ns=stamps)])
    assert all(np.isfinite(column).all() for column in nav)
    assert nav.stamp_ns[-1] == pytest.approx(stamps[-1], abs=2_000_000_000)
    assert sum(step.length_m for step in steps) == pytest.approx(WALK_M, rel=0.06)
    assert chain.commands[-1].stamp_ns < stamps[0]


def test_outdoors_turns_wake_the_gyro_and_the_field_tells_what_it_missed():
    walk = simulated_walk(
        SimulationParams(
            motion="smooth", walk="rectangle", walk_length_m=240.0, sample_rate_hz=float(RATE_HZ), magnetometer=True
        )
    )
    chain = FootAdaptive(changed(PARAMS, "power", examine_every_s=1000.0))
    _, nav, _ = told(chain, [walk.imu])
    assert Mode.SUSPICION in [command.mode for command in chain.commands]
    assert chain.energy.gyro_on_share < 0.5
    assert np.linalg.norm(nav.position_m[-1, :2] - walk.motion.position_m[-1, :2]) < 0.05 * 240.0


def test_a_heading_constraint_answers_strides_of_the_filter_and_those_that_are_reckoned():
    chain = FootAdaptive(changed(PARAMS, "heading", constraint="hde"))
    _, nav, steps = told(chain, [WALK.imu])
    assert np.isfinite(nav.pose_covariance).all()
    off_ns = next(command.stamp_ns for command in chain.commands if not command.gyro)
    by_filter = sum(step.stamp_ns < off_ns for step in steps)
    (held,) = (notice.count for notice in chain.notices if notice.kind == "heading_held")
    assert held > by_filter + 20
    free = told(FootAdaptive(PARAMS), [WALK.imu])[1]
    assert np.sqrt(nav.pose_covariance[-1, 5, 5]) < 0.7 * np.sqrt(free.pose_covariance[-1, 5, 5])

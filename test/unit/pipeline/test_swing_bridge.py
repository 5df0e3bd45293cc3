"""A gyro that sleeps while the foot stands: its rates are filled in, and the walk goes on as if it had not slept."""

from itertools import pairwise

import numpy as np
import pytest

from pdr_core.gait.stance_turns import LIFT_NS, carried, turned
from pdr_core.maths.quaternion import matrix, yaw_rad
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootAdaptive, FootInertial
from pdr_core.pipeline.swing_bridge import SwingBridge, share_per_s, widths_s
from pdr_core.power.motion_rule import motion_rule
from pdr_core.records import joined, length, part
from pdr_core.records_power import Mode
from pdr_core.simulation import simulated_walk

PARAMS = changed(Params(), "power", duty="swing", calibration_m=30.0)
WALK = simulated_walk(
    SimulationParams(motion="smooth", walk="rectangle", walk_length_m=100.0, sample_rate_hz=100.0, shock_mps2=60.0)
)


def told(chain, pieces):
    outputs = [*map(chain.run, pieces), chain.finish()]
    return joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps]


@pytest.fixture(scope="module")
def walked():
    chain = FootAdaptive(PARAMS)
    return chain, *told(chain, [WALK.imu])


def test_the_filter_navigates_on_and_misses_nothing(walked):
    chain, nav, steps = walked
    assert [command.mode for command in chain.commands] == [Mode.INITIALISING, Mode.SWINGS]
    with_gyro, all_steps = told(FootInertial(Params()), [WALK.imu])
    assert np.array_equal(nav.stamp_ns, with_gyro.stamp_ns)
    assert len(steps) == len(all_steps)
    assert np.linalg.norm(nav.position_m[-1] - with_gyro.position_m[-1]) < 1.5
    assert sum(s.length_m for s in steps) == pytest.approx(sum(s.length_m for s in all_steps), rel=0.015)
    assert np.isfinite(nav.pose_covariance).all()


def test_each_swing_costs_a_start(walked):
    chain, _, steps = walked
    swings = sum(step.stamp_ns > chain.commands[1].stamp_ns for step in steps)
    assert chain.energy.switch_ons == pytest.approx(swings, abs=3)
    assert chain.energy.start_up_mah > 0.0
    second = [s for s in chain.powered if s.stamp_ns > chain.commands[1].stamp_ns]
    on_ns = sum(b.stamp_ns - a.stamp_ns for a, b in pairwise(second) if a.gyro_on)
    assert 0.4 < on_ns / (second[-1].stamp_ns - second[0].stamp_ns) < 0.85


def test_however_the_recording_is_cut_the_track_is_the_same(walked):
    _, nav, steps = walked
    cuts = np.linspace(0, length(WALK.imu), 40).astype(int)
    cut_nav, cut_steps = told(FootAdaptive(PARAMS), [part(WALK.imu, a, b) for a, b in pairwise(cuts)])
    assert np.array_equal(cut_nav.position_m, nav.position_m)
    assert [s.stamp_ns for s in cut_steps] == [s.stamp_ns for s in steps]


def test_what_was_never_learnt_is_as_uncertain_as_can_be():
    bridge = SwingBridge(motion_rule(PARAMS.power))
    asleep = WALK.imu._replace(
        gyro_radps=np.zeros_like(WALK.imu.gyro_radps), gyro_sd_radps=np.full(length(WALK.imu), -1.0)
    )
    out = bridge.run(joined([part(WALK.imu, 0, 50), part(asleep, 50, 120), part(WALK.imu, 120, 140)]))
    assert not bridge.ready
    assert np.array_equal(out.stamp_ns, WALK.imu.stamp_ns[:140])
    lands, stands, leaves = out.gyro_sd_radps[50:54], out.gyro_sd_radps[71:90], out.gyro_sd_radps[96:120]
    assert min(lands.min(), leaves.min()) > 30.0
    assert 0.0 < stands.max() < 1.0


def test_a_share_is_whole_and_comes_at_its_mean_time():
    away_s = np.linspace(0.0, 0.25, 10001)
    share = share_per_s((away_s * 1e9).astype(np.int64), LIFT_NS, 0.07)
    assert np.trapezoid(share, away_s) == pytest.approx(1.0, rel=1e-3)
    assert np.trapezoid(share * away_s, away_s) == pytest.approx(0.07, rel=1e-3)


def test_turns_and_up_are_those_of_the_true_motion():
    rows = slice(400, 460)
    ideal = simulated_walk(
        SimulationParams(
            motion="smooth", walk="rectangle", walk_length_m=20.0, sample_rate_hz=100.0, sensor_model="ideal"
        )
    )
    imu, R = part(ideal.imu, rows.start, rows.stop), np.array([matrix(q) for q in ideal.motion.quat_xyzw[rows]])
    turn = matrix(np.array(turned(imu.stamp_ns, imu.gyro_radps, 0, length(imu) - 1)))
    assert R[0].T @ R[-1] == pytest.approx(turn, abs=5e-3)
    assert carried(R[0, 2], imu) == pytest.approx(R[-1, 2], abs=5e-3)


def test_trapezia_count_each_sample_for_half_of_both_intervals():
    three = part(WALK.imu, 10, 13)
    assert widths_s(part(three, 1, 3), part(three, 0, 1)) == pytest.approx([0.01, 0.005])
    assert widths_s(part(three, 0, 2), part(three, 2, 3)) == pytest.approx([0.005, 0.01])


def test_the_heading_of_a_straight_walk_is_kept():
    walk = simulated_walk(
        SimulationParams(motion="smooth", walk="straight", walk_length_m=80.0, sample_rate_hz=100.0, shock_mps2=60.0)
    )
    nav, _ = told(FootAdaptive(PARAMS), [walk.imu])
    assert abs(np.degrees(yaw_rad(nav.quat_xyzw[-1]) - yaw_rad(nav.quat_xyzw[0]))) < 6.0

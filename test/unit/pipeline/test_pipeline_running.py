"""A runner whose foot never stands for long: strides end in stands all the same, and the filter begins in them."""

from itertools import pairwise

import numpy as np
import pytest

from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.magnetic import azimuth_rad, level_field
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootAdaptive
from pdr_core.pipeline.gait_watch import GaitWatch
from pdr_core.records import joined, length, part
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import Mode
from pdr_core.simulation import simulated_walk
from pdr_core.simulation.walk import personal_strides

RATE_HZ = 100


def simulated(walk, length_m):
    """Outdoors, and an upright foot whose heading says where it goes."""
    return SimulationParams(
        motion="smooth", walk=walk, walk_length_m=length_m, sample_rate_hz=float(RATE_HZ), magnetometer=True
    )


def seen(imu, piece=25):
    watch, strides = GaitWatch(Params()), []
    for first, last in pairwise([*range(0, length(imu), piece), length(imu)]):
        strides += watch.run(part(imu, first, last)).strides
    return strides


@pytest.fixture(scope="module")
def run():
    return simulated_walk(simulated("octagon_run", 175.0))


def test_a_runners_strides_end_in_stands_that_show_his_heading(run):
    strides = [s for s in seen(run.imu) if s.step.behaviour is Behaviour.RUNNING]
    assert len(strides) > 70
    assert all(s.stand and s.stand.field_seen and s.stand.impulse_mps is None for s in strides)
    assert all(s.before and s.before.stamp_ns < s.stand.stamp_ns for s in strides)
    for s in strides[::5]:
        now = np.searchsorted(run.imu.stamp_ns, s.stand.stamp_ns)
        told = np.pi / 2.0 - azimuth_rad(np.array(level_field(s.stand.force_mps2, s.stand.field_tesla)))
        assert abs(wrapped_rad(told - yaw_rad(run.motion.quat_xyzw[now]))) < np.radians(4.0)


def test_the_long_time_until_a_runner_stands_again_is_no_swing(run):
    last = seen(run.imu)[-1]
    assert last.stand.impulse_mps is None  # it would be the sum over the whole run


def test_a_stand_that_a_low_rate_hides_is_there():
    """A quick walk, 20 times a second: the foot is still for too few samples to be seen."""
    walk = simulated_walk(
        SimulationParams(
            motion="smooth", walk="straight", walk_length_m=40.0, pace=1.4, sample_rate_hz=20.0, magnetometer=True
        )
    )
    strides = seen(walk.imu, 5)
    assert len(strides) == pytest.approx(29, abs=2)
    assert all(s.stand and s.stand.field_seen for s in strides)


@pytest.fixture(scope="module")
def walked_and_run():
    params = simulated("transitions", 210.0)
    walk = simulated_walk(params)
    told = changed(changed(Params(), "filter", initial_yaw_source="magnetometer"), "power", calibration_m=25.0)
    chain = FootAdaptive(told)
    outputs = [chain.run(walk.imu), chain.finish()]
    return params, walk, chain, joined([o.nav for o in outputs]), [s for o in outputs for s in o.steps]


def test_a_run_is_calibrated_and_reckoned_though_the_gyro_slept_when_it_began(walked_and_run):
    _, walk, chain, nav, _ = walked_and_run
    whole_m = walk.motion.position_m[-1, 0]
    assert np.linalg.norm(nav.position_m[-1, :2] - walk.motion.position_m[-1, :2]) < 0.02 * whole_m
    fast = np.linalg.norm(np.diff(walk.motion.position_m[::RATE_HZ, :2], axis=0), axis=1) > 2.0
    running_s = np.flatnonzero(fast)[[0, -1]]
    modes = [(c.stamp_ns * 1e-9, c.mode) for c in chain.commands]
    within = [mode for at_s, mode in modes if running_s[0] < at_s < running_s[1]]
    assert within[:2] == [Mode.INITIALISING, Mode.DEAD_RECKONING]
    assert Mode.SUSPICION not in within  # nobody knows a runner's push, but the field tells that he goes straight


def test_no_stride_is_counted_twice_where_dead_reckoning_takes_over(walked_and_run):
    params, _, _, nav, steps = walked_and_run
    assert len(steps) == len(personal_strides(params))
    assert min(step.stamp_ns - step.start_ns for step in steps) > 200_000_000
    assert (np.diff(nav.stamp_ns) > 0).all()

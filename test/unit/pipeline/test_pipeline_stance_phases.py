"""Two passes over a recording, and detectors without a gyro, through the whole chain."""

import numpy as np
import pytest

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial, stance_phases
from pdr_core.records import length, part
from pdr_core.simulation import simulated_walk
from support.walks import walk_with_dips

WALK = simulated_walk(SimulationParams(walk="straight", walk_length_m=18.0), start_ns=10**18)


@pytest.fixture(scope="module")
def deceiving():
    return walk_with_dips(15)


def standing(imu, params, phases_s=None):
    chain = FootInertial(params, phases_s=phases_s)
    outputs = [chain.run(imu), chain.finish()]
    return np.concatenate([o.judged.stance for o in outputs]), sum(len(o.steps) for o in outputs)


def test_a_first_pass_tells_the_gate_what_it_would_learn_too_late(deceiving):
    imu, dips = deceiving
    gated = changed(changed(Params(), "stance", time_gate="kmeans"), "intake", clip_smallest_radps=1e6)
    pieces = [part(imu, a, a + 500) for a in range(0, length(imu), 500)]
    phases_s = stance_phases(pieces, gated)
    assert len(phases_s) == 2 * 15 - 1  # a dip in each stride; not the rest before it, not the one after the last
    online, _ = standing(imu, gated)
    offline, strides = standing(imu, gated, phases_s)
    assert online[dips].any()
    assert not offline[dips].any()
    assert strides == 15


@pytest.mark.parametrize("detector", ["acceleration_moving_variance", "acceleration_magnitude", "mbgtd"])
def test_a_foot_that_stands_is_held_without_the_gyro(detector):
    off = WALK.imu._replace(gyro_radps=WALK.imu.gyro_radps * 0.0, gyro_sd_radps=np.full(length(WALK.imu), -1.0))
    chain = FootInertial(changed(Params(), "stance", detector=detector))
    nav = chain.run(part(off, 0, 400)).nav
    assert np.isfinite(nav.position_m).all()
    assert np.linalg.norm(nav.velocity_mps[-1]) < 0.01
    assert np.sqrt(nav.twist_covariance[-1, 0, 0]) < 0.1

"""A world turned by any yaw turns the result, and nothing else."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import joined
from pdr_core.simulation import simulated_walk

WALK = simulated_walk(SimulationParams(motion="smooth", walk="curve", walk_length_m=17.0, sample_rate_hz=100.0))
ABSOLUTE = 1e-9


def tracked(yaw_rad, samples):
    chain = FootInertial(changed(Params(), "filter", initial_yaw_rad=yaw_rad, samples=samples))
    outputs = [chain.run(WALK.imu), chain.finish()]
    return joined([o.nav for o in outputs]), [step for o in outputs for step in o.steps]


STRAIGHT = {samples: tracked(0.0, samples) for samples in ("points", "means", "averages")}


@pytest.mark.parametrize("samples", STRAIGHT)
@given(yaw_rad=st.floats(-3.14, 3.14))
@settings(max_examples=15)
def test_the_world_turned_by_any_yaw_turns_the_result(samples, yaw_rad):
    (nav, steps), (before, steps_before) = tracked(yaw_rad, samples), STRAIGHT[samples]
    turn = Rotation.from_euler("z", yaw_rad)
    R, RR = turn.as_matrix(), np.kron(np.eye(2), turn.as_matrix())
    np.testing.assert_allclose(nav.position_m, before.position_m @ R.T, atol=ABSOLUTE)
    expected = turn * Rotation.from_quat(before.quat_xyzw)
    assert (Rotation.from_quat(nav.quat_xyzw).inv() * expected).magnitude().max() < ABSOLUTE
    np.testing.assert_allclose(nav.velocity_mps, before.velocity_mps, atol=ABSOLUTE)
    np.testing.assert_allclose(nav.pose_covariance, RR @ before.pose_covariance @ RR.T, rtol=1e-6, atol=ABSOLUTE)
    np.testing.assert_allclose(nav.twist_covariance, before.twist_covariance, rtol=1e-6, atol=ABSOLUTE)
    assert len(steps) == len(steps_before) > 5
    for step, other in zip(steps, steps_before, strict=True):
        assert step.stamp_ns == other.stamp_ns
        np.testing.assert_allclose(step.displacement_m, R @ other.displacement_m, atol=ABSOLUTE)
        turned = R @ other.displacement_covariance_m2 @ R.T
        np.testing.assert_allclose(step.displacement_covariance_m2, turned, rtol=1e-6, atol=ABSOLUTE)
        assert np.cos(step.yaw_rad - other.yaw_rad - yaw_rad) > 1.0 - 1e-15

"""The whole chain, smoothed, against the truth of simulated walks and against the filter."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.conventions import NANOSECONDS
from pdr_core.evaluation.metrics import path_length_m
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial, SmoothedFoot
from pdr_core.records import NO_SAMPLES, joined, part
from pdr_core.simulation import simulated_walk
from support.walks import straight_walk


def filtered(imu, params):
    chain = FootInertial(params)
    outputs = [chain.run(imu), chain.finish()]
    return joined([out.nav for out in outputs]), [step for out in outputs for step in out.steps]


def smoothed(imu, params):
    chain = SmoothedFoot(params)
    chain.run(imu)
    outputs = list(chain.finish())
    return joined([out.nav for out in outputs]), [step for out in outputs for step in out.steps]


@pytest.fixture(scope="module")
def walk():
    imu = straight_walk(10, 200.0).imu
    return filtered(imu, Params()), smoothed(imu, Params())


@pytest.mark.parametrize("motion", ["gui", "smooth"])
def test_a_walk_without_noise_returns_the_truth(motion):
    sim = simulated_walk(
        SimulationParams(
            motion=motion, walk="rectangle", walk_length_m=60.0, sample_rate_hz=100.0, sensor_model="ideal"
        )
    )
    nav, _ = smoothed(sim.imu, Params())
    error = np.linalg.norm(nav.position_m - sim.motion.position_m, axis=1)
    assert error[-1] < 0.0005 * path_length_m(sim.motion.position_m)
    assert np.sqrt(np.mean(error**2)) < 0.0005 * path_length_m(sim.motion.position_m)


def test_the_steps_are_those_of_the_filter_and_lie_on_the_smoothed_track(walk):
    (nav, before), (smooth_nav, after) = walk
    np.testing.assert_array_equal(smooth_nav.stamp_ns, nav.stamp_ns)
    assert len(after) == 10
    assert [(s.index, s.start_ns, s.stamp_ns) for s in after] == [(s.index, s.start_ns, s.stamp_ns) for s in before]
    for step in after:
        start, end = np.searchsorted(nav.stamp_ns, [step.start_ns, step.stamp_ns])
        np.testing.assert_array_equal(step.position_m, smooth_nav.position_m[end])
        np.testing.assert_array_equal(step.displacement_m, smooth_nav.position_m[end] - smooth_nav.position_m[start])
        assert step.yaw_rad == pytest.approx(Rotation.from_quat(smooth_nav.quat_xyzw[end]).as_euler("ZYX")[0])
        assert step.yaw_sd_rad == pytest.approx(np.sqrt(smooth_nav.pose_covariance[end, 5, 5]))


def test_a_displacement_is_at_least_as_certain_as_by_the_filter(walk):
    (_, before), (_, after) = walk
    for old, new in zip(before, after, strict=True):
        assert (np.linalg.eigvalsh(new.displacement_covariance_m2) > 0.0).all()
        assert np.trace(new.displacement_covariance_m2) < np.trace(old.displacement_covariance_m2)


def test_steps_keep_their_samples_where_the_clock_jumps_back():
    imu = straight_walk(10, 100.0).imu
    stamp_ns = imu.stamp_ns.copy()
    stamp_ns[750:] -= 4_000_000_000  # half of the stamps come twice
    _, steps = smoothed(imu._replace(stamp_ns=stamp_ns), Params())
    assert len(steps) == len(filtered(imu._replace(stamp_ns=stamp_ns), Params())[1])
    lengths = [s.length_m for s in steps if s.start_ns < s.stamp_ns]
    assert len(lengths) >= 8
    np.testing.assert_allclose(lengths, 1.2, atol=0.3)


def test_steps_that_wait_for_answers_are_smoothed_alike(walk):
    _, (nav, steps) = walk
    asking = changed(Params(), "filter", heading_feedback=True)
    same_nav, same_steps = smoothed(straight_walk(10, 200.0).imu, asking)
    np.testing.assert_array_equal(same_nav.position_m, nav.position_m)
    np.testing.assert_array_equal([s.position_m for s in same_steps], [s.position_m for s in steps])


@pytest.mark.parametrize("count", [0, 1, 5])
def test_hardly_any_sample(count):
    chain = SmoothedFoot(Params())
    chain.run(NO_SAMPLES)
    chain.run(part(straight_walk(1).imu, 0, count))
    assert sum(len(out.nav.stamp_ns) for out in chain.finish()) == count


def test_a_displacement_keeps_a_covariance_where_the_tilt_was_lost():
    sim = simulated_walk(SimulationParams(motion="smooth", walk_length_m=24.0, sample_rate_hz=200.0))
    n = len(sim.imu.stamp_ns)
    stamp_ns, gyro_sd, rate = sim.imu.stamp_ns.copy(), sim.imu.gyro_sd_radps.copy(), sim.imu.gyro_radps.copy()
    stamp_ns[n // 3 + 40 :] += 60 * NANOSECONDS
    off = slice(2 * n // 3, 2 * n // 3 + 500)
    gyro_sd[off], rate[off] = -1.0, 0.0
    _, steps = smoothed(sim.imu._replace(stamp_ns=stamp_ns, gyro_sd_radps=gyro_sd, gyro_radps=rate), Params())
    assert len(steps) > 5
    assert min(np.linalg.eigvalsh(step.displacement_covariance_m2)[0] for step in steps) > 0.0


def test_stairs_stay_stairs_where_floors_are_tied_and_smoothed():
    level = changed(Params(), "filter", level_ground=True)
    imu = simulated_walk(SimulationParams(motion="smooth", walk="stairs", sample_rate_hz=100.0)).imu
    (_, before), (_, after) = filtered(imu, level), smoothed(imu, level)
    assert [s.position_m[2] for s in after] == [s.position_m[2] for s in before]
    assert [s.displacement_covariance_m2[2, 2] for s in after] == [s.displacement_covariance_m2[2, 2] for s in before]
    assert max(s.position_m[2] for s in after) > 0.5

import copy

import numpy as np
import pytest
from filter_cases import error_of, judged, random_state, standing
from scipy.spatial.transform import Rotation

from pdr_core.eskf import ZuptFilter
from pdr_core.eskf.output import empty_nav, write
from pdr_core.eskf.updates import inject
from pdr_core.intake import Ingestion
from pdr_core.maths import quaternion
from pdr_core.params import Params, PlaceParams, SimulationParams, changed
from pdr_core.records import FilterMode, Handover, PoseEstimate, joined, part
from pdr_core.simulation import simulated_walk

PARAMS = Params()
WALK = simulated_walk(SimulationParams(walk="straight", walk_length_m=12.0), start_ns=10**18)
JUDGED = judged(Ingestion(PARAMS.intake).run(WALK.imu), WALK.motion.stance)
STANCE_ENDS = np.flatnonzero(WALK.motion.stance[:-1] & ~WALK.motion.stance[1:])


def fresh(**filter_params):
    return ZuptFilter(changed(PARAMS, "filter", **filter_params).filter, PlaceParams())


def world_velocity(nav):
    return Rotation.from_quat(nav.quat_xyzw).apply(nav.velocity_mps)


def kicked(f, velocity=(0.0, 0.0, 0.0), turn=(0.0, 0.0, 0.0)):
    error = np.zeros(15)
    error[3:6], error[6:9] = velocity, turn
    inject(f.state, error)


@pytest.mark.parametrize("at", [1000, 1150, 1250])
@pytest.mark.parametrize(("velocity", "strides"), [((5.0, 0.0, 0.0), 2), ((0.0, 0.0, 50.0), 2), ((1.0, -1.0, 1.0), 3)])
def test_a_filter_with_a_wrong_velocity_comes_back_within_some_strides(at, velocity, strides):
    f = fresh()
    before, _ = f.run(part(JUDGED, 0, at))
    kicked(f, velocity)
    nav = joined([before, f.run(part(JUDGED, at))[0]])
    back, *later = STANCE_ENDS[at < STANCE_ENDS][strides - 1 :]
    assert np.linalg.norm(world_velocity(nav)[[back, *later]], axis=1).max() < 0.015
    step = nav.position_m[later[-1]] - nav.position_m[back]
    np.testing.assert_allclose(step, (WALK.motion.position_m[later[-1]] - WALK.motion.position_m[back]), atol=0.5)
    assert f.health.quality > 0.8


@pytest.mark.parametrize(("tilt_rad", "strides"), [(0.2, 2), (1.0, 1), (3.0, 1)])
def test_a_filter_with_a_wrong_tilt_levels_itself_within_some_strides(tilt_rad, strides):
    f = fresh()
    before, _ = f.run(part(JUDGED, 0, 1000))
    kicked(f, turn=(tilt_rad, 0.0, 0.0))
    nav = joined([before, f.run(part(JUDGED, 1000))[0]])
    ends = STANCE_ENDS[STANCE_ENDS > 1000][strides - 1 :]
    up = Rotation.from_quat(nav.quat_xyzw[ends]).inv().apply([0, 0, 1])
    assert np.arccos(up[:, 2].clip(-1, 1)).max() < 0.02


@pytest.mark.parametrize("column", ["accel_mps2", "gyro_radps"])
@pytest.mark.parametrize("value", [100.0, 1000.0, 1e5])
def test_one_mad_sample_does_not_lose_the_rest_of_the_walk(column, value):
    imu = WALK.imu._replace(**{column: getattr(WALK.imu, column).copy()})
    getattr(imu, column)[700] = value
    nav, _ = fresh().run(judged(Ingestion(PARAMS.intake).run(imu), WALK.motion.stance))
    ends = STANCE_ENDS[STANCE_ENDS > 700][2:]
    assert np.linalg.norm(world_velocity(nav)[ends], axis=1).max() < 0.01


@pytest.mark.parametrize("samples", ["points", "means", "averages"])
@pytest.mark.parametrize("walk", ["straight", "stairs", "mixed"])
@pytest.mark.parametrize("noise", [1.0, 0.01])
def test_every_covariance_of_a_walk_is_symmetric_and_positive(walk, samples, noise):
    """A sensor that seems far too good is the hardest for a covariance."""
    sim = simulated_walk(SimulationParams(motion="smooth", walk=walk, walk_length_m=20.0, sample_rate_hz=100.0))
    densities = {name: noise * getattr(PARAMS.intake, name) for name in ("gyro_noise_density", "accel_noise_density")}
    imu = Ingestion(changed(PARAMS, "intake", **densities).intake).run(sim.imu)
    block, f = judged(imu, sim.motion.stance), fresh(samples=samples)
    for i in range(len(sim.motion.stance)):
        nav, _ = f.run(part(block, i, i + 1))
        sd = np.sqrt(np.diag(f.state.P))
        assert np.array_equal(f.state.P, f.state.P.T)
        assert np.linalg.eigvalsh(f.state.P / np.outer(sd, sd))[0] > 0.0
        for covariance in (nav.pose_covariance[0], nav.twist_covariance[0]):
            np.testing.assert_allclose(covariance, covariance.T, atol=1e-12 * covariance.max())
            assert np.linalg.eigvalsh(covariance)[0] > 0.0


def test_every_step_of_a_walk_has_a_positive_covariance():
    _, steps = fresh().run(JUDGED)
    assert len(steps) == 9
    assert min(np.linalg.eigvalsh(s.displacement_covariance_m2)[0] for s in steps) > 0.0


def test_two_hours_of_standing_and_walking_keep_the_covariance_positive():
    walk = simulated_walk(SimulationParams(walk="rectangle", walk_length_m=30.0, sample_rate_hz=50.0))
    n = len(walk.imu.stamp_ns)
    block = judged(Ingestion(PARAMS.intake).run(walk.imu), walk.motion.stance)
    rest = judged(Ingestion(PARAMS.intake).run(part(walk.imu, 0, 100)), np.ones(100, bool))
    f, stamp_ns, ends = fresh(), 0, 0
    while stamp_ns < 7200 * 10**9:
        for piece, count in ((block, n), (rest, 100), (rest, 100)):
            stamps = stamp_ns + np.arange(1, count + 1, dtype=np.int64) * 20_000_000
            nav, steps = f.run(piece._replace(imu=piece.imu._replace(stamp_ns=stamps)))
            stamp_ns, ends = int(stamps[-1]), ends + len(steps)
        assert np.isfinite(nav.pose_covariance).all()
        assert np.array_equal(f.state.P, f.state.P.T)
        scaled = f.state.P / np.sqrt(np.outer(np.diag(f.state.P), np.diag(f.state.P)))
        assert np.linalg.eigvalsh(scaled)[0] > 0.0
    assert ends > 1000
    assert f.state.contradicted < 0.01 * f.state.accepted


def test_the_twist_covariance_is_that_of_the_velocity_in_the_foot_frame():
    rng = np.random.default_rng(3)
    state = random_state(rng)
    state.P[3:9, 3:9] *= 1e-4
    state.P[:] = np.where(np.eye(15, dtype=bool), state.P, 0.0)
    state.P[3:9, 3:9] = 1e-5 * (np.eye(6) + 0.5)
    nav = empty_nav(1)
    write(nav, 0, state)
    draws, foot = rng.multivariate_normal(np.zeros(15), state.P, 20_000), np.empty((20_000, 3))
    attitude = Rotation.from_rotvec(draws[:, 6:9]) * Rotation.from_quat(state.quat_xyzw)
    foot = attitude.inv().apply(state.velocity_mps + draws[:, 3:6])
    expected = np.cov(foot.T)
    scale = np.abs(expected).max()
    np.testing.assert_allclose(nav.twist_covariance[0, :3, :3], expected, atol=0.04 * scale)
    np.testing.assert_allclose(nav.velocity_mps[0], foot.mean(0), atol=0.01)
    np.testing.assert_allclose(nav.pose_covariance[0][3:, 3:], state.P[6:9, 6:9])
    np.testing.assert_allclose(nav.rate_radps[0], state.last_rate_radps - state.gyro_bias_radps)


def test_the_foot_is_levelled_by_the_first_moments():
    imu = standing(0.5)
    imu.accel_mps2[:] = Rotation.from_euler("xyz", [0.4, -0.3, 0.0]).inv().apply([0, 0, 9.81])
    f = fresh(initial_yaw_rad=1.0)
    nav, _ = f.run(judged(imu, np.ones(100, bool)))
    expected = Rotation.from_euler("xyz", [0.4, -0.3, 1.0])
    assert (Rotation.from_quat(nav.quat_xyzw[-1]).inv() * expected).magnitude() < 1e-6
    assert f.health.mode is FilterMode.NAVIGATING


@pytest.mark.parametrize("start_ns", [-50 * 10**9, 0, 10**18])
def test_alignment_ends_whatever_the_clock_shows(start_ns):
    f = fresh()
    f.run(judged(standing(0.2, start_ns=start_ns), np.ones(40, bool)))
    assert f.health.mode is FilterMode.NAVIGATING


def test_alignment_ends_when_the_clock_jumps_back_in_it():
    f = fresh()
    f.run(judged(standing(0.02, start_ns=10**15), np.ones(4, bool)))
    f.run(judged(standing(0.2), np.ones(40, bool)))
    assert f.health.mode is FilterMode.NAVIGATING


def test_a_clock_that_jumps_back_does_not_lock_the_gate_nor_raise_the_quality():
    f = fresh()
    f.run(judged(standing(1.0, start_ns=10**15), np.ones(200, bool)))
    f.state.contradicted_s = 0.05
    f.run(judged(standing(0.1), np.zeros(20, bool)))
    assert 0.0 <= f.health.quality <= 1.0
    assert 0.0 <= f.health.since_zero_velocity_s < 1.0
    kicked(f, velocity=(50.0, 0.0, 0.0))
    f.run(judged(standing(1.0, start_ns=10**8), np.ones(200, bool)))
    assert np.linalg.norm(f.state.velocity_mps) < 0.1


def test_a_gap_is_coasted():
    f = fresh()
    f.run(part(JUDGED, 0, 700))
    position = f.state.position_m.copy()
    late = part(JUDGED, 700, 701)
    f.run(late._replace(imu=late.imu._replace(stamp_ns=late.imu.stamp_ns + 10**9)))
    np.testing.assert_array_equal(f.state.position_m, position)
    assert not f.state.velocity_mps.any()
    assert f.health.mode is FilterMode.COASTING
    assert [(n.kind, n.count) for n in f.notices] == [("coasted", 1)]


def pose(yaw=None, sd=0.1):
    quat = None if yaw is None else np.array(quaternion.from_euler(0.0, 0.0, yaw))
    return PoseEstimate(np.array([1.0, 2.0, 3.0]), quat, np.eye(6) * sd**2)


def start(f, pose, keep_biases):
    return Handover(0, pose, f.handover.biases if keep_biases else None)


@pytest.mark.parametrize("keep_biases", [True, False])
def test_a_reset_starts_anew_at_the_pose(keep_biases):
    f = fresh()
    f.run(part(JUDGED, 0, 900))
    bias, sd = f.health.accel_bias_mps2, f.health.accel_bias_sd_mps2
    f.reset(start(f, pose(yaw=2.0), keep_biases))
    f.run(judged(standing(0.05), np.ones(10, bool)))
    np.testing.assert_array_equal(f.state.position_m, [1.0, 2.0, 3.0])
    assert quaternion.yaw_rad(f.state.quat_xyzw) == pytest.approx(2.0)
    assert f.health.yaw_sd_rad == pytest.approx(0.1)
    np.testing.assert_allclose(f.health.accel_bias_mps2, bias if keep_biases else 0.0)
    np.testing.assert_allclose(f.health.accel_bias_sd_mps2, sd if keep_biases else 0.02)


@pytest.mark.parametrize("keep_biases", [True, False])
def test_a_reset_that_keeps_the_biases_levels_without_them_and_keeps_the_gravity(keep_biases):
    f = fresh()
    f.run(part(JUDGED, 0, 900))
    f.state.accel_bias_mps2[:] = bias = np.array([0.3, -0.2, 0.0])
    gravity_mps2 = f.health.gravity_mps2
    f.reset(start(f, pose(yaw=0.0), keep_biases))
    pushed = judged(standing(0.05), np.ones(10, bool))
    pushed.imu.accel_mps2[:] += bias + np.array([0.0, 0.0, 0.2])
    f.run(pushed)
    tilt_rad = np.arccos(Rotation.from_quat(f.state.quat_xyzw).as_matrix()[2, 2])
    assert tilt_rad == pytest.approx(0.0 if keep_biases else 0.036, abs=1e-3)
    assert (f.health.gravity_mps2 == gravity_mps2) is keep_biases


def test_a_heading_that_nobody_asked_for_turns_the_track():
    f = fresh()
    f.run(part(JUDGED, 0, 900))
    yaw_rad, sd_rad = quaternion.yaw_rad(f.state.quat_xyzw), f.health.yaw_sd_rad
    f.take_heading(0.01, sd_rad)
    assert quaternion.yaw_rad(f.state.quat_xyzw) == pytest.approx(yaw_rad - 0.005, abs=1e-4)
    assert f.health.yaw_sd_rad == pytest.approx(sd_rad / np.sqrt(2.0), rel=1e-3)


def test_a_reset_that_forgets_the_biases_forgets_those_kept_before():
    f = fresh()
    f.run(part(JUDGED, 0, 900))
    f.reset(start(f, pose(), True))
    f.run(judged(standing(0.5), np.ones(100, bool)))
    f.reset(start(f, pose(), False))
    f.run(judged(standing(0.05), np.ones(10, bool)))
    np.testing.assert_allclose(f.health.gyro_bias_sd_radps, 0.0035)


def test_a_reset_before_the_first_sample_and_two_in_a_row_keep_the_biases_open():
    f = fresh()
    f.reset(start(f, pose(), True))
    f.reset(start(f, pose(), True))
    f.run(judged(standing(0.05), np.ones(10, bool)))
    np.testing.assert_allclose(f.health.gyro_bias_sd_radps, 0.0035)


def test_a_copy_goes_on_like_the_original():
    f = fresh()
    f.run(part(JUDGED, 0, 1234))
    other = copy.deepcopy(f)
    (a, _), (b, _) = f.run(part(JUDGED, 1234)), other.run(part(JUDGED, 1234))
    for x, y in zip(a, b, strict=True):
        np.testing.assert_array_equal(x, y)
    assert np.abs(error_of(f.state, other.state)).max() == 0.0

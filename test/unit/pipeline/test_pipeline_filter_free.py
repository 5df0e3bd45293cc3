"""The filter-free method as a whole, on simulated walks."""

import itertools

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.attitude import QuaternionFilter
from pdr_core.eskf import ZuptFilter
from pdr_core.intake import Ingestion
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline.filter_free import FilterFree, known_orientation
from pdr_core.records import joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.stance import StanceDetection

PARAMS = Params()
WALK = SimulationParams(motion="smooth", walk="rectangle", walk_length_m=16.0, sample_rate_hz=200.0)
IDEAL = simulated_walk(SimulationParams(**{**WALK.__dict__, "sensor_model": "ideal"}))


def judged_by(raw):
    intake, stance = Ingestion(PARAMS.intake), StanceDetection(PARAMS.stance, PARAMS.place)
    return joined([stance.run(intake.run(raw)), stance.run(intake.finish()), stance.finish()])


def run(judged, attitude, params=PARAMS, pieces=()):
    chain, ends = FilterFree(params), [0, *pieces, length(judged)]
    outputs = [chain.run(part(judged, a, b), part(attitude, a, b)) for a, b in itertools.pairwise(ends)]
    outputs.append(chain.finish())
    nav, judged_out, track = (joined([getattr(o, name) for o in outputs]) for name in ("nav", "judged", "track"))
    assert np.array_equal(nav.stamp_ns, judged_out.imu.stamp_ns)
    return nav, [s for o in outputs for s in o.steps], track, chain


JUDGED = judged_by(IDEAL.imu)
TRUE_ATTITUDE = known_orientation(JUDGED.imu.stamp_ns, IDEAL.motion.quat_xyzw)
PATH_M = float(np.linalg.norm(np.diff(IDEAL.motion.position_m, axis=0), axis=1).sum())


def test_without_noise_and_with_the_true_orientation_it_is_the_truth():
    nav, *_ = run(JUDGED, TRUE_ATTITUDE)
    offset = nav.position_m[0] - IDEAL.motion.position_m[0]
    error_m = np.linalg.norm(nav.position_m - IDEAL.motion.position_m - offset, axis=1)
    assert error_m.max() < 0.004 * PATH_M
    velocity = Rotation.from_quat(IDEAL.motion.quat_xyzw).inv().apply(IDEAL.motion.velocity_mps)
    assert np.sqrt(np.mean((nav.velocity_mps - velocity) ** 2)) < 0.02


def test_with_the_quaternion_filter_it_is_nearly_as_good():
    nav, *_ = run(JUDGED, QuaternionFilter(PARAMS).run(JUDGED))
    assert np.linalg.norm(nav.position_m[-1] - IDEAL.motion.position_m[-1]) < 0.006 * PATH_M


def test_steps_are_those_of_the_error_state_filter():
    _, steps, *_ = run(JUDGED, TRUE_ATTITUDE)
    filtered = ZuptFilter(PARAMS.filter, PARAMS.place)
    _, expected = filtered.run(JUDGED)
    expected += filtered.finish()
    assert len(steps) == len(expected) > 10
    for one, other in zip(steps, expected, strict=True):
        assert one.index == other.index
        assert abs(one.stamp_ns - other.stamp_ns) < 60_000_000
        np.testing.assert_allclose(one.displacement_m, other.displacement_m, atol=0.02)
        assert np.linalg.eigvalsh(one.displacement_covariance_m2).min() > 0.0


def test_cutting_within_a_stance_that_cannot_be_changes_nothing():
    """What has been looked at must not be counted again."""
    judged = JUDGED._replace(stance=JUDGED.stance.copy(), zero_velocity_sd_mps=np.full(length(JUDGED), 0.01))
    lifts = np.flatnonzero(np.diff(JUDGED.stance.astype(int)) == -1)
    middle = int(lifts[3]) + 60
    judged.stance[middle : middle + 18] = True
    whole = run(judged, TRUE_ATTITUDE)
    cut = run(judged, TRUE_ATTITUDE, pieces=range(middle - 5, middle + 25))
    assert not whole[2].stands[middle : middle + 18].any()
    np.testing.assert_array_equal(whole[0].position_m, cut[0].position_m)


@pytest.mark.parametrize("pieces", [(5,), (1000, 1001, 1003), tuple(range(7, 4600, 211))])
def test_cutting_anywhere_changes_nothing(pieces):
    attitude = QuaternionFilter(PARAMS).run(JUDGED)
    whole, cut = run(JUDGED, attitude), run(JUDGED, attitude, pieces=pieces)
    for one, other in zip((*whole[0], *whole[2]), (*cut[0], *cut[2]), strict=True):
        np.testing.assert_array_equal(one, other)
    assert [s.stamp_ns for s in whole[1]] == [s.stamp_ns for s in cut[1]]


def test_a_turned_world_turns_the_track():
    turn = Rotation.from_euler("z", 1.1)
    turned = known_orientation(JUDGED.imu.stamp_ns, (turn * Rotation.from_quat(IDEAL.motion.quat_xyzw)).as_quat())
    nav, *_ = run(JUDGED, TRUE_ATTITUDE)
    nav_turned, *_ = run(JUDGED, turned)
    np.testing.assert_allclose(nav_turned.position_m, turn.apply(nav.position_m), atol=1e-9)
    np.testing.assert_allclose(nav_turned.velocity_mps, nav.velocity_mps, atol=1e-9)


def test_later_stamps_shift_nothing():
    late = JUDGED._replace(imu=JUDGED.imu._replace(stamp_ns=JUDGED.imu.stamp_ns + 10**18))
    nav, *_ = run(late, TRUE_ATTITUDE._replace(stamp_ns=late.imu.stamp_ns))
    np.testing.assert_array_equal(nav.position_m, run(JUDGED, TRUE_ATTITUDE)[0].position_m)


def test_a_gap_and_an_end_in_mid_swing_are_told_and_leave_no_nan():
    moving = np.flatnonzero(~JUDGED.stance)
    gap, end = int(moving[300]), int(moving[-40])
    kept = np.r_[0:gap, gap + 400 : end]
    judged = type(JUDGED)(type(JUDGED.imu)(*(c[kept] for c in JUDGED.imu)), *(c[kept] for c in JUDGED[1:]))
    nav, _, _, chain = run(judged, known_orientation(judged.imu.stamp_ns, IDEAL.motion.quat_xyzw[kept]))
    assert length(nav) == len(kept)
    assert all(np.isfinite(column).all() for column in nav)
    assert [notice.kind for notice in chain.notices] == ["swing_open"]
    sd_m = np.sqrt(nav.pose_covariance[:, 0, 0])
    assert sd_m[gap + 5] > sd_m[gap - 5] + 1.0


def test_the_gyro_that_was_off_is_a_gap():
    judged = JUDGED._replace(imu=JUDGED.imu._replace(gyro_sd_radps=JUDGED.imu.gyro_sd_radps.copy()))
    middle = int(np.flatnonzero(~JUDGED.stance)[300])
    judged.imu.gyro_sd_radps[middle : middle + 3] = -1.0
    nav, _, track, _ = run(judged, TRUE_ATTITUDE)
    assert not track.closed[middle]
    assert all(np.isfinite(column).all() for column in nav)


def test_an_unsure_yaw_makes_the_far_end_unsure_across_the_way():
    n = length(JUDGED)
    unsure = TRUE_ATTITUDE._replace(attitude_covariance=np.tile(np.diag([0.0, 0.0, 0.05**2]), (n, 1, 1)))
    straight = simulated_walk(SimulationParams(**{**WALK.__dict__, "walk": "straight", "sensor_model": "ideal"}))
    judged = judged_by(straight.imu)
    m = length(judged)
    sure = known_orientation(judged.imu.stamp_ns, straight.motion.quat_xyzw)
    unsure = sure._replace(attitude_covariance=np.tile(np.diag([0.0, 0.0, 0.05**2]), (m, 1, 1)))
    grown = run(judged, unsure)[0].pose_covariance[-1] - run(judged, sure)[0].pose_covariance[-1]
    walked_m = straight.motion.position_m[-1, 0]
    assert grown[1, 1] == pytest.approx((0.05 * walked_m) ** 2, rel=0.05)
    assert abs(grown[0, 0]) < 1e-3 * grown[1, 1]


def test_the_paper_as_it_is():
    params = changed(changed(PARAMS, "dedrift", drift="steady", stance_sd_mps=10.0), "filter", contact_height_m=0.0)
    nav, steps, track, _ = run(JUDGED, TRUE_ATTITUDE, params)
    assert np.all(nav.velocity_mps[track.stands] == 0.0)
    assert np.linalg.norm(nav.position_m[-1] - IDEAL.motion.position_m[-1]) < 0.05 * PATH_M
    assert len(steps) > 10


def test_nothing_gives_nothing():
    chain = FilterFree(PARAMS)
    empty = chain.run(part(JUDGED, 0, 0), part(TRUE_ATTITUDE, 0, 0))
    assert length(empty.nav) == 0
    assert length(chain.finish().nav) == 0

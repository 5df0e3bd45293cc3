import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_eskf_filter import JUDGED, STANCE_ENDS, WALK, fresh

from pdr_core.eskf.configure import settings
from pdr_core.eskf.smoother import Smoother
from pdr_core.eskf.smoothing import estimates, smooth
from pdr_core.eskf.tape import recorded
from pdr_core.params import Params, PlaceParams, changed
from pdr_core.records import joined, length, part

NO_ENDS = np.zeros(length(JUDGED), np.bool_)


def taped(block=JUDGED, **filter_params):
    params = changed(Params(), "filter", **filter_params).filter
    return recorded(block, settings(params, PlaceParams()), fresh(**filter_params).state)


def smoothed(block=JUDGED, **filter_params):
    tape = taped(block, **filter_params)
    smooth(tape, NO_ENDS[: length(block)], filter_params.get("level_ground", False))
    return tape


def error_m(nav):
    return np.linalg.norm(nav.position_m - WALK.motion.position_m, axis=1)


def error_mps(tape):
    return np.linalg.norm(tape.states["velocity_mps"][1:] - WALK.motion.velocity_mps, axis=1)[200:]


@pytest.mark.parametrize("level_ground", [False, True])
def test_the_tape_holds_what_the_filter_says(level_ground):
    nav, _ = fresh(level_ground=level_ground).run(JUDGED)
    for a, b in zip(estimates(taped(level_ground=level_ground)), nav, strict=True):
        np.testing.assert_array_equal(a, b)


def test_on_level_ground_the_height_stays_and_the_rest_is_smoothed():
    before, level, free = taped(level_ground=True), smoothed(level_ground=True), smoothed()
    np.testing.assert_array_equal(level.states["position_m"][:, 2], before.states["position_m"][:, 2])
    np.testing.assert_array_equal(level.states["P"][:, 2, 2], before.states["P"][:, 2, 2])
    np.testing.assert_allclose(level.states["position_m"][:, :2], free.states["position_m"][:, :2], atol=5e-4)
    np.testing.assert_allclose(level.states["velocity_mps"], free.states["velocity_mps"], atol=0.01)
    assert np.abs(level.states["velocity_mps"] - before.states["velocity_mps"]).max() > 0.02
    assert (np.linalg.eigvalsh(level.states["P"])[:, 0] > 0.0).all()


def test_at_the_end_it_is_the_filter():
    smooth_nav, nav = estimates(smoothed()), estimates(taped())
    for a, b in zip(smooth_nav, nav, strict=True):
        np.testing.assert_array_equal(a[-1], b[-1])
    assert not np.array_equal(smooth_nav.position_m[-2], nav.position_m[-2])


def rested(rate_radps, sd_radps=1e-3):
    """Return the walk with what the rest before it shows."""
    rate, sd = JUDGED.rest_rate_radps.copy(), JUDGED.rest_sd_radps.copy()
    rate[600], sd[600] = rate_radps, sd_radps
    return JUDGED._replace(rest_rate_radps=rate, rest_sd_radps=sd)


def test_a_walk_comes_out_nearer_to_the_truth_and_is_more_certain():
    block = rested(JUDGED.imu.gyro_radps[50:600].mean(axis=0))
    before, after = taped(block), smoothed(block)
    assert np.mean(error_mps(after)) < 0.6 * np.mean(error_mps(before))
    assert np.mean(error_m(estimates(after))) < np.mean(error_m(estimates(before)))
    variances = [np.einsum("nii->ni", tape.states["P"][100:]).mean(axis=0) for tape in (before, after)]
    assert (variances[1] < variances[0]).all()
    assert (np.linalg.eigvalsh(after.states["P"])[:, 0] > 0.0).all()


def test_the_first_moments_are_one_rest():
    nav = estimates(smoothed())
    np.testing.assert_allclose(nav.quat_xyzw[:10], np.tile(nav.quat_xyzw[10], (10, 1)), atol=1e-9)
    assert np.ptp(estimates(taped()).quat_xyzw[:10], axis=0).max() > 1e-6


def test_stances_leave_the_gyro_bias_alone_also_backwards():
    given = {"gyro_bias_walk": 0.0, "bias_correlation_s": 1e9}
    before, after = taped(**given), smoothed(**given)
    np.testing.assert_allclose(after.states["gyro_bias_radps"], before.states["gyro_bias_radps"], atol=1e-9)
    assert np.abs(after.states["accel_bias_mps2"] - before.states["accel_bias_mps2"]).max() > 1e-4


def test_a_rest_tells_the_gyro_bias_also_to_the_time_before():
    shown_radps = [0.003, -0.002, 0.001]
    tape = smoothed(rested(shown_radps, 1e-5))
    np.testing.assert_allclose(tape.states["gyro_bias_radps"][100], shown_radps, atol=1e-4)
    assert not taped(rested(shown_radps, 1e-5)).states["gyro_bias_radps"][100].any()


def test_the_yaw_is_not_moved_by_stances():
    before, after = estimates(taped()), estimates(smoothed())
    turn = (Rotation.from_quat(after.quat_xyzw) * Rotation.from_quat(before.quat_xyzw).inv()).as_rotvec()
    yaw_sd = np.sqrt(before.pose_covariance[:, 5, 5])
    assert np.abs(turn[:, 2] / yaw_sd).max() < 0.2
    assert np.abs(turn[:, :2]).max() > 1e-3


def test_a_doubt_keeps_what_it_corrects_on_its_side():
    accel = JUDGED.imu.accel_mps2.copy()
    accel[1050:1070, 0] += 60.0  # the foot seems to fly off in mid-swing
    block = JUDGED._replace(imu=JUDGED.imu._replace(accel_mps2=accel))
    tape = smoothed(block)
    assert tape.states[-1]["doubted"] > 0
    before = int(STANCE_ENDS[STANCE_ENDS < 1050][-1])
    assert error_m(estimates(tape))[:before].max() < 0.05
    assert error_m(estimates(taped(block)))[1050:].max() > 1.0


def test_where_the_tilt_was_lost_nothing_is_led_back():
    turned = Rotation.from_euler("x", 3.0)
    late = part(JUDGED, int(STANCE_ENDS[4]) + 30)
    imu = late.imu._replace(gyro_radps=turned.apply(late.imu.gyro_radps), accel_mps2=turned.apply(late.imu.accel_mps2))
    block = joined([part(JUDGED, 0, int(STANCE_ENDS[2]) + 30), late._replace(imu=imu)])
    before, after = taped(block), smoothed(block)
    adrift = before.states["adrift"]
    assert adrift.sum() > 10
    np.testing.assert_allclose(after.states["velocity_mps"][adrift], 0.0, atol=1e-12)
    np.testing.assert_allclose(after.states["quat_xyzw"][adrift], before.states["quat_xyzw"][adrift], atol=1e-14)


@pytest.mark.parametrize("size", [7, 500, 10**6])
def test_the_pieces_in_which_it_works_change_nothing(size, monkeypatch):
    monkeypatch.setattr("pdr_core.eskf.smoother.SEGMENT", size)
    walk, smoother, steps = fresh(), Smoother(settings(Params().filter, PlaceParams())), []
    for start in range(0, length(JUDGED), 90):
        piece, before = part(JUDGED, start, start + 90), walk.state.copy()
        steps += walk.run(piece)[1]
        smoother.keep(before, piece)
    steps, shares = steps + walk.finish(), []
    _, navs, events = zip(*smoother.smoothed(walk.state, steps, shares.append), strict=True)
    for a, b in zip(joined(list(navs)), estimates(smoothed()), strict=True):
        np.testing.assert_array_equal(a, b)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    found = [event for some in events for event in some]
    assert [s.stamp_ns for s in found] == [s.stamp_ns for s in steps]

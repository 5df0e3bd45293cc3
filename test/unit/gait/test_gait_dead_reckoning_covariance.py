"""Dead reckoning by strides: how sure it is, and what a heading by the field is worth."""

from dataclasses import replace

import numpy as np
import pytest
from dead_reckoning_cases import (
    PARAMS,
    SD,
    STRAIGHT,
    SURE,
    begun,
    finite,
    gait_step,
    left_foot,
    start,
    tracked,
)
from scipy.stats import chi2

from pdr_core.gait.dead_reckoning import GaitDeadReckoning, Length
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.records import Handover, PoseEstimate
from pdr_core.records_gait import Angle, FieldHeading


def simulated_run(rng, params, strides):
    """Walk as the model has it, errors and all; yield the truth and the track after each stride."""
    given, truth = start(), start().pose.position_m + SD[:3] * rng.standard_normal(3)
    yaw = SD[5] * rng.standard_normal()
    scale = 1.0 + params.length_scale_sd * rng.standard_normal()
    deviation_error, common = 0.03 * rng.standard_normal(), 0.1
    north = common * rng.standard_normal()
    track = GaitDeadReckoning(params)
    track.begin(given)
    for i in range(1, strides + 1):
        turn, told = 0.2 * np.sin(0.3 * i), Length(1.3 + 0.1 * np.cos(i), 0.08)
        turned = turn + 0.03 * rng.standard_normal()
        scatter = np.hypot(params.deviation_scatter_rad, params.turn_scatter * turn) * rng.standard_normal()
        walked = scale * told.m + told.sd_m * rng.standard_normal()
        direction = yaw + 0.5 * turned + 0.5 + deviation_error + scatter
        climbed = params.climb_sd_m * rng.standard_normal()
        truth = truth + np.array([walked * np.cos(direction), walked * np.sin(direction), climbed])
        yaw += turned
        if i > 1:
            north *= np.sqrt(1.0 - params.field_wander**2)
            north += params.field_wander * common * rng.standard_normal()
        seen = FieldHeading(yaw + north + 0.2 * rng.standard_normal(), 0.2, common)
        track.step(gait_step(i), told, Angle(turn, 0.03), Angle(0.5, 0.03), seen)
        yield truth, yaw, track.handover.pose


def test_it_is_as_uncertain_as_it_says():
    """NEES of position and yaw, 100 runs, between both chi-square bounds."""
    rng, runs, strides = np.random.default_rng(3), 100, 40
    squares = np.empty((runs, strides))
    for run in range(runs):
        for i, (truth, yaw, pose) in enumerate(simulated_run(rng, PARAMS, strides)):
            error = np.append(truth - pose.position_m, wrapped_rad(yaw - yaw_rad(pose.quat_xyzw)))
            P = pose.covariance[np.ix_([0, 1, 2, 5], [0, 1, 2, 5])]
            squares[run, i] = error @ np.linalg.solve(P, error)
    mean = squares.mean(axis=0)
    low, high = chi2.ppf([0.025, 0.975], 4 * runs) / runs
    assert np.mean((mean > low) & (mean < high)) > 0.85
    assert 0.95 * low < mean.mean() < 1.05 * high


def test_the_covariance_moves_as_the_track_does():
    """The Jacobian of a stride by finite differences, and its noise: P is J P J' + Q."""
    turn, deviation, length = Angle(0.3, 0.1), Angle(0.2, 0.05), Length(1.3, 0.04)
    quiet = replace(PARAMS, deviation_scatter_rad=1e-4, turn_scatter=0.0, climb_sd_m=0.0, length_scale_sd=0.03)

    def end(yaw=0.4, turn=turn.rad, deviation=deviation.rad, length=length.m):
        track = GaitDeadReckoning(quiet)
        track.begin(start(yaw=yaw))
        step = track.step(gait_step(1), Length(length, 0.0), Angle(turn, 0.0), Angle(deviation, 0.0)).step
        return np.append(step.position_m[:2], step.yaw_rad)

    e = 1e-6
    J = np.column_stack(
        [
            (end(yaw=0.4 + e) - end()) / e,
            (end(turn=turn.rad + e) - end()) / e,
            (end(deviation=deviation.rad + e) - end()) / e,
            (end(length=length.m + e) - end()) / e,
            (end(length=length.m * (1.0 + e)) - end()) / e,
        ]
    )
    sd = np.array([SD[5], turn.sd_rad, deviation.sd_rad, length.sd_m, quiet.length_scale_sd])
    expected = J @ np.diag(sd**2) @ J.T + np.diag([SD[0] ** 2, SD[1] ** 2, 0.0])
    track = GaitDeadReckoning(quiet)
    track.begin(start(yaw=0.4))
    track.step(gait_step(1), length, turn, deviation)
    found = track.handover.pose.covariance[np.ix_([0, 1, 5], [0, 1, 5])]
    np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-7)


def test_errors_that_strides_share_do_not_average_out():
    """After 100 strides 2 % of scale are 2.6 m, and 0.05 rad of deviation 6.5 m; as noise they would be a tenth."""
    track = begun(sd=1e-6 * SD)
    for i in range(1, 101):
        track.step(gait_step(i), SURE, STRAIGHT, Angle(0.0, 0.05))
    sd_m = np.sqrt(np.diag(track.handover.pose.covariance))
    assert sd_m[0] == pytest.approx(2.6, rel=0.05)
    assert sd_m[1] == pytest.approx(np.hypot(6.5, 1.3 * PARAMS.deviation_scatter_rad * 10.0), rel=0.05)


def test_a_heading_of_the_field_bounds_the_error_and_mends_the_track():
    held, seen = begun(), begun()
    for i in range(1, 61):
        held.step(gait_step(i), SURE, Angle(0.0, 0.2), STRAIGHT)
        seen.step(gait_step(i), SURE, Angle(0.0, 0.2), STRAIGHT, FieldHeading(0.3, 0.2, 0.05))
    assert held.yaw.sd_rad == pytest.approx(0.2 * np.sqrt(60.0), rel=0.02)
    assert seen.yaw.sd_rad < 0.25
    assert seen.yaw.rad == pytest.approx(0.3, abs=0.05)


def test_what_all_places_share_is_not_averaged_out():
    track = begun()
    for i in range(1, 500):
        track.step(gait_step(i), SURE, Angle(0.0, 0.3), STRAIGHT, FieldHeading(0.0, 0.1, 0.3))
    assert track.yaw.sd_rad > 0.3


def test_a_field_that_contradicts_counts_little_and_is_said():
    track = begun()
    track.step(gait_step(1), SURE, Angle(0.0, 0.01), STRAIGHT, FieldHeading(2.0, 0.1, 0.1))
    assert track.yaw.rad == pytest.approx(0.0, abs=0.01)
    assert [notice.kind for notice in track.notices] == ["heading_doubted"]


def test_a_track_that_has_missed_a_turn_comes_back():
    track = begun()
    seen = [
        track.step(gait_step(i), SURE, Angle(0.0, 0.1), STRAIGHT, FieldHeading(2.0, 0.26, 0.13)).step.yaw_rad
        for i in range(1, 101)
    ]
    assert seen[12] > 1.0  # at once, not only when nothing is known any more
    assert seen[-1] == pytest.approx(2.0, abs=0.2)


def test_a_simulated_foot_is_where_the_covariance_says_between_the_steps():
    walk = left_foot(length_m=30.0)
    nav, steps = tracked(walk.imu)
    track = GaitDeadReckoning(PARAMS)
    first = int(np.searchsorted(nav.stamp_ns, steps[0].stamp_ns))
    pose = PoseEstimate(nav.position_m[first], nav.quat_xyzw[first], np.eye(6) * 1e-4)
    track.begin(Handover(steps[0].stamp_ns, pose, None))
    squares = []
    for i, step in enumerate(steps[1:-1], 1):
        stride = replace(gait_step(i), start_ns=step.start_ns, stamp_ns=step.stamp_ns)
        rows = track.step(stride, Length(step.length_m, 0.02), STRAIGHT, Angle(-0.12, 0.02)).nav
        true = np.column_stack([np.interp(rows.stamp_ns, nav.stamp_ns, nav.position_m[:, k]) for k in range(3)])
        error = true - rows.position_m
        squares += list(np.einsum("ni,nij,nj->n", error, np.linalg.inv(rows.pose_covariance[:, :3, :3]), error))
    assert 0.5 < np.mean(squares) < 4.0  # 3 would be exact


def test_an_unknown_heading_says_so():
    track = begun()
    for i in range(1, 400):
        step, nav = track.step(gait_step(i), SURE, Angle(0.0, 1.0), Angle(0.0, np.pi))
    assert step.yaw_sd_rad == np.pi
    assert finite(nav)
    assert np.linalg.eigvalsh(nav.pose_covariance).min() > 0.0


def test_a_heading_that_no_field_tells_is_kept_and_that_is_said():
    track = begun()
    track.step(gait_step(1), SURE, STRAIGHT, STRAIGHT, FieldHeading(0.0, 0.1, 0.1))
    assert track.notices == []
    track.step(gait_step(2), SURE, STRAIGHT, STRAIGHT)
    assert [(notice.kind, notice.count) for notice in track.notices] == [("heading_kept", 1)]

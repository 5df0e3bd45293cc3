"""Dead reckoning by strides: eq. 14, handing over, and what comes between the steps."""

from dataclasses import replace

import numpy as np
import pytest
from dead_reckoning_cases import (
    BEGIN_NS,
    PARAMS,
    SD,
    SECOND,
    STRAIGHT,
    SURE,
    begun,
    finite,
    gait_step,
    left_foot,
    start,
)

from pdr_core.conventions import UNKNOWN_RATE_SD_RADPS
from pdr_core.eskf import ZuptFilter
from pdr_core.gait.dead_reckoning import GaitDeadReckoning, Length
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import Params
from pdr_core.records import joined
from pdr_core.records_gait import Angle, Behaviour, FieldHeading
from pdr_core.simulation.walk import SimulatedWalk
from support.walks import judged


def test_x_is_east_and_yaw_counts_counter_clockwise():
    """Zhou eq. 14 prints sine and cosine the other way round, for an angle from north."""
    track = begun(yaw=np.pi / 2.0)
    step, _ = track.step(gait_step(1), SURE, STRAIGHT, STRAIGHT)
    np.testing.assert_allclose(step.displacement_m, [0.0, 1.3, 0.0], atol=1e-12)
    step, _ = track.step(gait_step(2), SURE, STRAIGHT, Angle(-np.pi / 2.0, 0.0))
    np.testing.assert_allclose(step.displacement_m, [1.3, 0.0, 0.0], atol=1e-12)
    assert step.yaw_rad == pytest.approx(np.pi / 2.0)  # of the foot, not of the walk


def test_turning_strides_close_a_circle():
    track = begun()
    for i in range(1, 25):
        track.step(gait_step(i), SURE, Angle(2.0 * np.pi / 24.0, 0.0), Angle(0.4, 0.0))
    np.testing.assert_allclose(track.handover.pose.position_m, start().pose.position_m, atol=1e-9)


def test_it_begins_and_ends_without_a_jump():
    given = start(yaw=0.7, tilt=0.2)
    given.pose.covariance[:] += 1e-4 * np.ones((6, 6))
    track = GaitDeadReckoning(PARAMS)
    track.begin(given)
    assert track.handover.stamp_ns == given.stamp_ns
    np.testing.assert_array_equal(track.handover.pose.position_m, given.pose.position_m)
    np.testing.assert_array_equal(track.handover.pose.quat_xyzw, given.pose.quat_xyzw)
    np.testing.assert_array_equal(track.handover.pose.covariance, given.pose.covariance)
    assert track.handover.biases is given.biases
    step, nav = track.step(gait_step(1), Length(1.3, 0.05), Angle(0.2, 0.1), Angle(0.1, 0.02))
    assert np.linalg.norm(np.diff(nav.position_m, axis=0), axis=1).max() < 1.3 / 45.0
    np.testing.assert_allclose(nav.position_m[-1], track.handover.pose.position_m)
    np.testing.assert_allclose(nav.pose_covariance[-1], track.handover.pose.covariance)
    np.testing.assert_array_equal(step.position_covariance_m2, track.handover.pose.covariance[:3, :3])


def halves() -> tuple[SimulatedWalk, int]:
    """A walk and a row in the middle of a stance in its middle."""
    walk = left_foot(length_m=30.0, sensor="consumer")
    ends = np.flatnonzero(np.diff(walk.motion.stance.astype(int)) == -1)
    return walk, int(ends[len(ends) // 2]) - 40


def test_a_filter_goes_on_from_dead_reckoning_and_back():
    walk, cut = halves()
    block = judged(walk.imu)
    filter_ = ZuptFilter(Params().filter, Params().place)
    nav, _ = filter_.run(type(block)(*(_cut(c, 0, cut) for c in block)))
    track = GaitDeadReckoning(PARAMS)
    track.begin(filter_.handover)
    np.testing.assert_array_equal(track.handover.pose.position_m, nav.position_m[-1])
    assert track.yaw.rad == yaw_rad(nav.quat_xyzw[-1])
    for i in (1, 2):
        track.step(gait_step(i, begin_ns=int(nav.stamp_ns[-1])), Length(1.4, 0.05), STRAIGHT, Angle(-0.12, 0.01))
    filter_.reset(track.handover)
    again = filter_.handover
    np.testing.assert_array_equal(again.pose.position_m, track.handover.pose.position_m)
    assert np.diag(again.pose.covariance)[[0, 1, 2, 5]] == pytest.approx(
        np.diag(track.handover.pose.covariance)[[0, 1, 2, 5]]
    )
    nav, _ = filter_.run(type(block)(*(_cut(c, cut, cut + 20) for c in block)))
    assert yaw_rad(nav.quat_xyzw[-1]) == pytest.approx(track.yaw.rad, abs=0.01)
    np.testing.assert_allclose(nav.position_m[-1], track.handover.pose.position_m, atol=0.01)


def _cut(column, first, last):
    return type(column)(*(c[first:last] for c in column)) if isinstance(column, tuple) else column[first:last]


def test_another_behaviour_brings_its_own_deviation():
    track = begun(sd=1e-6 * SD)
    for i in range(1, 11):
        deviation = Angle(0.3, 0.05) if i <= 5 else Angle(-0.1, 0.05)
        step = track.step(gait_step(i, behaviour=Behaviour.WALKING), SURE, STRAIGHT, deviation).step
        assert step.heading_rad == pytest.approx(deviation.rad)


def test_numbers_that_are_none_do_not_leave():
    track = begun()
    track.step(gait_step(1), SURE, STRAIGHT, STRAIGHT)
    bad = np.nan
    for i, args in enumerate(
        [
            (Length(bad, 0.1), STRAIGHT, STRAIGHT, None),
            (SURE, Angle(bad, 0.1), STRAIGHT, None),
            (SURE, STRAIGHT, Angle(0.0, bad), None),
            (SURE, STRAIGHT, STRAIGHT, FieldHeading(bad, 0.1, 0.1)),
        ],
        2,
    ):
        step, nav = track.step(gait_step(i), *args)
        assert finite(nav)
        assert np.isfinite(step.displacement_covariance_m2).all()
        assert step.length_m == pytest.approx(1.3)
    assert next(notice.count for notice in track.notices if notice.kind == "gait_step_unusable") == 3
    pose = replace(start().pose, position_m=np.full(3, bad))
    where = track.handover.pose.position_m
    track.begin(replace(start(), pose=pose))
    np.testing.assert_array_equal(track.handover.pose.position_m, where)


def test_estimates_come_at_their_rate_without_the_gyro():
    track, blocks = begun(), []
    blocks.append(track.stand(BEGIN_NS + SECOND // 2))
    for i in (1, 2, 4):  # a pause, in which the third would be
        blocks.append(track.step(gait_step(i), Length(1.3, 0.1), Angle(0.1, 0.1), Angle(0.1, 0.02)).nav)
    nav = joined(blocks)
    assert finite(nav)
    gaps = np.diff(np.append(BEGIN_NS, nav.stamp_ns))
    assert gaps.min() > 0
    assert gaps.max() == SECOND // round(PARAMS.odom_rate_hz)
    assert (nav.twist_covariance[:, 5, 5] == UNKNOWN_RATE_SD_RADPS**2).all()
    assert (np.linalg.eigvalsh(nav.pose_covariance) > 0.0).all()
    stands = (nav.stamp_ns <= BEGIN_NS + SECOND // 2) | (
        (nav.stamp_ns > BEGIN_NS + 2 * SECOND) & (nav.stamp_ns <= BEGIN_NS + 3 * SECOND)
    )
    assert (nav.velocity_mps[stands] == 0.0).all()
    assert np.linalg.norm(nav.velocity_mps[~stands], axis=1).min() > 1.2


def test_the_velocity_is_that_of_the_track_in_the_foot_frame():
    track = begun(yaw=1.0)
    nav = track.step(gait_step(1), SURE, STRAIGHT, Angle(0.5, 0.0)).nav
    np.testing.assert_allclose(nav.velocity_mps[-1], [1.3 * np.cos(0.5), 1.3 * np.sin(0.5), 0.0], atol=1e-9)


def test_a_clock_that_jumps_does_not_stop_it():
    track = begun()
    track.step(gait_step(1), SURE, STRAIGHT, STRAIGHT)
    step, nav = track.step(gait_step(1, begin_ns=5 * SECOND), SURE, STRAIGHT, STRAIGHT)  # back by years
    assert (step.start_ns, step.stamp_ns) == (5 * SECOND, 6 * SECOND)
    assert len(nav.stamp_ns) == 50
    assert step.position_m[0] == pytest.approx(5.0 + 2.6)
    _, nav = track.step(gait_step(1), SURE, STRAIGHT, STRAIGHT)  # and forth: no billion of rows
    assert len(nav.stamp_ns) < 100


def test_steps_go_on_counting():
    track = GaitDeadReckoning(PARAMS)
    track.begin(start(), next_index=17)
    assert [track.step(gait_step(i), SURE, STRAIGHT, STRAIGHT).step.index for i in (1, 2)] == [17, 18]


def test_a_heading_that_somebody_knows_turns_the_track_about_where_it_was_sure():
    track = begun(sd=np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.2]))
    for number in range(1, 5):
        track.step(gait_step(number), SURE, STRAIGHT, STRAIGHT)
    before = track.handover.pose
    track.take_heading(0.1, 1e-6)
    after = track.handover.pose
    assert wrapped_rad(yaw_rad(after.quat_xyzw) - yaw_rad(before.quat_xyzw)) == pytest.approx(-0.1, abs=0.01)
    assert after.position_m - before.position_m == pytest.approx([0.0, -0.1 * 4 * SURE.m, 0.0], abs=0.05)
    assert track.yaw.sd_rad < 0.01

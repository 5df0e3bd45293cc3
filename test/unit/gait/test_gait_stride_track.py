"""One stride of dead reckoning, number for number: what its displacement, its tilt and the north of a field become."""

from dataclasses import replace

import numpy as np
import pytest
from dead_reckoning_cases import BEGIN_NS, PARAMS, SD, STRAIGHT, SURE, begun, gait_step, start

from pdr_core.gait.dead_reckoning import GaitDeadReckoning, Length
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.records import Handover, PoseEstimate
from pdr_core.records_gait import Angle, FieldHeading

TURNED, STEADY = Angle(0.0, 0.3), Angle(0.0, 0.0)


def with_yaw_sd(sd_rad):
    """The deviations of a start whose yaw is known so well."""
    return np.append(SD[:5], sd_rad)


def test_the_displacement_is_as_uncertain_as_what_is_told_of_it_and_not_as_the_place():
    """In axes along the chord and across it; the turn of 0.8 rad scatters the direction by a share of its own."""
    length, turn, deviation = Length(1.3, 0.04), Angle(0.8, 0.1), Angle(0.0, 0.05)
    track = begun()
    covariance = track.step(gait_step(1), length, turn, deviation).step.displacement_covariance_m2
    scatter = np.hypot(PARAMS.deviation_scatter_rad, PARAMS.turn_scatter * turn.rad)
    along = np.hypot(length.sd_m, length.m * PARAMS.length_scale_sd)
    across = length.m * np.sqrt(SD[5] ** 2 + deviation.sd_rad**2 + (0.5 * turn.sd_rad) ** 2 + scatter**2)
    c, s = np.cos(0.5 * turn.rad), np.sin(0.5 * turn.rad)
    axes = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    np.testing.assert_allclose(
        covariance, axes @ np.diag(np.square([along, across, PARAMS.climb_sd_m])) @ axes.T, atol=1e-12
    )


def test_a_foot_stands_tilted_as_before_but_for_how_places_differ():
    """Whatever its tilt had to do with its place before: it has trodden anew."""
    P = np.diag(SD**2)
    P[0, 3] = P[3, 0] = 0.5 * SD[0] * SD[3]
    P[3, 4] = P[4, 3] = 0.5 * SD[3] * SD[4]
    track = GaitDeadReckoning(PARAMS)
    pose = start().pose
    track.begin(Handover(BEGIN_NS, PoseEstimate(pose.position_m, pose.quat_xyzw, P), None))
    track.step(gait_step(1), SURE, STRAIGHT, STRAIGHT)
    found = track.handover.pose.covariance
    expected = P[3:5, 3:5] + PARAMS.tilt_sd_rad**2 * np.eye(2)
    np.testing.assert_allclose(found[3:5, 3:5], expected, atol=1e-15)
    assert not found[3:5, [0, 1, 2, 5]].any()
    assert not found[[0, 1, 2, 5], 3:5].any()


def test_a_tilt_that_nobody_measures_stays_a_tilt():
    track = GaitDeadReckoning(replace(PARAMS, tilt_sd_rad=0.3))
    track.begin(start())
    for i in range(1, 30):
        track.step(gait_step(i), SURE, STRAIGHT, STRAIGHT)
    assert np.trace(track.handover.pose.covariance[3:5, 3:5]) <= 1.0


def test_a_heading_that_somebody_knows_counts_by_its_variance():
    track = begun()
    track.take_heading(0.01, SD[5])  # as well known as ours
    assert yaw_rad(track.handover.pose.quat_xyzw) == pytest.approx(-0.005)
    assert track.yaw.sd_rad == pytest.approx(SD[5] / np.sqrt(2.0))


def test_how_far_a_neighbourhood_bends_north_is_learnt_and_taken_off():
    """The yaw is known for ten strides, then lost: the field has been off by 0.3 rad, and is so still."""
    track = begun(sd=with_yaw_sd(1e-4))
    for i in range(1, 11):
        track.step(gait_step(i), SURE, STEADY, STRAIGHT, FieldHeading(0.3, 0.05, 0.3))
    assert track.yaw.rad == pytest.approx(0.0, abs=1e-3)
    lost = track.step(gait_step(11), SURE, TURNED, STRAIGHT, FieldHeading(0.3, 0.05, 0.3)).step
    assert lost.yaw_rad == pytest.approx(0.0, abs=0.05)


def test_another_kind_of_field_has_a_north_of_its_own():
    """What the first has told of yaw stays; what it has told of north says nothing of the second's."""
    first, second, prior = FieldHeading(0.1, 0.05, 0.3), FieldHeading(0.0, 0.05, 0.05), 0.3
    track = begun(sd=with_yaw_sd(prior))
    seen = track.step(gait_step(1), SURE, STEADY, STRAIGHT, first).step
    k = prior**2 / (prior**2 + first.sd_rad**2 + first.common_sd_rad**2)
    assert seen.yaw_rad == pytest.approx(k * 0.1)
    variance = (1.0 - k) * prior**2
    assert seen.yaw_sd_rad == pytest.approx(np.sqrt(variance))
    seen = track.step(gait_step(2), SURE, STEADY, STRAIGHT, second).step
    k2 = variance / (variance + second.sd_rad**2 + second.common_sd_rad**2)
    assert seen.yaw_rad == pytest.approx((1.0 - k2) * k * 0.1)
    assert seen.yaw_sd_rad == pytest.approx(np.sqrt((1.0 - k2) * variance))


def test_a_turn_that_is_no_number_may_be_any_that_a_person_takes():
    track = begun()
    track.step(gait_step(1), SURE, Angle(np.nan, 0.1), STRAIGHT)
    assert track.yaw.rad == pytest.approx(0.0)
    assert track.yaw.sd_rad == pytest.approx(np.hypot(SD[5], PARAMS.held_turn_sd_rad))


def test_a_deviation_that_is_no_number_is_that_of_the_stride_before():
    track = begun()
    for i, rad in ((1, 0.5), (2, np.nan)):
        ahead_m = track.step(gait_step(i), SURE, STRAIGHT, Angle(rad, 0.0)).step.displacement_m
    assert np.arctan2(ahead_m[1], ahead_m[0]) == pytest.approx(0.5)


def test_the_deviation_of_another_gait_is_off_by_itself():
    """Strides of one gait err to one side together, 2 x 0.3 rad; the first of another has nothing to do with that."""
    track = GaitDeadReckoning(replace(PARAMS, deviation_scatter_rad=0.0, turn_scatter=0.0))
    track.begin(start(sd=1e-9 * SD))
    for i, sd_rad in ((1, 0.3), (2, 0.3), (3, 0.1)):
        track.step(gait_step(i), SURE, STEADY, Angle(0.0, sd_rad))
    assert np.sqrt(track.handover.pose.covariance[1, 1]) == pytest.approx(SURE.m * np.hypot(2.0 * 0.3, 0.1))


def test_a_stand_that_is_over_already_takes_nothing_back():
    track = begun()
    end_ns = track.step(gait_step(1), SURE, STRAIGHT, STRAIGHT).step.stamp_ns
    assert len(track.stand(end_ns - 500_000_000).stamp_ns) == 0
    assert track.handover.stamp_ns == end_ns

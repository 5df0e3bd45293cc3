"""The body between the feet: place, direction, twist and covariance."""

import numpy as np
import pytest
from fusion_cases import rows

from pdr_core.fusion.body import SIZE, Frame, Gait, between, bound, moved, placed_m
from pdr_core.fusion.foot_rows import room

GAIT = Gait(width_m=0.2, apart_sd_m=0.3)
RNG = np.random.default_rng(5)


def frame(
    place_m=(0.0, 0.0, 0.0), yaw_rad=0.0, yaw_sd_rad=0.0, toe_rad=0.0, start_m=(0.0, 0.0, 0.0), halved_sd_rad=0.0
):
    return Frame(start_m, place_m, 0.0, yaw_rad, yaw_sd_rad, halved_sd_rad, toe_rad, 0.0)


LEFT, RIGHT = frame((0.0, 0.1, 0.0)), frame((0.0, -0.1, 0.0))


def body(left, right, known=(True, True), frames=(LEFT, RIGHT)):
    out = room(len(left.stamp_ns))
    between(left, right, np.tile(known, (len(left.stamp_ns), 1)), frames, GAIT, out)
    return out


def yaw_of(nav):
    return 2 * np.arctan2(nav.quat_xyzw[:, 2], nav.quat_xyzw[:, 3])


def test_feet_that_are_known_alike_have_the_body_midway():
    out = body(rows([1.0], [[3.0, 0.5, 0.0]]), rows([1.0], [[2.0, 0.3, 0.0]]))
    assert out.position_m[0] == pytest.approx([2.5, 0.4, 0.0])


def test_the_body_looks_where_the_person_goes_not_where_feet_point():
    frames = frame(yaw_rad=0.2, toe_rad=0.25), frame(yaw_rad=-0.2, toe_rad=-0.15)
    out = body(rows([1.0], yaw_rad=0.55), rows([1.0], yaw_rad=0.55), frames=frames)
    assert yaw_of(out)[0] == pytest.approx(0.5)
    across = body(rows([1.0], yaw_rad=3.1), rows([1.0], yaw_rad=-3.1))
    assert abs(yaw_of(across)[0]) == pytest.approx(np.pi, abs=1e-6)


def test_a_foot_whose_yaw_is_lost_does_not_turn_the_body():
    out = body(rows([1.0], yaw_rad=0.5), rows([1.0], yaw_rad=2.0, yaw_sd_rad=2.5))
    assert yaw_of(out)[0] == pytest.approx(0.5, abs=0.01)


def test_the_floor_is_where_the_standing_foot_is():
    standing, swinging = rows([1.0], [[0, 0, 0.17]]), rows([1.0], [[0, 0, 0.4]], velocity_mps=[4.0, 0, 0])
    assert body(standing, swinging).position_m[0, 2] == pytest.approx(0.17, abs=0.005)


def test_the_twist_is_in_the_frame_of_the_body():
    north = {"yaw_rad": np.pi / 2, "velocity_mps": [1.2, 0.0, 0.0]}  # of a foot: ahead
    out = body(rows([1.0], **north), rows([1.0], **north))
    assert out.velocity_mps[0] == pytest.approx([1.2, 0.0, 0.0], abs=1e-9)
    assert out.twist_covariance[0, 1, 1] > out.twist_covariance[0, 0, 0]  # a wrong yaw turns it aside


def test_one_foot_alone_has_the_body_beside_it_and_the_covariance_says_so():
    left, right = rows([1.0], [[5.0, 1.0, 0.0]]), rows([1.0])
    both, alone = body(left, left), body(left, right, known=(True, False))
    assert alone.position_m[0] == pytest.approx([5.0, 1.0, 0.0])  # left of the body by 0.1, where its frame begins
    assert alone.pose_covariance[0, 0, 0] == pytest.approx(both.pose_covariance[0, 0, 0] + 0.15**2)
    assert alone.twist_covariance[0, 0, 0] > 0.4


def test_the_body_follows_the_foot_that_is_known_better():
    out = body(rows([1.0], [[0.0, 0.0, 0.0]], sd_m=0.01), rows([1.0], [[3.0, 0.0, 0.0]], sd_m=5.0))
    assert out.position_m[0, 0] == pytest.approx(0.0, abs=0.02)
    assert np.sqrt(out.pose_covariance[0, 0, 0]) < 0.25


def test_two_feet_alike_tell_no_more_than_one():
    left, right = rows([1.0]), rows([1.0])
    assert body(left, right).pose_covariance[0, 0, 0] == pytest.approx(left.pose_covariance[0, 0, 0])


def test_the_bound_holds_for_any_correlation():
    for _ in range(200):
        A = RNG.standard_normal((2 * SIZE, 2 * SIZE))
        joint = A @ A.T
        weights = RNG.uniform(0.1, 0.9, SIZE)
        J = np.hstack([np.diag(weights), np.diag(1.0 - weights)])
        bounded = bound(weights, joint[:SIZE, :SIZE], 1.0 - weights, joint[SIZE:, SIZE:])
        assert np.linalg.eigvalsh(bounded - J @ joint @ J.T)[0] > -1e-9


def test_the_covariance_of_a_foot_is_turned_with_it():
    """Against finite differences: the foot's own errors, and that of its frame about where it began."""
    turned = frame((1.0, 2.0, 0.0), yaw_rad=0.7, yaw_sd_rad=0.05, start_m=(3.0, -1.0, 0.0))
    nav = rows([1.0], [[5.0, 4.0, 0.2]], yaw_rad=0.4)
    A = RNG.standard_normal((6, 6))
    nav.pose_covariance[0] = A @ A.T
    at = moved(nav, 0, turned).pose

    def with_error(axis):
        other, h = rows([1.0], [[5.0, 4.0, 0.2]], yaw_rad=0.4), 1e-6
        if axis < 3:
            other.position_m[0, axis] += h
        else:
            other.quat_xyzw[0, 2:] = np.sin(0.2 + h / 2), np.cos(0.2 + h / 2)
        return (moved(other, 0, turned).pose - at) / h

    J = np.column_stack([with_error(0), with_error(1), with_error(2), with_error(3)])
    by_frame = (moved(nav, 0, turned._replace(yaw_rad=0.7 + 1e-6)).pose - at) / 1e-6
    of_foot = nav.pose_covariance[0][np.ix_([0, 1, 2, 5], [0, 1, 2, 5])]
    expected = J @ of_foot @ J.T + 0.05**2 * np.outer(by_frame, by_frame)
    assert moved(nav, 0, turned).pose_covariance == pytest.approx(expected, rel=1e-4, abs=1e-5)
    assert placed_m(turned, nav.position_m)[0] == pytest.approx(at[:3])


def test_an_error_of_opposite_sign_goes_out_of_the_middle_but_not_of_one_foot():
    frames = frame((0.0, 0.1, 0.0), halved_sd_rad=0.1), frame((0.0, -0.1, 0.0), halved_sd_rad=0.1)
    left = right = rows([1.0], [[20.0, 0.0, 0.0]])
    assert np.sqrt(body(left, right, frames=frames).pose_covariance[0, 1, 1]) == pytest.approx(0.01, abs=1e-3)
    alone = body(left, right, known=(True, False), frames=frames)
    assert np.sqrt(alone.pose_covariance[0, 1, 1]) == pytest.approx(2.0, abs=0.01)


def test_covariances_are_symmetric_and_positive():
    for _ in range(50):
        left, right = rows([1.0], RNG.normal(size=(1, 3))), rows([1.0], RNG.normal(size=(1, 3)))
        for nav in (left, right):
            A, B = RNG.standard_normal((2, 6, 6))
            nav.pose_covariance[0], nav.twist_covariance[0] = A @ A.T, B @ B.T
        out = body(left, right)
        for covariance in (out.pose_covariance[0], out.twist_covariance[0]):
            assert covariance == pytest.approx(covariance.T)
            assert np.linalg.eigvalsh(covariance)[0] > 0.0

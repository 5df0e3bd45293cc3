"""Somebody says where the chest is: the track goes on from there, at rest and on the way."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.chest import ChestNavigator
from pdr_core.params import ChestParams, GaitParams, Params, PlaceParams, changed
from pdr_core.pipeline import ChestCard
from pdr_core.pipeline.chest_reference import StepReference
from pdr_core.records import PoseEstimate, joined, part
from support.chest import RATE_HZ, compass_walk, walk

YAW_RAD, PLACE_M = 0.7, np.array([5.0, -3.0, 1.0])
TURN = Rotation.from_euler("z", YAW_RAD)


def pose(quat_xyzw=None):
    return PoseEstimate(PLACE_M, quat_xyzw, np.diag([0.25, 0.16, 0.1, 0.0, 0.0, 0.07]))


def placed(at_s, told, imu=None, keep_biases=True, params=None):
    """The walk without and with a pose that is told at a moment, from then on; and the steps and the card with it."""
    found = []
    for told_now in (None, told):
        card, cut = ChestCard(params or Params()), round(at_s * RATE_HZ)
        samples = walk(2, 44.0).imu if imu is None else imu
        before = card.run(part(samples, 0, cut))
        if told_now:
            card.place(told_now, keep_biases)
        outputs = [card.run(part(samples, cut)), card.finish()]
        found.append((before.nav, joined([o.nav for o in outputs]), [s for o in outputs for s in o.steps], card))
    return found


def test_a_track_that_is_placed_at_rest_is_the_same_track_elsewhere():
    (_, plain, _, _), (_, moved, _, _) = placed(2.0, pose(TURN.as_quat()))
    start = plain.position_m[0]
    assert np.allclose(moved.position_m, PLACE_M + TURN.apply(plain.position_m - start), atol=1e-3)
    assert np.allclose(moved.velocity_mps, plain.velocity_mps, atol=1e-3)
    assert moved.pose_covariance[0, 0, 0] == pytest.approx(0.25, rel=0.01)
    assert moved.pose_covariance[0, 5, 5] == pytest.approx(0.07, rel=0.01)


def test_on_the_way_it_walks_on_from_there():
    (before, plain, _, _), (_, moved, steps, _) = placed(10.0, pose(TURN.as_quat()))
    yaw = Rotation.from_quat(before.quat_xyzw[-1]).as_euler("ZYX")[0]
    turn = Rotation.from_euler("z", YAW_RAD - yaw)
    there = PLACE_M + turn.apply(plain.position_m - before.position_m[-1])
    assert np.linalg.norm((moved.position_m - there)[-1, :2]) < 0.4
    assert steps[0].index == 1


def test_without_an_orientation_it_points_on():
    (before, _, _, _), (_, moved, _, _) = placed(10.0, pose())
    assert np.allclose(moved.position_m[0], PLACE_M, atol=0.05)
    turned = Rotation.from_quat(before.quat_xyzw[-1]).inv() * Rotation.from_quat(moved.quat_xyzw[0])
    assert np.degrees(turned.magnitude()) < 2.0


def test_biases_are_kept_or_forgotten():
    cards = [placed(10.0, pose(), keep_biases=keep)[1][3] for keep in (True, False)]
    kept, forgotten = (c.health for c in cards)
    assert kept.resets == forgotten.resets == 1
    now = []
    for keep in (True, False):
        card = ChestCard(Params())
        card.run(part(walk(2, 44.0).imu, 0, 10 * RATE_HZ))
        card.place(pose(), keep)
        now.append(card.health)
    assert np.linalg.norm(now[0].gyro_bias_radps) > 1e-4
    assert np.all(now[1].gyro_bias_radps == 0.0)
    assert np.all(now[1].gyro_bias_sd_radps > 10.0 * now[0].gyro_bias_sd_radps)


def test_the_field_is_learnt_anew_in_the_new_frame():
    """A track that is turned by 0.7 rad would be turned back by what the field had told before."""
    params = changed(Params(), "chest", bias_wander_radps=0.003)
    _, imu = compass_walk()
    (_, plain, _, _), (_, moved, _, card) = placed(3.0, pose(TURN.as_quat()), imu, params=params)
    assert card.health.field_use.name == "HEADING"
    assert np.linalg.norm((moved.position_m - PLACE_M - TURN.apply(plain.position_m))[-1, :2]) < 0.1 * 250.0


def test_a_track_that_is_turned_on_the_way_walks_on_in_one_direction():
    """The step before, of which the next stride is made, is turned with it."""
    imu, turn_rad = part(walk(2, 44.0).imu, 0, 14 * RATE_HZ), 1.0
    ways = []
    for angle_rad in (0.0, turn_rad):
        navigator = ChestNavigator(ChestParams(), PlaceParams(), StepReference(ChestParams(), GaitParams()))

        def turn(step, navigator=navigator, angle_rad=angle_rad):
            if step.index == 6:
                navigator.state.yaw_sd_rad = 1.0
                navigator.turn_back(-angle_rad, 1e-6)

        steps = navigator.run(imu, turn).steps[6:]
        ways.append([np.arctan2(*step.displacement_m[1::-1]) for step in steps])
    assert np.subtract(*ways) == pytest.approx(np.full(len(steps), -turn_rad), abs=0.01)

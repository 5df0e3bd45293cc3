"""The chest card as a whole: accuracy, stream and batch, its memory, and trouble."""

import pickle

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import ChestCard
from pdr_core.records import FieldUse, PoseEstimate, joined, length, part
from pdr_core.simulation import simulated_walk
from support.chest import RATE_HZ, compass_walk, end_error_m, estimated, params, walk

SEEDS = range(1, 9)


def streamed(imu, sizes):
    card, at, outputs = ChestCard(Params()), 0, []
    while at < length(imu):
        size = int(next(sizes))
        outputs.append(card.run(part(imu, at, at + size)))
        at += size
    return [*outputs, card.finish()]


def assert_same(one, other):
    for a, b in zip(one, other, strict=True):
        assert np.array_equal(a, b)


@pytest.mark.parametrize("seed", [1, 2])
def test_stream_equals_batch_to_the_last_bit(seed):
    imu = walk(seed).imu
    whole, steps, _ = estimated(imu)
    rng = np.random.default_rng(seed)
    for sizes in (iter(lambda: 1, 0), iter(lambda: rng.integers(1, 300), None)):
        outputs = streamed(imu, sizes)
        assert_same(whole, joined([o.nav for o in outputs]))
        taken = [step for o in outputs for step in o.steps]
        assert [s.stamp_ns for s in taken] == [s.stamp_ns for s in steps]
        assert np.array_equal([s.position_m for s in taken], [s.position_m for s in steps])


def test_it_goes_on_from_its_memory():
    imu, cut = walk(3).imu, 1234
    whole, _, _ = estimated(imu)
    before = ChestCard(Params())
    first = before.run(part(imu, 0, cut)).nav
    after = ChestCard.restored(before.saved())
    rest = [after.run(part(imu, cut)).nav, after.finish().nav]
    assert_same(whole, joined([first, *rest]))


def test_a_memory_of_something_else_is_refused():
    with pytest.raises(TypeError, match="not the memory"):
        ChestCard.restored(pickle.dumps([1]))


def test_rectangles_are_walked_well():
    errors = [end_error_m(estimated(walk(seed, 44.0).imu)[0], walk(seed, 44.0)) for seed in SEEDS]
    assert np.mean(errors) < 0.02 * 44.0
    assert max(errors) < 0.04 * 44.0


def test_its_deviations_are_careful_and_still_worth_something():
    """Larger than the errors in the mean, and no more than twenty times as large."""
    ratios = []
    for seed in SEEDS:
        nav, _, _ = estimated(walk(seed, 44.0).imu)
        error_m = (nav.position_m[-1] - walk(seed, 44.0).motion.position_m[-1])[:2]
        ratios.append(np.mean(error_m**2) / nav.pose_covariance[-1, 0, 0])
    assert 0.05**2 < np.mean(ratios) < 1.0


def test_a_hundred_metres_without_a_stop():
    errors = [end_error_m(estimated(long.imu, params(step_length="model"))[0], long) for long in map(straight, SEEDS)]
    assert np.mean(errors) < 5.0


def straight(seed):
    return walk(seed, 100.0, name="straight")


def test_turning_the_start_turns_the_track():
    """The sensor may sit at any angle about the vertical: the steps go where the body goes.

    Not to the last bit: a rest holds the yaw of the sensor's x axis, and a tilt turns that by its square.
    """
    true = walk(2)
    turn = Rotation.from_euler("z", 40.0, degrees=True)
    imu = true.imu._replace(gyro_radps=turn.apply(true.imu.gyro_radps), accel_mps2=turn.apply(true.imu.accel_mps2))
    plain, turned = estimated(true.imu)[0], estimated(imu)[0]
    back = Rotation.from_euler("z", 40.0, degrees=True).inv().apply(turned.position_m)
    assert np.abs(back - plain.position_m).max() < 0.05


@pytest.mark.parametrize(
    "settings",
    [
        {"mounting_pitch_rad": -0.5 * np.pi},  # the sensor's x axis points up, as on a card worn upright
        {"mounting_roll_rad": 0.5 * np.pi},
        {"mounting_pitch_rad": 0.5 * np.pi, "mounting_roll_rad": 0.5},
        {"sample_rate_hz": 50.0},
        {"sample_rate_hz": 400.0},
        {"sensor_model": "consumer"},
    ],
    ids=str,
)
def test_however_the_card_is_worn_and_sampled(settings):
    errors = []
    for seed in (1, 2, 3):
        usual = {"walk": "rectangle", "walk_length_m": 44.0, "sensor_model": "icm_20602", "sample_rate_hz": 100.0}
        true = simulated_walk(SimulationParams(motion="chest", seed=seed, **(usual | settings)))
        errors.append(end_error_m(estimated(true.imu)[0], true))
    assert np.mean(errors) < 0.02 * 44.0


def test_one_nan_is_left_out_and_named():
    true = walk(4)
    gyro = true.imu.gyro_radps.copy()
    gyro[1000, 1] = np.nan
    nav, _, card = estimated(true.imu._replace(gyro_radps=gyro))
    assert all(np.isfinite(column).all() for column in nav)
    assert "not_finite" in [n.kind for n in card.notices]
    assert end_error_m(nav, true) < 0.04 * 24.0


def test_a_walk_without_a_rest_says_what_to_do():
    true = walk(1)
    nav, _, card = estimated(part(true.imu, 7 * RATE_HZ, 12 * RATE_HZ))
    assert np.isfinite(nav.position_m).all()
    assert "stand still" in next(n.text for n in card.notices if n.kind == "no_rest")


def test_a_clock_that_jumps_back_is_a_new_stream():
    true = walk(1)
    late = part(true.imu, 900)
    again = joined([part(true.imu, 0, 900), late._replace(stamp_ns=late.stamp_ns - 5_000_000_000)])
    nav, _, _ = estimated(again)
    assert np.isfinite(nav.position_m).all()


def test_the_heading_constraint_holds_a_straight_walk():
    """A gyro that turns by 0.15 deg/s more once the walk goes on: the line is held in its direction."""
    true = walk(5, 100.0, name="straight")
    drift = np.radians(0.15) * (true.imu.stamp_ns > 21.0e9)
    imu = true.imu._replace(gyro_radps=true.imu.gyro_radps + drift[:, None] * [0.0, 0.0, 1.0])
    free = end_error_m(estimated(imu)[0], true)
    worse_gyro = changed(Params(), "chest", bias_wander_radps=0.003)
    constrained = changed(worse_gyro, "heading", constraint="dominant", walking_direction="foot")
    held, _, card = estimated(imu, constrained)
    assert "heading_held" in [n.kind for n in card.notices]
    assert end_error_m(held, true) < 0.6 * free


def test_the_methods_are_three():
    ends = [
        estimated(walk(6).imu, params(method=m, step_direction="solved"))[0].position_m[-1]
        for m in ("improved", "traditional", "inertial")
    ]
    assert np.linalg.norm(ends[0] - ends[1]) > 0.01
    assert np.linalg.norm(ends[1] - ends[2]) > 0.001


def test_a_clean_field_bounds_the_heading():
    true, imu = compass_walk()
    worse_gyro = changed(Params(), "chest", bias_wander_radps=0.003)
    off = estimated(imu, changed(worse_gyro, "filter", magnetometer="off"))
    auto = estimated(imu, worse_gyro)
    assert off[2].health.field_use is FieldUse.NONE
    assert auto[2].health.field_use is FieldUse.HEADING
    assert yaw_off_deg(off[0], true) > 20.0
    assert yaw_off_deg(auto[0], true) < 8.0
    assert end_error_m(auto[0], true) < 0.5 * end_error_m(off[0], true)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_card_whose_x_axis_points_straight_up_or_down_has_a_heading_by_the_field_too(sign):
    """The yaw of x is nothing then, and so is an azimuth beside it."""
    _, imu = compass_walk()
    turn, _ = Rotation.align_vectors([[sign, 0.0, 0.0]], [imu.accel_mps2[: 40 * RATE_HZ].mean(axis=0)])
    accel, gyro, field = (turn.apply(v) for v in (imu.accel_mps2, imu.gyro_radps, imu.field_tesla))
    imu = imu._replace(accel_mps2=accel, gyro_radps=gyro, field_tesla=field)
    worse_gyro = changed(Params(), "chest", bias_wander_radps=0.003)
    bent = [bend_deg(estimated(imu, changed(worse_gyro, "filter", magnetometer=use))[1]) for use in ("off", "auto")]
    assert bent[0] > 20.0
    assert bent[1] < 8.0


def bend_deg(steps):
    """By how much the way turns from the 30th step to the last."""
    ways = [np.arctan2(*s.displacement_m[1::-1]) for s in (steps[30], steps[-8])]
    return abs(np.degrees(np.angle(np.exp(1j * (ways[1] - ways[0])))))


def test_a_field_that_is_never_measured_changes_nothing():
    imu = walk(1).imu
    with_it, without = (estimated(imu, changed(Params(), "filter", magnetometer=use))[0] for use in ("auto", "off"))
    assert_same(with_it, without)


def yaw_off_deg(nav, true):
    error = Rotation.from_quat(nav.quat_xyzw[-1]) * Rotation.from_quat(true.motion.quat_xyzw[length(nav) - 1]).inv()
    return abs(np.degrees(error.as_rotvec()[2]))


def test_with_a_field_stream_equals_batch_too():
    imu = part(compass_walk()[1], 0, 9000)
    whole = estimated(imu)[0]
    rng = np.random.default_rng(5)
    assert_same(whole, joined([o.nav for o in streamed(imu, iter(lambda: rng.integers(1, 999), None))]))


def test_before_the_first_rest_nothing_is_known_and_afterwards_nothing_exactly():
    """A filter that listens to the odometry neither believes a track that is none nor meets a variance of zero."""
    true = walk(1)
    walking = estimated(part(true.imu, 7 * RATE_HZ, 10 * RATE_HZ))[0]
    pose, twist = (np.sqrt(np.diagonal(c[-1])) for c in (walking.pose_covariance, walking.twist_covariance))
    assert pose[0] > 10.0
    assert np.all(pose[3:] > 3.0)
    assert twist[0] > 1.0
    nav, _, card = estimated(true.imu)
    assert nav.pose_covariance[RATE_HZ, 0, 0] < 0.01**2
    for covariance in (nav.pose_covariance, nav.twist_covariance):
        assert np.all(np.linalg.eigvalsh(covariance) > 0.0)
    assert card.health.quality > 0.5


def test_a_pose_that_is_told_before_the_first_rest_keeps_its_deviations():
    card = ChestCard(Params())
    card.run(part(walk(1).imu, 0, 10))
    card.place(PoseEstimate(np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), 0.04 * np.eye(6)))
    nav = card.run(part(walk(1).imu, 10, 2 * RATE_HZ)).nav
    assert nav.pose_covariance[-1, 0, 0] == pytest.approx(0.04)
    assert nav.pose_covariance[-1, 5, 5] == pytest.approx(0.04)

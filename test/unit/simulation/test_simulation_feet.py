"""Both feet of one person."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import FootInertial
from pdr_core.records import joined
from pdr_core.simulation import simulated_feet
from pdr_core.simulation.courses import strides
from pdr_core.simulation.gait import RUN, WALK
from pdr_core.simulation.two_feet import both_feet

EVERY = pytest.mark.parametrize("walk", ["straight", "rectangle", "curve", "corridor", "qiu_rectangle", "mixed"])
EVEN = {"placement_sd_m": 0.0}


def params(walk="straight", **more):
    return SimulationParams(**{"walk": walk, "sensor_model": "ideal", "walk_length_m": 30.0} | more)


def feet(walk="straight", **more):
    """The motions of the left and the right foot at 200 Hz."""
    p = params(walk, **more)
    paths = both_feet(strides(p.walk, p.walk_length_m, p.pace), p)
    return [path.at(np.arange(0.0, path.duration_s, 0.005)) for path in paths.values()]


def yaw_rad(motion):
    return np.unwrap(Rotation.from_quat(motion.quat_xyzw).as_euler("ZYX")[:, 0])


def stands(motion):
    """Where the foot stood and where it pointed, a row (x, y, yaw) for each stance."""
    flat = motion.still
    first = np.flatnonzero(flat & ~np.append(False, flat[:-1]))
    return np.column_stack([motion.position_m[first, :2], yaw_rad(motion)[first]])


def stride_m(motion):
    return np.linalg.norm(np.diff(stands(motion)[:, :2], axis=0), axis=1)


@pytest.mark.parametrize("share", [0.1, 0.2, 0.3])
def test_both_feet_are_on_the_ground_for_the_share_of_a_stride_that_is_asked(share):
    left, right = feet(double_support=share)
    toe_offs = np.flatnonzero(right.stance[:-1] & ~right.stance[1:])
    whole = slice(toe_offs[0], toe_offs[-1])
    assert np.mean((left.stance & right.stance)[whole]) == pytest.approx(share, abs=0.01)
    assert np.all(left.stance | right.stance)


def test_a_runner_flies_between_the_steps():
    left, right = feet("run")
    assert np.any(~left.stance & ~right.stance)
    assert RUN.with_double_support(0.2) == RUN
    assert WALK.with_double_support(0.2).duration_s == pytest.approx(WALK.duration_s)


def test_steps_alternate_and_the_first_and_the_last_are_half_strides():
    left, right = feet(**EVEN)
    toe_offs = [np.flatnonzero(m.stance[:-1] & ~m.stance[1:]) for m in (left, right)]
    assert len(toe_offs[0]) == len(toe_offs[1]) + 1
    assert np.all(toe_offs[0][:-1] < toe_offs[1])
    assert np.all(toe_offs[1] < toe_offs[0][1:])
    np.testing.assert_allclose(np.diff(toe_offs[0]) / 200.0, WALK.duration_s, atol=0.011)
    np.testing.assert_allclose(stride_m(left), [0.7, *[1.4] * (len(toe_offs[0]) - 2), 0.7], atol=1e-12)
    np.testing.assert_allclose(stride_m(right), 1.4, atol=1e-12)


def test_a_straight_walk_of_the_right_foot_mirrors_that_of_the_left():
    left, right = (stands(m) for m in feet(**EVEN))
    np.testing.assert_allclose(left[:, 1:], np.tile([0.1, 0.12], (len(left), 1)), atol=1e-12)
    np.testing.assert_allclose(right[:, 1:], np.tile([-0.1, -0.12], (len(right), 1)), atol=1e-12)
    outer_edge = [Rotation.from_quat(m.quat_xyzw).as_euler("ZYX")[:, 2] for m in feet(**EVEN, toe_out_rad=0.0)]
    assert outer_edge[0].max() == pytest.approx(0.1, abs=1e-3)
    assert outer_edge[1].min() == pytest.approx(-0.1, abs=1e-3)


@EVERY
def test_both_feet_begin_and_end_side_by_side_at_rest(walk):
    left, right = feet(walk)
    for m in (left, right):
        assert m.still[:599].all()
        assert m.still[-590:].all()
    np.testing.assert_allclose(left.position_m[0], [0.0, 0.1, 0.0], atol=1e-12)
    np.testing.assert_allclose(right.position_m[0], [0.0, -0.1, 0.0], atol=1e-12)
    heading_rad = 0.5 * (yaw_rad(left)[-1] + yaw_rad(right)[-1])
    across = np.array([-np.sin(heading_rad), np.cos(heading_rad), 0.0])
    np.testing.assert_allclose(left.position_m[-1] - right.position_m[-1], 0.2 * across, atol=1e-9)


@EVERY
def test_feet_are_never_nearer_nor_farther_than_legs_let_them(walk):
    left, right = feet(walk)
    apart_m = np.linalg.norm((left.position_m - right.position_m)[:, :2], axis=1)
    assert 0.12 < apart_m.min() < 0.2  # beside one another, also where a swing passes on the inside of a turn
    assert 0.5 < apart_m.max() < 1.15


def test_the_rectangle_closes_for_both_feet():
    for foot in feet("rectangle"):
        np.testing.assert_allclose(foot.position_m[-1], foot.position_m[0], atol=1e-9)
        assert yaw_rad(foot)[-1] - yaw_rad(foot)[0] == pytest.approx(2.0 * np.pi)


@EVERY
def test_turns_are_walked_and_no_foot_pivots_while_it_stands(walk):
    for foot in feet(walk):
        turned_rad = np.diff(yaw_rad(foot))[foot.stance[1:] & foot.stance[:-1]]
        assert np.abs(turned_rad).max() < 1e-12
        assert np.abs(np.diff(stands(foot)[:, 2])).max() < np.radians(95.0)


def test_in_a_curve_the_outer_foot_makes_the_longer_strides():
    inner, outer = (stride_m(m)[1:-1] for m in feet("curve", **EVEN))
    radius_m = 1.4 / (2.0 * np.sin(np.pi / 21))
    assert inner.mean() == pytest.approx(1.4 * (radius_m - 0.1) / radius_m, rel=1e-3)
    assert outer.mean() == pytest.approx(1.4 * (radius_m + 0.1) / radius_m, rel=1e-3)


def test_the_corridor_turns_both_ways_and_ends_as_it_began():
    yaw = np.degrees(yaw_rad(feet("corridor")[0]) - 0.12)
    assert yaw.max() == pytest.approx(90.0, abs=0.1)
    assert yaw.min() == pytest.approx(-90.0, abs=0.1)
    assert yaw[-1] == pytest.approx(0.0, abs=1e-9)


def test_a_person_who_walks_straight_makes_no_perfect_strides():
    heading_deg, length_m = [], []
    for seed in range(10):
        for foot in feet(walk_length_m=76.0, seed=seed):
            step = np.diff(stands(foot)[1:-1, :2], axis=0)
            heading_deg += list(np.degrees(np.arctan2(step[:, 1], step[:, 0])))
            length_m += list(np.linalg.norm(step, axis=1))
    assert np.std(heading_deg) == pytest.approx(np.degrees(np.sqrt(2.0) * 0.018 / 1.4), rel=0.1)
    assert np.mean(heading_deg) == pytest.approx(0.0, abs=0.1)
    assert np.std(length_m) == pytest.approx(np.sqrt(2.0) * 0.018, rel=0.1)


def test_both_truths_are_in_one_frame_and_on_one_clock():
    walks = simulated_feet(params("corridor"), start_ns=5)
    assert list(walks) == ["left", "right"]
    for walk, side in zip(walks.values(), (1.0, -1.0), strict=True):
        assert walk.imu.stamp_ns[0] == 5
        np.testing.assert_array_equal(walk.truth.position_m, walk.motion.position_m)
        assert walk.truth.position_m[0, 1] == pytest.approx(0.1 * side)
    np.testing.assert_array_equal(walks["left"].imu.stamp_ns, walks["right"].imu.stamp_ns)


@pytest.mark.parametrize("side", ["left", "right"])
@EVERY
def test_without_noise_the_chain_of_one_foot_returns_the_truth_of_each(walk, side):
    sim = simulated_feet(params(walk, output="means"))[side]
    yaw0_rad = float(yaw_rad(sim.motion)[0])
    told = changed(Params(), "filter", samples="means", initial_yaw_rad=yaw0_rad)
    chain = FootInertial(told)
    nav = joined([chain.run(sim.imu).nav, chain.finish().nav])
    error_m = nav.position_m - (sim.motion.position_m - sim.motion.position_m[0])
    assert np.linalg.norm(error_m, axis=1).max() < 0.002


def test_the_same_seed_is_the_same_walk_and_no_noise_is_shared():
    one, same, other = (simulated_feet(params(sensor_model="consumer", seed=seed)) for seed in (1, 1, 2))
    for side in ("left", "right"):
        np.testing.assert_array_equal(one[side].imu.accel_mps2, same[side].imu.accel_mps2)
        assert not np.array_equal(one[side].imu.accel_mps2, other[side].imu.accel_mps2)
    rest = [walk[side].imu.gyro_radps[:600] for walk in (one, other) for side in ("left", "right")]
    shared = np.corrcoef(np.array([r - r.mean(axis=0) for r in rest]).reshape(4, -1))
    assert np.abs(shared - np.eye(4)).max() < 0.1


def rest_means(sign, **more):
    """Mean rates and forces of the rest of both feet, (2, 3) each, without what each sensor has for itself."""
    walks = simulated_feet(
        params("still", sensor_model="consumer", feet_errors=sign, **{"feet_independent": 0.0} | more)
    )
    blocks = [walk.imu for walk in walks.values()]
    return [np.array([getattr(b, name).mean(axis=0) for b in blocks]) for name in ("gyro_radps", "accel_mps2")]


def test_mirrored_sensors_turn_to_opposite_sides_and_sensors_alike_to_the_same():
    rate, force = rest_means("mirrored")
    np.testing.assert_allclose(rate[1], rate[0] * [-1.0, 1.0, -1.0], atol=3e-4)
    np.testing.assert_allclose(force[1], force[0] * [1.0, -1.0, 1.0], atol=5e-3)
    rate, force = rest_means("alike")
    np.testing.assert_allclose(rate[1], rate[0], atol=3e-4)
    np.testing.assert_allclose(force[1], force[0], atol=5e-3)


def heading_drift_deg(**more):
    """By how much the chain turns the track of each foot too far until the end of a straight walk."""
    walks = simulated_feet(params(walk_length_m=76.0, feet_independent=0.0, **more))
    found = []
    for sim in walks.values():
        chain = FootInertial(Params())
        nav = joined([chain.run(sim.imu).nav, chain.finish().nav])
        turned = Rotation.from_quat(nav.quat_xyzw[-1]) * Rotation.from_quat(sim.motion.quat_xyzw[0])
        error = turned * Rotation.from_quat(sim.motion.quat_xyzw[-1]).inv()
        found.append(np.degrees(error.as_euler("ZYX")[0]))
    return found


def test_walking_shows_what_a_rest_does_not_and_it_is_symmetric():
    left_deg, right_deg = heading_drift_deg(sensor_model="g_sensitive")
    assert 1.5 < left_deg < 4.0
    assert right_deg == pytest.approx(-left_deg, abs=1.0)
    left_deg, right_deg = heading_drift_deg(sensor_model="g_sensitive", feet_errors="alike")
    assert right_deg == pytest.approx(left_deg, abs=1.0)
    assert np.abs(heading_drift_deg(sensor_model="consumer")).max() < 1.0  # the rest has shown these biases


def test_each_sensor_has_a_share_of_its_errors_for_itself():
    own = [np.diff(rest_means("alike", feet_independent=0.3, seed=seed)[0], axis=0)[0] for seed in range(60)]
    bias = np.array([0.0017, -0.0012, 0.0017])
    np.testing.assert_allclose(np.std(own, axis=0), np.sqrt(2.0) * 0.3 * np.abs(bias), rtol=0.35)


def test_both_feet_stand_in_the_field_of_one_building():
    field = {"magnetometer": True, "indoor_field": 0.25, "sensor_model": "ideal", "toe_out_rad": 0.0}
    near, far = (simulated_feet(params("still", **field, feet_apart_m=apart_m)) for apart_m in (0.05, 1.0))
    seen = [[walk.imu.field_tesla[0] for walk in walks.values()] for walks in (near, far)]
    assert np.linalg.norm(np.diff(seen[0], axis=0)) < 5e-6
    assert np.linalg.norm(np.diff(seen[0], axis=0)) < np.linalg.norm(np.diff(seen[1], axis=0))

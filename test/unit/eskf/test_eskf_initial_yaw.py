"""The yaw at the start by the magnetometer: what it is, how good it is, and where the field does not allow it."""

import numpy as np
import pytest
from filter_cases import G, judged, standing
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pdr_core.eskf import ZuptFilter
from pdr_core.eskf.error_state import ATTITUDE
from pdr_core.eskf.field_heading import H
from pdr_core.maths.quaternion import yaw_rad
from pdr_core.params import FilterParams, PlaceParams
from pdr_core.records import Level, part

GIVEN_RAD, NOISE_TESLA = 0.4, 5e-7
PARAMS = FilterParams(initial_yaw_source="magnetometer", initial_yaw_rad=GIVEN_RAD)
KNOWN = PlaceParams(field_norm_tesla=5e-5, field_dip_deg=60.0)
AXES = slice(ATTITUDE, ATTITUDE + 3)


def field(strength_tesla=5e-5, dip_deg=60.0, declination_deg=0.0):
    """Return a field in the world frame, (3,)."""
    dip, east = np.radians([dip_deg, declination_deg])
    return strength_tesla * np.array([np.cos(dip) * np.sin(east), np.cos(dip) * np.cos(east), -np.sin(dip)])


def rest(attitude, world_tesla, *, seconds=1.5, every=1, rng=None, offset=(0.0, 0.0, 0.0)):
    """Return the judged samples of a foot at rest in a field (3,) or (n, 3); each `every`-th has a field."""
    imu = standing(seconds)
    n = len(imu.stamp_ns)
    felt = attitude.inv().apply(np.broadcast_to(world_tesla, (n, 3))) + offset
    noise = 0.0 if rng is None else NOISE_TESLA * rng.standard_normal((n, 3))
    sd = np.where(np.arange(n) % every == 0, NOISE_TESLA, -1.0)
    force = np.tile(attitude.inv().apply([0.0, 0.0, G]), (n, 1))
    return judged(imu._replace(accel_mps2=force, field_tesla=felt + noise, field_sd_tesla=sd), np.ones(n))


def aligned(block, place=KNOWN, params=PARAMS):
    f = ZuptFilter(params, place)
    f.run(block)
    return f


def kinds(f):
    return {notice.kind: notice for notice in f.notices}


@pytest.mark.parametrize("yaw", [-3.0, -1.2, 0.0, 0.9, 2.8])
@pytest.mark.parametrize("mounting", [(0.0, 0.0), (0.3, -0.7), (3.1, 0.2)])
def test_the_yaw_is_counted_from_magnetic_east(yaw, mounting):
    attitude = Rotation.from_euler("ZYX", [yaw, mounting[1], mounting[0]])
    f = aligned(rest(attitude, field()))
    turn = (Rotation.from_quat(f.state.quat_xyzw) * attitude.inv()).as_rotvec()
    np.testing.assert_allclose(turn, 0.0, atol=1e-6)
    assert f.health.north_rad == pytest.approx(np.pi / 2)
    assert f"{np.degrees(yaw):+.1f} deg" in kinds(f)["initial_yaw"].text or abs(yaw) < 1e-9
    assert kinds(f)["initial_yaw"].level is Level.OK


def test_a_declination_makes_it_the_yaw_from_true_east():
    attitude = Rotation.from_euler("Z", 0.7)
    place = PlaceParams(field_norm_tesla=5e-5, field_dip_deg=60.0, field_declination_deg=12.0)
    f = aligned(rest(attitude, field(declination_deg=12.0)), place)
    assert yaw_rad(f.state.quat_xyzw) == pytest.approx(0.7, abs=1e-6)
    assert f.health.north_rad == pytest.approx(np.pi / 2 - np.radians(12.0))


@pytest.mark.parametrize("every", [1, 20, 66])
def test_a_slow_magnetometer_shows_it_too(every):
    rng = np.random.default_rng(1)
    f = aligned(rest(Rotation.from_euler("Z", 0.7), field(), every=every, rng=rng))
    assert yaw_rad(f.state.quat_xyzw) == pytest.approx(0.7, abs=4 * NOISE_TESLA / 2.5e-5)


def test_a_field_that_nobody_knows_is_believed_less():
    block = rest(Rotation.from_euler("Z", 0.7), field())
    known, unknown = aligned(block), aligned(block, PlaceParams())
    np.testing.assert_array_equal(unknown.state.quat_xyzw, known.state.quat_xyzw)
    assert np.degrees(known.health.yaw_sd_rad) == pytest.approx(5.0, abs=0.2)
    assert np.degrees(unknown.health.yaw_sd_rad) == pytest.approx(20.3, abs=0.2)


@pytest.mark.parametrize(
    ("why", "world", "offset"),
    [
        ("not steady", np.where(np.arange(300)[:, None] < 100, field(), field(declination_deg=9.0)), 0.0),
        ("differs from place", field(5.3e-5), 0.0),  # in strength
        ("differs from place", field(dip_deg=66.0), 0.0),
        ("differs from place", field(), 2e-5),  # not calibrated
        ("too steep", field(dip_deg=86.0), 0.0),
    ],
)
def test_a_disturbed_field_is_refused_and_the_start_stays_as_it_is(why, world, offset):
    check_refused(why, rest(Rotation.from_euler("Z", 0.7), world, offset=np.array([offset, 0.0, 0.0])), KNOWN)


def test_a_field_that_is_not_the_earths_is_refused():
    check_refused("not as strong", rest(Rotation.identity(), field(9e-5)), PlaceParams())


def test_no_field_and_a_moving_foot_are_named():
    block = rest(Rotation.identity(), field())
    none = block._replace(imu=block.imu._replace(field_sd_tesla=np.full(len(block.stance), -1.0)))
    check_refused("fewer than three", none, KNOWN)
    moving = np.where(np.arange(len(block.stance))[:, None] >= 60, 0.4, 0.0) * np.ones(3)
    check_refused("moved", block._replace(imu=block.imu._replace(gyro_radps=moving)), KNOWN)


def check_refused(why, block, place):
    f, plain = aligned(block, place), aligned(block, place, FilterParams(initial_yaw_rad=GIVEN_RAD))
    notice = kinds(f)["initial_yaw_given"]
    assert why in notice.text
    assert notice.level is Level.WARN
    turn = Rotation.from_quat(f.state.quat_xyzw) * Rotation.from_quat(plain.state.quat_xyzw).inv()
    assert abs(turn.as_rotvec()[2]) < 1e-3
    assert f.health.yaw_sd_rad < 0.02
    assert f.health.north_sd_rad == pytest.approx(np.pi)


def test_where_nobody_asks_nothing_changes():
    block = rest(Rotation.identity(), field())
    f = aligned(block, KNOWN, FilterParams(initial_yaw_rad=GIVEN_RAD))
    assert yaw_rad(f.state.quat_xyzw) == pytest.approx(GIVEN_RAD)
    assert not {"initial_yaw", "initial_yaw_given"} & set(kinds(f))


def test_sample_by_sample_it_is_the_same():
    block = rest(Rotation.from_euler("Z", 0.7), field(), every=7, rng=np.random.default_rng(2))
    whole, cut = aligned(block), ZuptFilter(PARAMS, KNOWN)
    for i in range(len(block.stance)):
        cut.run(part(block, i, i + 1))
    assert whole.state.tobytes() == cut.state.tobytes()


def test_a_handover_keeps_the_yaw_of_the_other_estimator():
    block = rest(Rotation.from_euler("Z", 0.7), field())
    f = aligned(block)
    f.reset(f.handover)
    f.run(rest(Rotation.from_euler("Z", 2.0), field()))
    assert yaw_rad(f.state.quat_xyzw) == pytest.approx(0.7, abs=1e-6)
    assert "initial_yaw" not in kinds(f)


def test_it_is_the_update_of_a_yaw_of_which_nothing_was_known():
    f = ZuptFilter(PARAMS, KNOWN)
    attitude = Rotation.from_euler("ZYX", [0.7, 0.2, -0.4])
    block = rest(attitude, field(), seconds=1.005)
    f.run(block)
    assert not f.state.aligning
    world = attitude.apply(block.imu.field_tesla[0])
    prior = np.diag(np.array([PARAMS.initial_tilt_sd_rad] * 2 + [1e4]) ** 2)
    h = H(world)[:, AXES]
    s2 = 0.07**2 + (NOISE_TESLA / 2.5e-5) ** 2 / f.state.compass_fields
    K = prior @ h.T / (h @ prior @ h.T + s2)
    np.testing.assert_allclose(f.state.P[AXES, AXES], (np.eye(3) - K @ h) @ prior, rtol=1e-5, atol=1e-8)


def test_tilt_and_yaw_are_as_uncertain_as_they_say():
    rng, runs, squares = np.random.default_rng(3), 400, []
    for _ in range(runs):
        attitude = Rotation.from_euler("ZYX", rng.uniform([-3, -0.8, -0.8], [3, 0.8, 0.8]))
        tilt = Rotation.from_rotvec([*(PARAMS.initial_tilt_sd_rad * rng.standard_normal(2)), 0.0])
        iron = Rotation.from_rotvec([0.0, 0.0, 0.07 * rng.standard_normal()])
        block = rest(attitude, iron.apply(field()), seconds=1.005)
        wrong = np.tile((tilt * attitude).inv().apply([0.0, 0.0, G]), (len(block.stance), 1))
        loose = PlaceParams(field_norm_tesla=5e-5, field_dip_deg=60.0)
        params = FilterParams(initial_yaw_source="magnetometer", field_dip_tolerance_rad=0.5)
        f = aligned(block._replace(imu=block.imu._replace(accel_mps2=wrong)), loose, params)
        error = (attitude * Rotation.from_quat(f.state.quat_xyzw).inv()).as_rotvec()
        squares.append(error @ np.linalg.solve(f.state.P[AXES, AXES], error))
    low, high = chi2.ppf([0.025, 0.975], 3 * runs) / runs
    assert low < np.mean(squares) < high

"""What a quiet stance in a magnetic field tells the filter."""

import numpy as np
import pytest
from filter_cases import copied, injected, random_state, transition
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pdr_core.eskf import field_change, field_heading, field_places, quiet_field, rare_bias
from pdr_core.eskf.configure import settings
from pdr_core.eskf.error_state import ATTITUDE, GYRO_BIAS, SIZE
from pdr_core.eskf.field_updates import field_changed, heading_corrected, stand_in_field
from pdr_core.eskf.navigate import Sample, predict
from pdr_core.eskf.quiet_field import QuietField
from pdr_core.eskf.state import PLACES
from pdr_core.eskf.step_events import stand
from pdr_core.eskf.updates import correct_heading
from pdr_core.params import Params, PlaceParams
from support.fields import DIP_RAD, NORM_TESLA, earth_field

SEEDS = st.integers(0, 2**32 - 1)
SETTINGS = settings(Params().filter, PlaceParams())
FIELD = SETTINGS.field
MS = 1_000_000


def window(state, field_world, rate, bias, seconds=0.5, every=1):
    """Let a foot stand in a field while it turns at a true rate; return what the window has shown."""
    attitude, dt = Rotation.from_quat(state.quat_xyzw), 0.005
    for i in range(round(seconds / dt) + 1):
        now_ns = i * 5 * MS
        field = (attitude * Rotation.from_rotvec(np.multiply(rate, i * dt))).inv().apply(field_world)
        quiet_field.gather(now_ns, rate + bias, field, 1e-7 if i % every == 0 else -1.0, state)
        state.last_ns, state.last_rate_radps[:] = now_ns, rate + bias
    assert quiet_field.told(state)
    return quiet_field.shown(state)


@given(SEEDS)
def test_the_change_of_a_constant_field_is_what_the_bias_makes_it(seed):
    rng = np.random.default_rng(seed)
    state = random_state(rng)
    rate, error = rng.uniform(-0.1, 0.1, 3), rng.uniform(-1e-4, 1e-4, 3)
    field = window(state, earth_field(rng.uniform(0, 6)), rate, state.gyro_bias_radps + error)
    e = np.zeros(SIZE)
    e[GYRO_BIAS:] = error
    np.testing.assert_allclose(field.change_tesla_per_s, field_change.H(field.mean_tesla) @ e, atol=2e-10)
    np.testing.assert_allclose(field.turned_radps, rate - error * 0.0, atol=2e-4)


@pytest.mark.parametrize("every", [1, 4, 20])
def test_a_slow_magnetometer_tells_less_and_nothing_else(every):
    state = random_state(np.random.default_rng(1))
    rate, error = np.array([0.02, -0.1, 0.05]), np.array([1e-3, -2e-3, 5e-4])
    fast = window(copied(state), earth_field(1.0), rate, state.gyro_bias_radps + error, seconds=1.0)
    slow = window(copied(state), earth_field(1.0), rate, state.gyro_bias_radps + error, seconds=1.0, every=every)
    np.testing.assert_allclose(slow.change_tesla_per_s, fast.change_tesla_per_s, atol=2e-9)
    assert slow.change_sd == pytest.approx(fast.change_sd * every**0.5, rel=0.15)


@given(SEEDS)
def test_the_field_is_handed_on_in_the_axes_of_now(seed):
    rng = np.random.default_rng(seed)
    state, rate, world = random_state(rng), rng.uniform(-0.1, 0.1, 3), earth_field(2.0)
    state.gyro_bias_radps[:] = 0.0
    begin = Rotation.from_quat(state.quat_xyzw)
    field = window(state, world, rate, np.zeros(3))
    now = (begin * Rotation.from_rotvec(rate * 0.5)).inv().apply(world)
    np.testing.assert_allclose(field.field_now_tesla, now, atol=1e-12)


@given(SEEDS)
def test_the_jacobian_of_the_azimuth_is_what_a_correction_does_to_it(seed):
    rng = np.random.default_rng(seed)
    state = random_state(rng)
    state.north_rad = rng.uniform(-3, 3)
    felt = Rotation.from_quat(state.quat_xyzw).inv().apply(earth_field(rng.uniform(0, 6)))

    def world(s):
        return Rotation.from_quat(s.quat_xyzw).apply(felt)

    H = field_heading.H(world(state))
    for column in range(SIZE):
        e = np.eye(SIZE)[column] * 1e-5
        lower = field_heading.residual(world(injected(state, -e)), state)
        lower = lower - field_heading.residual(world(injected(state, e)), state)
        np.testing.assert_allclose((lower + np.pi) % (2 * np.pi) - np.pi, 2.0 * H[:, :SIZE] @ e, atol=1e-9)
    state.north_rad += 1e-3  # the last column: north itself
    np.testing.assert_allclose(H[0, SIZE], -1.0)


def with_ends(state):
    """Return the covariance (22, 22) of errors, north and the position errors at the last stance end."""
    P = np.zeros((SIZE + 4, SIZE + 4))
    P[: SIZE + 1, : SIZE + 1] = field_heading.with_north(state)
    ends = np.vstack([state.cross[:, 3:], state.north_ends[:, 3:]])
    P[: SIZE + 1, SIZE + 1 :], P[SIZE + 1 :, : SIZE + 1] = ends, ends.T
    P[SIZE + 1 :, SIZE + 1 :] = state.end_covariance[1]
    return P


@given(SEEDS)
def test_north_is_learnt_as_the_sixteenth_state_of_one_filter(seed):
    rng = np.random.default_rng(seed)
    state = random_state(rng)
    stand(0, state)
    state.P[ATTITUDE : ATTITUDE + 3] *= 3.0  # what has happened since
    state.P[:, ATTITUDE : ATTITUDE + 3] *= 3.0
    state.cross[ATTITUDE : ATTITUDE + 3] *= 3.0
    world = earth_field(rng.uniform(0, 6))
    assert heading_corrected(world, FIELD, state)  # finds north
    H, sd = field_heading.H(world), FIELD.heading_sd_rad
    found = H[:, :SIZE]
    np.testing.assert_allclose(state.north_cross, state.P @ found.T, atol=1e-12)
    np.testing.assert_allclose(state.north_variance, (found @ state.P @ found.T)[0, 0] + sd**2)
    np.testing.assert_allclose(state.north_ends, found @ state.cross, atol=1e-12)
    before, P = copied(state), with_ends(state)
    turned = Rotation.from_rotvec([0.0, 0.0, 0.05]).apply(world)
    assert heading_corrected(turned, FIELD, state)
    H = np.hstack([field_heading.H(turned), np.zeros((1, 3))])
    S = H @ P @ H.T + PLACES * sd**2
    K = P @ H.T / S
    np.testing.assert_allclose(with_ends(state), P - K @ H @ P, atol=1e-9)
    shift = K[:, 0] * -0.05
    np.testing.assert_allclose(state.end_position_m[1] - before.end_position_m[1], shift[SIZE + 1 :], atol=1e-9)
    np.testing.assert_allclose(state.position_m - before.position_m, shift[:3], atol=1e-9)
    assert state.north_rad - before.north_rad == pytest.approx(shift[SIZE], abs=1e-9)


def test_what_is_known_together_with_north_moves_with_the_errors():
    state = walker(PLACES)
    state.last_ns, state.last_force_mps2[:], state.gravity_mps2 = 0, [1.0, -2.0, 9.0], 9.8
    before = state.north_cross.copy()
    none = (0.0, 0.0, 0.0)
    now = Sample(5 * MS, (3.0, 1.0, 8.0), (0.5, 2.0, -1.0), 0.1, 0.01, False, 0.0, none, 0.0, none, -1.0)
    k = predict(now, SETTINGS, state)
    assert np.abs(before).max() > 0.0
    np.testing.assert_allclose(state.north_cross, transition(k) @ before, atol=1e-15)


def stands_in(state, world_tesla, step_m=1.0):
    """Let the foot stand a step farther on in a field without noise."""
    state.position_m[0] += step_m
    felt = tuple(Rotation.from_quat(state.quat_xyzw).inv().apply(world_tesla))
    still = QuietField(felt, (0.0, 0.0, 0.0), 1e-6, (0.0, 0.0, 0.0), felt)
    stand_in_field(still, FIELD, state)


def walker(places, world_tesla=None):
    """Return a filter that has stood at so many places in the same field."""
    state = random_state(np.random.default_rng(3))
    state.P[:] = np.diag(np.repeat([1e-4, 1e-4, 4e-4, 1e-4, 1e-6], 3))
    for _ in range(places):
        stands_in(state, earth_field(0.7) if world_tesla is None else world_tesla)
    return state


def test_a_field_is_a_compass_once_enough_places_agree():
    assert walker(PLACES - 1).field_use == field_places.CHANGE
    state = walker(PLACES)
    assert state.field_use == field_places.HEADING
    assert state.north_rad == pytest.approx(0.7)
    correct_heading(-0.3, 1e-4, state)  # somebody turns the track: the places turn along
    state.north_rad += 0.3
    stands_in(state, Rotation.from_rotvec([0, 0, 0.3]).apply(earth_field(0.7)))
    assert state.field_use == field_places.HEADING


@pytest.mark.parametrize(
    "bent",
    [
        Rotation.from_rotvec([0.0, 0.0, 0.15]).apply(earth_field(0.7)),
        earth_field(0.7) * 1.05,
        Rotation.from_rotvec(0.06 * np.array([-np.sin(0.7), np.cos(0.7), 0.0])).apply(earth_field(0.7)),
    ],
    ids=["azimuth", "strength", "dip"],
)
def test_a_place_that_disagrees_takes_the_compass_away_until_it_is_forgotten(bent):
    state = walker(PLACES + 3)
    yaw = Rotation.from_quat(state.quat_xyzw).as_rotvec()
    stands_in(state, bent)
    assert state.field_use == field_places.CHANGE
    np.testing.assert_array_equal(Rotation.from_quat(state.quat_xyzw).as_rotvec(), yaw)
    for _ in range(PLACES - 1):
        stands_in(state, earth_field(0.7))
        assert state.field_use == field_places.CHANGE
    stands_in(state, earth_field(0.7))
    assert state.field_use == field_places.HEADING


def test_a_compass_that_changes_with_the_heading_is_none():
    state = walker(PLACES)
    for _ in range(3 * PLACES):  # after a turn an uncalibrated magnetometer shows another strength, the same everywhere
        stands_in(state, earth_field(0.7) * 1.06)
        assert state.field_use == field_places.CHANGE


def test_the_field_that_a_calibration_has_found_is_the_one_that_counts():
    known = FIELD._replace(norm_tesla=NORM_TESLA * 1.1, dip_rad=DIP_RAD)
    state = walker(PLACES)
    assert field_places.clean(FIELD, state)
    assert not field_places.clean(known, state)
    assert not field_places.clean(known._replace(norm_tesla=NORM_TESLA, dip_rad=0.9), state)
    assert field_places.clean(known._replace(norm_tesla=NORM_TESLA), state)


def test_a_foot_that_stays_at_a_place_does_not_count_it_twice():
    state = walker(1)
    for _ in range(3 * PLACES):
        stands_in(state, earth_field(0.7), step_m=0.0)
    assert state.places == 1


def test_a_field_that_changes_by_itself_is_left_out():
    state = walker(0)
    tram = QuietField((2e-5, 0.0, -4e-5), (5e-6, 5e-6, 0.0), 1e-7, (0.0, 0.0, 0.0), (2e-5, 0.0, -4e-5))
    field_changed(tram, FIELD, state)
    assert (state.field_rejected, state.field_windows, state.field_use) == (1, 0, field_places.NONE)
    field_changed(tram._replace(change_tesla_per_s=(5e-9, 5e-9, 0.0)), FIELD, state)
    assert (state.field_rejected, state.field_windows, state.field_use) == (1, 1, field_places.CHANGE)


def rested(field_bias, rest_bias=(0.0, 0.0, 0.02)):
    """Return a filter after a rest, of which the field speaks for one bias."""
    state = walker(0)
    state.gyro_bias_radps[:] = 0.0
    m = earth_field(0.7)
    change = tuple(np.cross(field_bias, m))
    rare_bias.testify(QuietField(tuple(m), change, 1e-8, (0.0, 0.0, 0.0), tuple(m)), 1e-8, state)
    return rare_bias.agrees(rest_bias, 0.001, state), state


def test_a_rare_bias_needs_two_witnesses():
    assert rested((0.0, 0.0, 0.02))[0]
    assert not rested((0.0, 0.0, 0.0))[0]
    assert not rare_bias.agrees((0.0, 0.0, 0.02), 0.001, walker(0))  # no field at all
    along = 0.02 * earth_field(0.7) / NORM_TESLA
    assert rested((0.0, 0.0, 0.0), tuple(along))[0]  # what lies along the field nobody can tell


def test_a_rare_bias_widens_its_own_axis_and_is_open_to_stances():
    _, state = rested((0.0, 0.0, 0.02))
    usual = np.full(SIZE, 0.0035)
    before = state.P[GYRO_BIAS:, GYRO_BIAS:].copy()
    rare_bias.widen((0.004, 0.0, 0.02), 0.001, usual, state)
    np.testing.assert_array_equal(np.diag(state.P)[GYRO_BIAS : GYRO_BIAS + 2], np.diag(before)[:2])
    assert state.P[SIZE - 1, SIZE - 1] == pytest.approx(0.02**2 - 0.001**2)
    assert state.bias_is_rare

"""The track without a filter on accelerations that are known exactly."""

import numpy as np
import pytest

from pdr_core.strapdown.dedrift import LONGEST_NS, track
from pdr_core.strapdown.swing import Accelerations, Track, empty_track, fresh_state, leave_open

RATE_HZ, SWING_S, STAND_S = 200, 0.6, 0.4
BIAS = np.array([0.3, -0.2, 0.1])


def walked(strides, bias=BIAS, rolling_mps=0.0):
    """A foot that goes 1.2 m a stride along x, 0.1 m up and down again; its acceleration is off by `bias`."""
    swing, stand = round(SWING_S * RATE_HZ), round(STAND_S * RATE_HZ)
    share = np.arange(1, swing + 1) / swing
    x = 1.2 * (share - np.sin(2 * np.pi * share) / (2 * np.pi))
    z = 0.1 * np.sin(np.pi * share) ** 4
    accel_x = 1.2 * 2 * np.pi / SWING_S**2 * np.sin(2 * np.pi * share)
    angle = np.pi * share
    accel_z = 0.4 * (np.pi / SWING_S) ** 2 * (3 * np.sin(angle) ** 2 * np.cos(angle) ** 2 - np.sin(angle) ** 4)
    position, accel, stance = [np.zeros((stand, 3))], [np.zeros((stand, 3))], [np.ones(stand, bool)]
    for k in range(strides):
        position += [np.column_stack([1.2 * k + x, 0 * x, z]), np.tile([1.2 * (k + 1), 0, 0], (stand, 1))]
        accel += [np.column_stack([accel_x, 0 * x, accel_z]), np.zeros((stand, 3))]
        stance += [np.arange(swing) == swing - 1, np.ones(stand, bool)]
    n = sum(map(len, stance))
    stamps, still = np.arange(n, dtype=np.int64) * 10**9 // RATE_HZ, np.tile([rolling_mps, 0.0, 0.0], (n, 1))
    moved = np.concatenate(accel) + np.where(np.concatenate(stance)[:, None], 0.0, bias)
    whole = np.arange(n) > 0
    block = Accelerations(stamps, moved, np.ones(n), still, np.full(n, 0.01), np.concatenate(stance), whole)
    return block, np.concatenate(position)


def part(block, a, b=None):
    return type(block)(*(column[a:b] for column in block))


def run(block, pieces=None):
    state, out, waiting, held = fresh_state(), [], 0, part(block, 0, 0)
    ends = pieces or [len(block.stance)]
    for a, b in zip([0, *ends], [*ends, len(block.stance)], strict=True):
        held = Accelerations(*map(np.concatenate, zip(held, part(block, a, b), strict=True)))
        found = empty_track(len(held.stance))
        done = track(held, waiting, state, found)
        out.append(part(found, 0, done))
        held, waiting = part(held, done), len(held.stance) - done
    found = empty_track(len(held.stance))
    leave_open(held, 0, len(held.stance), state, found)
    return Track(*map(np.concatenate, zip(*out, found, strict=True))), state


def test_a_steady_error_of_the_acceleration_is_taken_off_exactly():
    block, true_m = walked(3)
    found, state = run(block)
    np.testing.assert_allclose(found.position_m, true_m, atol=2e-3)
    np.testing.assert_allclose(found.velocity_mps[block.stance], 0.0, atol=0.0)
    assert found.closed.all()
    assert state.open == 0
    standing = block.stance & np.roll(block.stance, 1)
    assert np.all(np.diff(found.position_m, axis=0)[standing[1:]] == 0.0)


def test_without_that_the_error_would_be_large_and_is_shown():
    block, _ = walked(3)
    found, _ = run(block)
    np.testing.assert_allclose(found.free_mps[-1], 3 * BIAS * SWING_S, rtol=0.02)
    clean, _ = run(walked(3, bias=np.zeros(3))[0])
    np.testing.assert_allclose(clean.position_m, found.position_m, atol=2e-3)
    np.testing.assert_allclose(clean.free_mps, clean.velocity_mps, atol=1e-9)


def test_eq_23_as_printed_counts_the_acceleration_twice_and_gravity_in_it():
    accel, g, tau = np.array([2.0, 0.0, 0.0]), np.array([0.0, 0.0, 9.81]), 1.0 / RATE_HZ
    right, printed, v = np.zeros(3), np.zeros(3), np.zeros(3)
    for _ in range(RATE_HZ):
        after = v + tau / 2 * (2 * (accel + g) - 2 * g)
        right += tau / 2 * (v + after)
        printed += tau / 2 * (v + after) + (accel + g) * tau**2 / 2
        v = after
    np.testing.assert_allclose(right, accel / 2, atol=1e-12)  # a t^2 / 2
    np.testing.assert_allclose(printed - right, (accel + g) * tau / 2, atol=1e-12)


def test_what_comes_with_one_interval_is_taken_off_there():
    block, true_m = walked(2, bias=np.zeros(3))
    at = round((STAND_S + 0.9 * SWING_S) * RATE_HZ)
    block.accel_mps2[at] += [80.0, 0.0, -40.0]
    steady, _ = run(block)
    where = np.where(np.isin(np.arange(len(block.stance)), [at, at + 1]), 1e3, 1e-3)
    known, _ = run(block._replace(drift=where))
    assert np.abs(steady.position_m - true_m).max() > 0.05
    assert np.abs(known.position_m - true_m).max() < 4e-3


def test_a_rolling_foot_rolls_on():
    block, true_m = walked(1, bias=np.zeros(3), rolling_mps=0.02)
    found, _ = run(block)
    assert found.position_m[-1, 0] - true_m[-1, 0] > 0.01
    np.testing.assert_array_equal(found.velocity_mps[block.stance][:, 0], 0.02)


@pytest.mark.parametrize("pieces", [[1], [100, 101, 102], [99, 180, 181, 300], list(range(1, 400, 7))])
def test_cutting_anywhere_changes_nothing(pieces):
    block, _ = walked(2)
    for one, other in zip(run(block)[0], run(block, pieces)[0], strict=True):
        np.testing.assert_array_equal(one, other)


def test_a_swing_that_does_not_end_is_left_as_it_is_and_counted():
    block, true_m = walked(2)
    cut = round((STAND_S + 1.2 * SWING_S + STAND_S) * RATE_HZ)
    found, state = run(part(block, 0, cut))
    assert len(found.position_m) == cut
    assert state.open == 1
    assert not found.closed[-1]
    assert np.abs(found.position_m[-1] - true_m[cut - 1]).max() < 0.02
    assert np.all(np.diff(found.moved_sd_m[-10:]) > 0.0)


def test_after_a_gap_the_position_is_held_until_the_foot_stands():
    block, _ = walked(3)
    gap = round((STAND_S + 0.5 * SWING_S) * RATE_HZ)
    block.whole[gap] = False
    found, state = run(block)
    stands_again = gap + np.flatnonzero(block.stance[gap:])[0]
    assert np.all(found.position_m[gap:stands_again] == found.position_m[gap - 1])
    assert np.all(found.velocity_mps[gap:stands_again] == 0.0)
    assert np.all(np.isinf(found.velocity_sd_mps[gap:stands_again]))
    assert state.open == 1
    end_m = found.position_m[-1] - found.position_m[stands_again]
    np.testing.assert_allclose(end_m, [2.4, 0.0, 0.0], atol=2e-3)


def test_a_swing_that_lasts_too_long_is_given_out_in_time():
    n = 2 * LONGEST_NS // 5_000_000
    block, _ = walked(0)
    still = part(block, 0, 10)
    flying = Accelerations(
        still.stamp_ns[-1] + 5_000_000 * np.arange(1, n + 1),
        np.zeros((n, 3)),
        np.ones(n),
        np.zeros((n, 3)),
        np.full(n, 0.01),
        np.zeros(n, bool),
        np.ones(n, bool),
    )
    both = Accelerations(*map(np.concatenate, zip(still, flying, strict=True)))
    found = empty_track(len(both.stance))
    state = fresh_state()
    assert track(both, 0, state, found) == len(both.stance)
    assert state.open == 1


def test_a_stance_that_cannot_be_is_not_believed_unless_it_goes_on():
    block, true_m = walked(2, bias=np.zeros(3))
    middle = round((STAND_S + 0.5 * SWING_S) * RATE_HZ)
    block.stance[middle : middle + 6] = True
    found, _ = run(block)
    np.testing.assert_allclose(found.position_m, true_m, atol=2e-3)
    assert not found.stands[middle]
    block.stance[middle - 30 : middle + 30] = True
    persistent, _ = run(block)
    assert persistent.stands[middle + 25]


def test_the_deviation_is_that_of_a_walk_whose_end_is_known():
    """White noise of the acceleration, many times over, against the formula with the true variance in place of e^2."""
    rng, n, sigma = np.random.default_rng(5), 120, 2.0
    block, true_m = walked(1, bias=np.zeros(3))
    first = round(STAND_S * RATE_HZ)
    errors, said = [], []
    for _ in range(400):
        noisy = block._replace(accel_mps2=block.accel_mps2.copy(), still_sd_mps=np.full(len(block.stance), 1e-9))
        noisy.accel_mps2[first : first + n] += sigma * rng.standard_normal((n, 3))
        found, _ = run(noisy)
        errors.append(found.position_m[first + n - 1] - true_m[first + n - 1])
        said.append(found.moved_sd_m[first + n - 1] ** 2)
    clean, _ = run(block)
    errors = np.array(errors) - (clean.position_m - true_m)[first + n - 1]
    assert np.sqrt(np.mean(said)) == pytest.approx(errors.std(), rel=0.1)

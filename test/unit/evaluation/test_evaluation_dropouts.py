import numpy as np

from pdr_core.evaluation import dropouts

PERIOD_NS = 5_000_000


def walk(n=40):
    """1 m/s along x with the small noise of cameras."""
    return np.column_stack([np.arange(n) * 0.005, np.zeros(n), np.zeros(n)])


def measured(position_m):
    return dropouts.measured(np.arange(len(position_m)) * PERIOD_NS, position_m)


def test_a_clean_truth_is_kept_whole():
    assert measured(walk()).all()


def test_five_equal_rows_are_masked_and_four_are_not():
    position_m = walk()
    position_m[10:15] = position_m[10]
    position_m[20:24] = position_m[20]
    assert np.flatnonzero(~measured(position_m)).tolist() == [10, 11, 12, 13, 14]


def test_a_dropout_at_the_start_and_two_in_a_row():
    position_m = walk()
    position_m[:5], position_m[5:11] = position_m[0], position_m[5]
    assert np.flatnonzero(~measured(position_m)).tolist() == list(range(11))


def test_both_ends_of_a_jump_are_masked():
    position_m = walk()
    position_m[20:, 1] += 12.1 * 0.005
    assert np.flatnonzero(~measured(position_m)).tolist() == [19, 20]
    position_m = walk()
    position_m[20:, 1] += 11.8 * 0.005
    assert measured(position_m).all()


def test_a_person_standing_still_before_cameras_is_kept():
    noise = np.random.default_rng(1).normal(0, 1e-5, (500, 3))
    assert measured(noise).all()


def test_a_truth_that_never_moves_is_rest():
    assert measured(np.zeros((50, 3))).all()


def test_what_is_not_finite_is_no_measurement():
    position_m = walk()
    position_m[7, 2] = np.nan
    assert np.flatnonzero(~measured(position_m)).tolist() == [7]


def test_no_rows_give_no_rows():
    assert measured(np.empty((0, 3))).shape == (0,)

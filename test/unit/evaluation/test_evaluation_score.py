import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.evaluation import metrics
from pdr_core.evaluation.score import Scorer, in_order
from pdr_core.records import Truth, TruthKind, part

NO_STAMPS = np.empty(0, dtype=np.int64)
SECOND = 10**9
SQUARE_M = np.array([[0.0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]])


def scored(truth, *blocks, steps=(), start_m=(0.0, 0.0, 0.0)):
    scorer = Scorer(truth)
    for block in blocks:
        scorer.add(block)
    return scorer.score(steps, np.array(start_m))


def position(stamp_ns, position_m):
    return Truth(TruthKind.POSITION, np.asarray(stamp_ns, dtype=np.int64), np.asarray(position_m, dtype=float))


def test_without_truth_there_is_no_score_but_a_closure(make):
    scorer = Scorer(None)
    scorer.add(make.nav_block([0, 1], [[1, 1, 1], [4, 5, 13]]))
    assert scorer.score([], np.zeros(3)) is None
    assert scorer.view([], np.zeros(3)) is None
    assert (scorer.closure_2d_m, scorer.closure_3d_m) == (5.0, 13.0)
    np.testing.assert_array_equal(scorer.end_position_m, [4, 5, 13])


def test_before_any_estimate_everything_is_unknown():
    scorer = Scorer(position([0, SECOND], SQUARE_M[:2]))
    assert math.isnan(scorer.closure_2d_m)
    assert math.isnan(scorer.score([], np.zeros(3)).ate2_m)
    assert scorer.view([], np.zeros(3)) is None


def test_the_truth_itself_scores_zero(make):
    walk = make.rectangle()
    score = scored(position(walk.stamp_ns, walk.true_m), make.nav_block(walk.stamp_ns, walk.true_m))
    assert (score.ate2_m, score.ate3_m, score.end_error_percent) == pytest.approx((0, 0, 0), abs=1e-9)


def test_truth_between_the_estimates_is_met_by_interpolation(make):
    """Estimates every second on a straight line, truth at thirds of seconds: no error; outside: not used."""
    stamps = np.arange(-2, 40) * (SECOND // 3)
    line = np.outer(stamps / SECOND, [1.0, 0.5, 0.1])
    line[:2] += 100.0  # before the estimate begins
    whole = np.arange(11) * SECOND
    score = scored(position(stamps, line), make.nav_block(whole, np.outer(whole / SECOND, [1.0, 0.5, 0.1])))
    assert (score.ate2_m, score.ate3_m, score.end_error_m) == pytest.approx((0, 0, 0), abs=1e-9)


def test_truth_with_dropouts_starts_at_its_first_measurement(make):
    walk = make.rectangle()
    true_m = walk.true_m.copy()
    true_m[:40] = [50.0, 50.0, 50.0]
    true_m[700:780] = true_m[700]
    score = scored(position(walk.stamp_ns, true_m), make.nav_block(walk.stamp_ns, walk.true_m))
    assert (score.ate2_m, score.ate3_m, score.end_error_percent) == pytest.approx((0, 0, 0), abs=1e-9)


def test_a_constant_offset_in_part_of_the_track(make):
    """Rows +-1 m in z about the truth: ATE3 1 m, ATE2 0."""
    high = SQUARE_M + np.outer([1, -1, 1, -1], [0, 0, 1.0])
    stamps = np.arange(4) * SECOND
    score = scored(position(stamps, SQUARE_M), make.nav_block(stamps, high))
    assert score.ate2_m == pytest.approx(0, abs=1e-9)
    assert score.ate3_m == pytest.approx(1.0)


def test_an_estimate_that_fails_is_not_hidden(make):
    walk = make.rectangle()
    lost = walk.true_m.copy()
    lost[1000:] = np.nan
    assert math.isnan(scored(position(walk.stamp_ns, walk.true_m), make.nav_block(walk.stamp_ns, lost)).ate2_m)


def test_strides_are_paired_in_order_over_the_common_length(make):
    true_m = np.array([[0.0, 0], [2, 0], [4, 0], [6, 0], [8, 0], [8, 2]])
    truth = Truth(TruthKind.STRIDES, NO_STAMPS, true_m)
    full = scored(truth, steps=make.steps_at(true_m))
    assert (full.ate2_m, full.end_error_percent, full.stride_count_true) == pytest.approx((0, 0, 5), abs=1e-9)
    assert full.stride_ate2_m == full.ate2_m
    assert math.isnan(full.ate3_m)
    fewer = scored(truth, steps=make.steps_at(true_m[:4]))
    assert (fewer.ate2_m, fewer.stride_count_true) == pytest.approx((0, 5), abs=1e-9)
    more = scored(truth, steps=make.steps_at(np.vstack([true_m, [[8, 4], [90, 90]]])))
    assert (more.ate2_m, more.stride_count_true) == pytest.approx((0, 5), abs=1e-9)


def test_strides_use_the_given_start_and_ten_metres(make):
    """All strides 10 % too long on a line of 20 m: 2 m at the end, 10 %."""
    true_m = np.column_stack([np.arange(0, 21, 2.0), np.zeros(11)])
    steps = make.steps_at(1.1 * true_m + 5.0)
    score = scored(Truth(TruthKind.STRIDES, NO_STAMPS, true_m), steps=steps, start_m=(5.0, 5.0, 0.0))
    assert (score.end_error_m, score.end_error_percent) == pytest.approx((2.0, 10.0))


def test_the_yaw_at_the_start_comes_from_three_metres_or_ten_of_strides(make):
    rng = np.random.default_rng(9)
    true_m = np.column_stack([np.arange(21.0), np.zeros(21), np.zeros(21)])
    estimate_m = true_m + rng.normal(0, 0.1, true_m.shape)
    stamps = np.arange(21) * SECOND
    along = scored(position(stamps, true_m), make.nav_block(stamps, estimate_m))
    strides = Truth(TruthKind.STRIDES, NO_STAMPS, true_m[:, :2])
    by_stride = scored(strides, steps=make.steps_at(estimate_m), start_m=estimate_m[0])
    assert along.end_error_percent == pytest.approx(metrics.end_error_percent(estimate_m, true_m, 3.0))
    assert by_stride.end_error_percent == pytest.approx(metrics.end_error_percent(estimate_m, true_m, 10.0))
    assert abs(along.end_error_percent - by_stride.end_error_percent) > 0.1


def test_a_missed_first_stride_shifts_every_pair(make):
    true_m = np.array([[0.0, 0], [1, 0], [3, 0], [5, 0], [5, 2]])
    score = scored(Truth(TruthKind.STRIDES, NO_STAMPS, true_m), steps=make.steps_at(true_m[1:]), start_m=(1.0, 0, 0))
    assert score.ate2_m > 0.3


def test_no_strides_at_all_is_unknown():
    score = scored(Truth(TruthKind.STRIDES, NO_STAMPS, SQUARE_M[:, :2]))
    assert math.isnan(score.ate2_m)
    assert score.stride_count_true == 3


def test_a_closed_loop_is_judged_by_its_closure(make):
    truth = Truth(TruthKind.CLOSED_LOOP, NO_STAMPS, np.empty((0, 3)))
    steps = make.steps_at(np.vstack([SQUARE_M, [[0.3, 0.4, 2.0]]]))
    block = make.nav_block([0, SECOND], [[0, 0, 0], [0.3, 0.4, 2.0]])
    score = scored(truth, block, steps=steps)
    distance_m = 30 + math.hypot(0.3, 9.6)
    assert (score.end_error_m, score.end_error_percent) == pytest.approx((0.5, 50 / distance_m))
    assert math.isnan(score.ate2_m)
    assert math.isnan(scored(truth, block).end_error_percent)


@given(cuts=st.lists(st.integers(0, 400), max_size=12), shift_ns=st.integers(-(10**10), 10**10))
def test_where_the_estimate_is_cut_changes_no_bit(make, cuts, shift_ns):
    rng = np.random.default_rng(5)
    stamps = 1_700_000_000_000_000_000 + np.cumsum(rng.integers(1, 9_000_000, 400))
    truth_ns = np.sort(np.concatenate([stamps[::7], rng.integers(stamps[0], stamps[-1] + 1, 150)]))
    truth = position(truth_ns + shift_ns % 3, np.cumsum(rng.normal(0, 0.01, (len(truth_ns), 3)), axis=0))
    nav = make.nav_block(stamps, np.cumsum(rng.normal(0, 0.01, (400, 3)), axis=0))
    borders = [0, *sorted(cuts), 400]
    pieces = [part(nav, a, b) for a, b in pairwise(borders)]
    assert scored(truth, *pieces) == scored(truth, nav)


def test_equal_stamps_give_exactly_the_sample_even_at_a_border(make):
    walk = make.rectangle()
    scorer = Scorer(position(walk.stamp_ns, walk.true_m))
    for i in range(len(walk.stamp_ns)):
        scorer.add(part(walk.nav, i, i + 1))
    view = scorer.view(walk.steps, np.zeros(3))
    np.testing.assert_array_equal(view.estimate_m, walk.nav.position_m)


def test_the_view_lays_the_truth_onto_the_estimate(make):
    walk = make.rectangle()
    turned = walk.true_m @ np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]]) + [7, 8, 9]
    turned[300:310] = turned[300]
    scorer = Scorer(position(walk.stamp_ns, turned))
    scorer.add(make.nav_block(walk.stamp_ns, walk.true_m))
    view = scorer.view([], np.zeros(3))
    known = np.isfinite(view.truth_m).all(axis=1)
    assert np.flatnonzero(~known).tolist() == list(range(300, 311))  # and the jump after it
    np.testing.assert_allclose(view.truth_m[known], walk.true_m[known], atol=1e-9)
    assert view.time_s[[0, -1]].tolist() == [0.0, pytest.approx((len(walk.stamp_ns) - 1) * 0.01)]


def test_the_view_of_strides_has_the_time_of_every_footfall(make):
    walk = make.rectangle()
    scorer = Scorer(Truth(TruthKind.STRIDES, NO_STAMPS, walk.footfall_m))
    scorer.add(walk.nav)
    view = scorer.view(walk.steps, walk.nav.position_m[0])
    assert view.truth_m.shape == (27, 2)
    assert view.time_s[:2].tolist() == pytest.approx([0.49, 1.69])


def test_rows_of_the_truth_that_come_late_are_left_out():
    late = in_order(position([1, 3, 2, 3, 4], SQUARE_M[[0, 1, 2, 3, 0]]))
    assert late.stamp_ns.tolist() == [1, 3, 4]
    assert np.array_equal(late.position_m, SQUARE_M[[0, 1, 0]])

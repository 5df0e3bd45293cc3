from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.evaluation.trace import Trace
from pdr_core.records import part


def traced(make, n, cuts=(), limit=100, stance=None):
    stamps = 5_000 + np.arange(n) * 10_000_000
    stance = np.zeros(n, bool) if stance is None else stance
    position_m = np.outer(np.arange(n), [1.0, 2.0, 3.0])
    covariance = np.array([[5.0, 2, 0], [2, 2, 0], [0, 0, 9]])
    nav, judged = make.nav_block(stamps, position_m, 0.5, covariance), make.stance_block(stamps, stance)
    trace, borders = Trace(limit), [0, *sorted(cuts), n]
    for a, b in pairwise(borders):
        trace.add(part(judged, a, b), part(nav, a, b))
    return trace


def test_a_short_run_is_kept_whole(make):
    points = traced(make, 100).points
    np.testing.assert_allclose(points.time_s, np.arange(100) * 0.01)
    np.testing.assert_array_equal(points.position_m[:, 2], 3.0 * np.arange(100))
    np.testing.assert_allclose(points.yaw_rad, 0.5)
    np.testing.assert_allclose(points.height_sd_m, 3.0)


def test_the_horizontal_deviation_is_that_of_the_larger_axis(make):
    """[[5, 2], [2, 2]] has the eigenvalues 6 and 1."""
    np.testing.assert_allclose(traced(make, 3).points.horizontal_sd_m, np.sqrt(6.0))


@given(n=st.integers(1, 900), cuts=st.lists(st.integers(0, 900), max_size=10))
def test_a_long_run_is_thinned_evenly_wherever_it_is_cut(make, n, cuts):
    trace = traced(make, n, [min(c, n) for c in cuts])
    kept = trace.points.position_m[:, 0]
    assert len(kept) <= 100
    every = 1 if n <= 100 else kept[1] - kept[0]
    np.testing.assert_array_equal(kept, np.arange(0, n, every))
    assert len(kept) > 50 or n <= 100


def test_every_stance_stays_visible_however_short(make):
    stance = np.zeros(1000, bool)
    stance[[3, 500, 501, 999]] = True
    for cuts in ([], [4, 501], range(1000)):
        intervals = np.array(traced(make, 1000, cuts, stance=stance).stance_intervals_s)
        np.testing.assert_allclose(intervals, [[0.03, 0.04], [5.0, 5.02], [9.99, 9.99]])


def test_before_the_first_sample_it_is_empty():
    trace = Trace()
    assert len(trace.points.time_s) == 0
    assert trace.stance_intervals_s == []

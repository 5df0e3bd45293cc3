"""What a foot may take of a correction that both share: the books against the exact filter of both feet."""

import numpy as np
import pytest
from scipy.stats import chi2

from pdr_core.fusion.shared_yaw import SharedYaw

RNG = np.random.default_rng(2)


def test_a_filter_takes_the_turn_and_keeps_what_both_have_in_common():
    P, d, D = 0.04, 0.03, 0.001
    told = SharedYaw().equivalent(d, D, P)
    gain = P / (P + told.variance_rad2)
    assert gain * told.turn_rad == pytest.approx(d)
    assert (1 - gain) * P == pytest.approx(0.5 * P + D)


def test_many_corrections_never_make_a_foot_surer_than_the_common_half():
    books, P, total = SharedYaw(), 0.0, 0.0
    for _ in range(200):
        P, total = P + 1e-4, total + 1e-4
        if told := books.equivalent(0.0, 1e-5, P):
            P = P * told.variance_rad2 / (P + told.variance_rad2)
    assert pytest.approx(0.5 * total + 1e-5, rel=0.02) == P


def test_a_foot_that_was_told_by_others_has_less_in_common():
    books = SharedYaw()
    books.equivalent(0.0, 1e-6, 0.04)
    told = books.equivalent(0.0, 1e-6, 0.004)  # a magnetometer has come between
    assert told is None or told.variance_rad2 > 0.004


def test_what_cannot_be_told_yet_is_not_told():
    assert SharedYaw().equivalent(0.1, 0.02, 0.03) is None
    assert SharedYaw().equivalent(0.1, 0.0, 0.0) is None


def test_the_variance_of_two_feet_that_correct_each_other_is_true():
    """Two headings that wander on their own; each takes half the difference, measured with noise, at every stride."""
    runs, strides, q, r, squares = 300, 30, 1e-4, 2e-5, []
    for _ in range(runs):
        error, P, books = np.zeros(2), np.zeros(2), (SharedYaw(), SharedYaw())
        difference_rad2 = 0.0
        for _ in range(strides):
            error, P = error + np.sqrt(q) * RNG.standard_normal(2), P + q
            difference_rad2 += 0.5 * q
            K = difference_rad2 / (difference_rad2 + r)
            half = K * (0.5 * (error[0] - error[1]) + np.sqrt(r) * RNG.standard_normal())
            difference_rad2 *= 1.0 - K
            for foot, sign in ((0, 1.0), (1, -1.0)):
                told = books[foot].equivalent(sign * half, difference_rad2, P[foot])
                gain = P[foot] / (P[foot] + told.variance_rad2)
                error[foot] -= gain * told.turn_rad
                P[foot] *= 1.0 - gain
        squares.append(error[0] ** 2 / P[0])
    low, high = chi2.ppf([0.025, 0.975], runs) / runs
    assert low < np.mean(squares) < high

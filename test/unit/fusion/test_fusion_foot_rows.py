"""The rows of one foot: between two of them, in gaps, out of order, from another world."""

import numpy as np
import pytest
from fusion_cases import rows

from pdr_core.conventions import NO_STAMP
from pdr_core.fusion.foot_rows import FootRows, in_order, lost_yaws_ns, usable, worlds
from pdr_core.records import joined, length, part


def nanoseconds(stamp_s):
    return np.round(np.asarray(stamp_s) * 1e9).astype(np.int64)


def test_between_two_rows_the_way_is_straight_and_the_attitude_turns():
    kept = FootRows()
    kept.add(rows([1.0, 1.02], position_m=[[0, 0, 0], [2, 4, 6]], yaw_rad=[3.1, -3.1]))
    at, known = kept.at(nanoseconds([1.0, 1.005, 1.02]))
    assert known.all()
    assert at.position_m == pytest.approx(np.array([[0, 0, 0], [0.5, 1, 1.5], [2, 4, 6]]))
    yaw_rad = 2 * np.arctan2(at.quat_xyzw[1, 2], at.quat_xyzw[1, 3]) % (2 * np.pi)
    assert yaw_rad == pytest.approx(3.1 + 0.25 * (2 * np.pi - 6.2), abs=1e-4)


def test_outside_and_in_a_gap_nothing_is_known():
    kept = FootRows()
    kept.add(rows([1.0, 1.1, 3.0, 3.1]))
    assert kept.at(nanoseconds([0.9, 1.05, 2.0, 3.0, 3.2]))[1].tolist() == [False, True, False, True, False]
    assert not FootRows().at(nanoseconds([1.0]))[1].any()


def test_what_is_forgotten_leaves_the_row_before():
    kept = FootRows()
    kept.add(rows(np.arange(100) * 0.01))
    kept.forget(int(nanoseconds(0.505)))
    assert kept.at(nanoseconds([0.505, 0.99]))[1].all()
    assert length(kept.rows) == 50


def test_late_and_repeated_rows_are_left_out_and_a_clock_that_jumped_back_is_told():
    nav = rows([1.0, 1.01, 1.01, 1.005, 1.02, -50.0, -49.99])
    found = list(in_order(nav, NO_STAMP))
    assert [(back, (piece.stamp_ns / 1e9).tolist()) for back, piece in found] == [
        (False, [1.0, 1.01, 1.02]),
        (True, [-50.0, -49.99]),
    ]
    assert list(in_order(rows([0.5]), int(1e9))) == []


def test_rows_that_are_no_numbers_are_left_out():
    nav = rows([1.0, 1.01, 1.02])
    nav.position_m[1, 2], nav.pose_covariance[2, 3, 3] = np.nan, np.inf
    assert usable(nav).stamp_ns.tolist() == [int(1e9)]
    assert length(usable(rows([]))) == 0


def test_a_filter_that_was_started_anew_is_in_another_world():
    far, anew = rows([1.0, 1.01], sd_m=0.2), rows([1.02, 1.03], sd_m=0.001)
    found = list(worlds(joined([far, anew]), None))
    assert [(another, length(piece)) for another, piece in found] == [(False, 2), (True, 2)]
    assert [another for another, _ in worlds(anew, far)] == [True]
    assert [another for another, _ in worlds(far, rows([0.9], sd_m=0.4))] == [False]


def test_a_yaw_is_lost_in_a_gap_and_not_by_and_by():
    variance_rad2 = np.array([0.01, 0.02, 5.0, 5.01, 0.1, 0.2, 0.3, 0.4])
    found = rows(np.arange(8.0))
    found.pose_covariance[:, 5, 5] = variance_rad2
    assert lost_yaws_ns(found, None) == [2_000_000_000]
    assert lost_yaws_ns(part(found, 2), part(found, 1, 2)) == [2_000_000_000]
    assert lost_yaws_ns(part(found, 2), None) == []


def test_a_lost_foot_is_unknown_until_it_is_found():
    kept = FootRows()
    kept.add(rows(np.arange(100) * 0.01))
    kept.lose(int(nanoseconds(0.3)))
    assert kept.at(nanoseconds([0.3, 0.31, 0.9]))[1].tolist() == [True, False, False]
    kept.find(int(nanoseconds(0.8)))
    assert kept.at(nanoseconds([0.3, 0.31, 0.8]))[1].tolist() == [True, False, True]

"""Our track beside theirs: the ATE so far is that of the whole, in constant memory."""

import numpy as np
import pytest
from external_cases import BEGIN_NS, nav_rows, seen_fixes, way

from pdr_core.evaluation.alignment import over_whole
from pdr_core.evaluation.external import External
from pdr_core.external.comparing import Comparing, RunningAte
from pdr_core.params import ExternalParams
from pdr_core.records import part
from pdr_core.records_external import FixBlock, about_up, unknown_yaws

PARAMS = ExternalParams(body_window_s=0.0)
SHIFT_M = (400.0, -70.0, 3.0)


def test_the_running_sums_give_what_the_whole_gives():
    rng = np.random.default_rng(0)
    ours_m = rng.standard_normal((500, 2)).cumsum(axis=0) + 1e4
    theirs_m = ours_m @ about_up(1.1)[:2, :2].T + [300.0, 9.0] + 0.5 * rng.standard_normal((500, 2))
    running = RunningAte()
    assert np.isnan(running.ate_m)
    for i in range(500):
        running.add(ours_m[i], theirs_m[i])
    off_m = over_whole(ours_m, theirs_m).apply(ours_m) - theirs_m
    assert running.ate_m == pytest.approx(np.sqrt(np.mean(np.sum(off_m**2, axis=1))), rel=1e-6)


def compared(fixes, t, places_m, params=PARAMS):
    comparing, nav, told = Comparing(params), nav_rows(t, places_m), 0
    for start in range(0, len(t), 100):
        comparing.add(part(nav, start, start + 100))
        reached = int(np.searchsorted(fixes.stamp_ns, nav.stamp_ns[min(start + 99, len(t) - 1)]))
        variance_m2 = np.repeat(fixes.sd_m[told:reached, None] ** 2, 3, axis=1)
        comparing.take(
            FixBlock(
                fixes.stamp_ns[told:reached], fixes.position_m[told:reached], variance_m2, unknown_yaws(reached - told)
            )
        )
        told = reached
    return comparing


def test_a_straight_walk_is_enough_and_who_waits_for_the_frame_is_told_so():
    t, places_m = way(40.0)
    assert compared(seen_fixes(t, places_m, 2.0, SHIFT_M, 0.4, seed=2), t, places_m).comparison.frame
    words = External("/robot", False, Comparing(PARAMS).comparison).in_words()
    assert "takes a walk of some 20 m" in words


def test_frame_clock_and_ate_come_out():
    t, places_m = way(150.0, [30.0, 60.0, 100.0])
    found = compared(seen_fixes(t, places_m, 2.0, SHIFT_M, 0.4, seed=2), t, places_m).comparison
    assert found.frame.yaw_rad == pytest.approx(2.0, abs=0.03)
    assert found.frame.clock_ns * 1e-9 == pytest.approx(0.4, abs=0.15)
    assert found.pairs > 100
    assert found.ate_m == pytest.approx(0.3 * np.sqrt(2.0), rel=0.15)


def test_our_own_drift_is_in_the_ate_and_not_in_the_frame():
    t, true_m = way(300.0, [30.0, 60.0, 100.0, 180.0, 220.0])
    drifted_m = true_m + np.outer(np.maximum(t - 150.0, 0.0), [0.05, 0.0, 0.0])
    found = compared(seen_fixes(t, true_m, 2.0, SHIFT_M, 0.4, seed=2), t, drifted_m).comparison
    assert found.frame.yaw_rad == pytest.approx(2.0, abs=0.1)
    assert 1.0 < found.ate_m < 4.0


def test_an_outlier_is_left_out_and_named_and_a_source_that_moves_house_is_followed():
    t, places_m = way(150.0, [30.0, 60.0])
    fixes = seen_fixes(t, places_m, 2.0, SHIFT_M, 0.4, seed=2)
    fixes.position_m[[100, 110], 0] += 100.0
    one = compared(fixes, t, places_m)
    assert one.comparison.ate_m < 0.6
    assert [(n.kind, n.count) for n in one.notices] == [("external_outlier", 2)]
    fixes.position_m[120:, 0] += 50.0
    assert compared(fixes, t, places_m).comparison.ate_m > 5.0


def test_on_a_straight_line_all_is_said_but_the_clock():
    t, places_m = way(100.0)
    found = compared(seen_fixes(t, places_m, 2.0, SHIFT_M, 0.4, seed=2), t, places_m).comparison
    assert found.frame.yaw_rad == pytest.approx(2.0, abs=0.03)
    assert found.frame.clock_sd_s == pytest.approx(PARAMS.clock_sd_s, rel=0.1)
    assert found.ate_m == pytest.approx(0.3 * np.sqrt(2.0), rel=0.15)


def test_a_clock_that_was_not_told_in_a_long_corridor_is_found_at_its_end():
    t, places_m = way(300.0, [250.0])
    found = compared(seen_fixes(t, places_m, 2.0, SHIFT_M, 0.4, seed=2), t, places_m).comparison
    assert found.frame.clock_sd_s < PARAMS.aligned_sd_s
    assert found.frame.clock_ns * 1e-9 == pytest.approx(0.4, abs=0.2)


def test_a_clock_from_another_moment_is_found():
    t, places_m = way(150.0, [30.0, 60.0, 100.0])
    fixes = seen_fixes(t, places_m, 2.0, SHIFT_M, 0.4, seed=2)
    comparing, nav, told = Comparing(PARAMS), nav_rows(t, places_m), 0
    for start in range(0, len(t), 20):
        comparing.add(part(nav, start, start + 20))
        reached = int(np.searchsorted(fixes.stamp_ns, nav.stamp_ns[start + 19]))
        own_ns = fixes.stamp_ns[told:reached] - BEGIN_NS
        comparing.take(
            FixBlock(
                own_ns, fixes.position_m[told:reached], np.full((reached - told, 3), 0.09), unknown_yaws(reached - told)
            )
        )
        told = reached
    assert (comparing.comparison.frame.clock_ns + BEGIN_NS) * 1e-9 == pytest.approx(0.4, abs=0.15)

"""Fixes as they come: nothing that is no number, nothing twice, and any clock."""

import numpy as np
import pytest

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.external.intake import FixIntake
from pdr_core.notices import Tally
from pdr_core.params import ExternalParams
from pdr_core.records_external import FixBlock

OURS_NS = 1_700_000_000 * NANOSECONDS


def block(*seconds, begin_ns=OURS_NS, x_m=1.0, variance_m2=0.04, yaw_rad=np.nan):
    n = len(seconds)
    stamps = begin_ns + np.array([round(s * NANOSECONDS) for s in seconds], np.int64)
    return FixBlock(stamps, np.full((n, 3), x_m), np.full((n, 3), variance_m2), np.full(n, yaw_rad))


def taken(intake, until_s=1e6):
    return [(at_ns - OURS_NS) / NANOSECONDS for at_ns, *_ in intake.until(OURS_NS + round(until_s * NANOSECONDS))]


def kinds(intake):
    return {n.kind for n in intake.notices}


@pytest.fixture
def intake():
    return FixIntake(ExternalParams(), Tally())


def test_what_is_no_number_is_left_out_and_named(intake):
    intake.take(block(1.0), OURS_NS)
    intake.take(block(2.0, x_m=np.nan), OURS_NS)
    intake.take(block(3.0, variance_m2=np.inf), OURS_NS)
    intake.take(block(4.0), OURS_NS)
    assert taken(intake) == [1.0, 4.0]
    assert [(n.kind, n.count) for n in intake.notices] == [("external_no_number", 2)]


def test_late_ones_and_repeats_are_left_out_and_named(intake):
    intake.take(block(1.0, 2.0, 2.0, 1.5, 3.0), OURS_NS)
    assert taken(intake) == [1.0, 2.0, 3.0]
    assert [(n.kind, n.count) for n in intake.notices] == [("external_out_of_order", 2)]


def test_a_fast_source_tells_as_much_as_its_errors_change(intake):
    intake.take(block(*np.arange(0.0, 10.0, 0.02)), OURS_NS)
    assert taken(intake) == pytest.approx(np.arange(0.0, 10.0, 0.9), abs=0.011)


def test_they_wait_for_our_track(intake):
    intake.take(block(1.0, 2.0, 3.0), OURS_NS)
    assert taken(intake, 2.0) == [1.0, 2.0]
    assert taken(intake, 3.0) == [3.0]


def test_nothing_is_taken_before_we_have_a_clock(intake):
    intake.take(block(1.0), NO_STAMP)
    intake.take(block(2.0), OURS_NS)
    assert taken(intake) == [2.0]


@pytest.mark.parametrize("begin_ns", [0, 7 * NANOSECONDS, 2 * OURS_NS])
def test_a_clock_that_counts_from_another_moment_is_set_by_what_came_together(intake, begin_ns):
    intake.take(block(5.0, 6.0, begin_ns=begin_ns), OURS_NS + NANOSECONDS)
    assert taken(intake) == [1.0, 2.0]
    assert intake.coarse_ns == begin_ns + 4 * NANOSECONDS - OURS_NS
    assert kinds(intake) == {"external_clocks_apart"}


def test_clocks_that_nearly_agree_are_left_to_the_fit(intake):
    intake.take(block(1.5), OURS_NS)
    assert intake.coarse_ns == 0


def test_a_clock_that_jumps_back_begins_anew(intake):
    intake.take(block(100.0, 101.0, 2.0, 3.0), OURS_NS + 100 * NANOSECONDS)
    assert intake.begun == 2
    assert taken(intake) == [100.0, 101.0]  # what came with the first of the new clock
    assert "external_clock_back" in kinds(intake)


def test_a_deviation_is_theirs_or_ours_where_they_tell_none_and_where_the_point_is_comes_on_top(intake):
    for at_s, variance_m2 in ((1.0, 0.0), (2.0, 1e-12), (3.0, 4.0)):
        intake.take(block(at_s, variance_m2=variance_m2), OURS_NS)
    p = ExternalParams()
    known = [sd_m for *_, sd_m in intake.until(2 * OURS_NS)]
    assert known == pytest.approx([np.hypot(sd_m, p.point_sd_m) for sd_m in (p.sd_m, 1e-6, 2.0)])


def test_the_person_is_told_from_where_their_pose_looks():
    """Two metres ahead and one to the left of a robot that looks along y."""
    intake = FixIntake(ExternalParams(offset_from="theirs", offset_x_m=2.0, offset_y_m=1.0), Tally())
    intake.take(block(1.0, x_m=5.0, yaw_rad=np.pi / 2.0), OURS_NS)
    intake.take(block(2.0), OURS_NS)
    ((_, place_m, _),) = intake.until(OURS_NS + 10 * NANOSECONDS)
    np.testing.assert_allclose(place_m, [4.0, 7.0, 5.0])
    assert kinds(intake) == {"external_no_yaw"}
    seen_from_person = FixIntake(ExternalParams(offset_x_m=2.0), Tally())
    seen_from_person.take(block(1.0), OURS_NS)
    assert taken(seen_from_person) == [1.0]

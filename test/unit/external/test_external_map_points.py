"""Known points as they come: refused or taken, in whatever pieces, and named."""

import numpy as np
import pytest
from external_cases import BEGIN_NS, SPEED_MPS, nav_rows, way

from pdr_core.conventions import NANOSECONDS, NO_STAMP
from pdr_core.external.map_points import Comparing, MapPoints, compared_with
from pdr_core.maths.circular import wrapped_rad
from pdr_core.params import ExternalParams
from pdr_core.records import part
from pdr_core.records_external import FixBlock, about_up, unknown_yaws

TURN_RAD, SHIFT_M = 2.5, np.array([100.0, 50.0, 7.0])
PARAMS = ExternalParams(message="point")
T, PLACES_M = way(60.0, [20.0, 40.0])


def points(*said, off_m=(0.0, 0.0, 0.0)):
    """What a person says at times [s]: where on the map she is."""
    at_s = np.array(said, np.float64)
    ours_m = np.column_stack([np.interp(at_s, T, axis_m) for axis_m in PLACES_M.T])
    stamps = BEGIN_NS + np.rint(at_s * NANOSECONDS).astype(np.int64)
    return FixBlock(
        stamps, ours_m @ about_up(TURN_RAD).T + SHIFT_M + off_m, np.zeros((len(at_s), 3)), unknown_yaws(len(at_s))
    )


def told(*blocks, piece=100):
    """The stage after the walk; each block of points comes when its last one is due."""
    stage, nav, waiting = MapPoints(PARAMS), nav_rows(T, PLACES_M), list(blocks)
    for start in range(0, len(T), piece):
        some = part(nav, start, start + piece)
        stage.add(some)
        while waiting and waiting[0].stamp_ns[-1] <= some.stamp_ns[-1]:
            stage.take(waiting.pop(0))
    for block in waiting:
        stage.take(block)
    stage.finish()
    return stage


def kinds(stage):
    return {notice.kind: notice.count for notice in stage.notices}


def test_the_second_point_lays_the_track_on_the_map():
    stage = told(points(5.0), points(35.0))
    frame = stage.comparison.frame
    assert wrapped_rad(frame.yaw_rad - TURN_RAD) == pytest.approx(0.0, abs=1e-3)
    np.testing.assert_allclose(frame.theirs_m(PLACES_M), PLACES_M @ about_up(TURN_RAD).T + SHIFT_M, atol=0.05)
    assert kinds(stage) == {"known_point": 1, "known_points": 1}
    assert stage.comparison.pairs == 2


def test_one_point_is_none():
    stage = told(points(5.0))
    assert stage.comparison.frame is None
    assert kinds(stage) == {"known_point": 1}


def test_it_is_the_same_in_whatever_pieces():
    frames = [told(points(5.0), points(35.0), points(50.0), piece=piece).comparison.frame for piece in (7, 100, 150)]
    for frame in frames[1:]:
        assert frame.yaw_rad == frames[0].yaw_rad
        np.testing.assert_array_equal(frame.shift_m, frames[0].shift_m)


def test_points_at_the_very_ends_count_where_the_track_begins_and_ends():
    frame = told(points(0.0), points(T[-1])).comparison.frame
    assert wrapped_rad(frame.yaw_rad - TURN_RAD) == pytest.approx(
        0.0, abs=0.05
    )  # the stride's mean is half a stride late
    assert np.linalg.norm(frame.theirs_m(PLACES_M[-1]) - points(T[-1]).position_m[0]) < SPEED_MPS


def test_a_wrong_point_is_named_and_the_next_ones_count():
    wrong = told(points(5.0, off_m=[60.0, 0.0, 0.0]), points(35.0), points(55.0))
    assert kinds(wrong) == {"known_point": 1, "known_point_refused": 1, "known_points": 1}
    assert wrapped_rad(wrong.comparison.frame.yaw_rad - TURN_RAD) == pytest.approx(0.0, abs=1e-3)
    later = told(points(5.0), points(35.0), points(55.0, off_m=[10.0, 0.0, 0.0]))
    assert kinds(later) == {"known_point": 1, "known_points": 1, "known_point_refused": 1}
    assert later.comparison.frame.yaw_rad == told(points(5.0), points(35.0)).comparison.frame.yaw_rad


def test_every_point_counts_however_soon_after_another():
    """She means each of them; only fixes of a source repeat its error."""
    soon = told(points(5.0), points(34.5), points(35.0))
    assert kinds(soon) == {"known_point": 1, "known_points": 2}
    assert soon.comparison.pairs == 3
    far = told(points(5.0), points(35.0), points(35.5, off_m=[10.0, 0.0, 0.0]))
    assert kinds(far) == {"known_point": 1, "known_points": 1, "known_point_refused": 1}


def test_a_point_before_the_first_estimate_is_named():
    stage = MapPoints(PARAMS)
    stage.take(points(0.0), NO_STAMP)
    assert kinds(stage) == {"known_point_early": 1}


def test_a_track_that_begins_anew_forgets_the_points():
    stage = told(points(5.0), points(35.0))
    stage.add(nav_rows(T - 1000.0, PLACES_M))
    assert stage.comparison.frame is None


def test_what_comes_says_what_lays_both_beside_each_other():
    assert isinstance(compared_with(PARAMS), MapPoints)
    assert isinstance(compared_with(ExternalParams()), Comparing)

"""The track without jumps, and without what was told."""

import numpy as np
import pytest
from external_cases import BEGIN_NS, nav_rows, step_at, track_of, way

from pdr_core.conventions import NANOSECONDS
from pdr_core.external.free_track import FreeTrack
from pdr_core.records import part
from pdr_core.records_external import about_up


def stamps(*seconds):
    return BEGIN_NS + np.array([round(s * NANOSECONDS) for s in seconds], np.int64)


def test_the_body_goes_evenly_where_the_foot_stands_and_swings():
    t = np.arange(0.0, 20.0, 0.01)
    phase = (t / 1.1) % 1.0
    foot = 1.4 * (np.floor(t / 1.1) + np.clip((phase - 0.6) / 0.4, 0.0, 1.0))  # stands, then swings
    places_m = np.column_stack([foot, np.zeros((len(t), 2))])
    at = stamps(*np.arange(3.0, 16.0, 0.1))
    body, known = track_of(t, places_m, 1.1).at(at)
    assert known.all()
    speeds = np.diff(body[:, 0]) / 0.1
    np.testing.assert_allclose(speeds, 1.4 / 1.1, atol=0.15)
    raw, _ = track_of(t, places_m, 0.0).at(at)
    assert np.ptp(np.diff(raw[:, 0]) / 0.1) > 2.0


def test_what_is_not_known_yet_and_what_lies_in_a_gap_is_said():
    t, places_m = way(20.0)
    nav = nav_rows(t, places_m)
    track = FreeTrack(1.0)
    track.add(part(nav, 0, 800))
    track.add(part(nav, 1000))  # 2 s are missing
    _, known = track.at(stamps(0.2, 3.0, 9.0, 15.0, 19.8))
    assert known.tolist() == [False, True, False, True, False]


def told_walk():
    """A walk along x, told at 5 s to be 2 m farther left and turned by 0.3 rad."""
    t, places_m = way(12.0)
    yaw, jumped = np.zeros(len(t)), places_m.copy()
    late = t >= 5.4
    yaw[late] = 0.3
    c, s = np.cos(0.3), np.sin(0.3)
    rest = places_m[late] - [1.3 * 5.0, 0.0, 0.0]
    jumped[late] = np.array([1.3 * 5.0, 2.0, 0.0]) + rest @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return t, jumped, yaw


def heard(t, jumped, yaw):
    track, nav = FreeTrack(0.0), nav_rows(t, jumped, yaw)
    at = lambda s: jumped[round(s * 100)]  # noqa: E731
    track.add(part(nav, 0, 540))
    track.step(step_at(1, 3.9, 5.0, at(3.9), at(5.0)))
    track.add(part(nav, 540))
    begin = np.array([1.3 * 5.0, 2.0, 0.0])  # where the second step began, as it is known now
    track.step(step_at(2, 5.0, 11.9, begin, at(11.9)))
    return track


def test_a_jump_moves_what_lies_before_so_that_the_track_has_none():
    track = heard(*told_walk())
    places_m, known = track.at(stamps(1.0, 5.3, 5.5, 11.0))
    assert known.all()
    np.testing.assert_allclose(places_m[0], [1.3, 2.0, 0.0], atol=1e-6)
    assert np.linalg.norm(places_m[2] - places_m[1]) < 0.5


def test_untold_it_goes_on_as_before_and_what_was_told_is_known():
    track = heard(*told_walk())
    untold_m, _ = track.untold(stamps(1.0, 11.0))
    np.testing.assert_allclose(untold_m[1] - untold_m[0], [13.0, 0.0, 0.0], atol=0.2)
    turned_rad, moved_m = track.told(*stamps(1.0, 11.0).tolist())
    assert turned_rad == pytest.approx(0.3, abs=1e-6)
    now_m = track.at(stamps(11.0))[0][0]
    np.testing.assert_allclose(now_m - moved_m, [1.3 * 11.0, 0.0, 0.0], atol=0.2)


def test_a_foot_that_turns_by_itself_was_told_nothing():
    t, places_m = way(12.0, [4.5])
    yaw = np.pi / 2.0 * np.clip(t - 4.5, 0.0, 1.0)
    track, rate = FreeTrack(0.0), np.where((t >= 4.5) & (t < 5.5), np.pi / 2.0, 0.0)
    nav = nav_rows(t, places_m, yaw, rate)
    track.add(part(nav, 0, 500))
    track.step(step_at(1, 3.9, 5.0, places_m[390], places_m[500], due_s=0.2))
    track.add(part(nav, 500))
    track.step(step_at(2, 5.0, 11.9, places_m[500], places_m[1190]))
    assert track.told(*stamps(1.0, 11.0).tolist())[0] == pytest.approx(0.0, abs=1e-6)


def test_later_estimates_do_not_change_what_an_answer_sees():
    t, places_m = way(12.0, [4.0])
    nav, step = nav_rows(t, places_m), step_at(1, 3.9, 5.0, places_m[390], places_m[500])
    early, late = FreeTrack(1.1), FreeTrack(1.1)
    early.add(part(nav, 0, 502))
    late.add(nav)
    for track in (early, late):
        track.step(step)
    wanted = stamps(3.0, 4.2, 4.39, 4.45, 6.0)
    (a, known_a), (b, known_b) = early.at(wanted), late.at(wanted)
    assert known_a.tolist() == known_b.tolist() == [True, True, True, False, False]
    np.testing.assert_array_equal(a[known_a], b[known_b])


@pytest.mark.parametrize("turned_rad", [0.0, 2.0])
def test_their_point_beside_her_turns_with_her_walk_and_stays_while_she_stands(turned_rad):
    t, places_m = way(40.0, [20.0])
    places_m = np.concatenate([places_m, np.repeat(places_m[-1:], 500, axis=0)]) @ about_up(turned_rad).T
    t = np.arange(len(places_m)) / 100.0
    track = FreeTrack(1.1, (2.0, -1.0))
    for start in range(0, len(t), 70):
        track.add(part(nav_rows(t, places_m), start, start + 70))
    at_s = np.array([10.0, 30.0, 43.0])
    found_m, known = track.at(BEGIN_NS + np.rint(at_s * NANOSECONDS).astype(np.int64))
    body_m = np.column_stack([np.interp(at_s, t, axis_m) for axis_m in places_m.T])
    beside_m = np.array([[2.0, -1.0, 0.0], [1.0, 2.0, 0.0], [1.0, 2.0, 0.0]]) @ about_up(turned_rad).T
    assert known.all()
    np.testing.assert_allclose(found_m - body_m, beside_m, atol=0.02)

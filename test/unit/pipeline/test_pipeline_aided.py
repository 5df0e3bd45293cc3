"""A foot that is told where somebody else sees the person: the same whatever came when, and safe from what is wrong."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from pdr_core.bench.external_walks import truth_m
from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import AidedFoot, ComparedFoot, FootInertial
from pdr_core.records import joined, length, part
from pdr_core.records_external import FixBlock
from pdr_core.simulation import simulated_feet
from pdr_core.simulation.external_source import ExternalSource, fixes, midway

GOOD = ExternalSource(noise_sd_m=0.1)
ALIGNED_S = 45.0
PARAMS = Params()


@cache
def feet():
    params = SimulationParams(walk="rectangle", walk_length_m=90.0, sensor_model="consumer", motion="smooth", seed=3)
    return simulated_feet(params, start_ns=10**15)


def said_by(source):
    walks = feet()
    return fixes(midway(walks["left"].truth, walks["right"].truth), source)


def walked(source=GOOD, piece=50, arrives_s=0.1, params=PARAMS, begin_ns=0, foot=None, said=None):
    """The chain of the left foot after the walk, and all its estimates."""
    walks, foot = feet(), foot or AidedFoot(params)
    said = said_by(source) if said is None else said
    came_ns = said.stamp_ns + round((arrives_s - source.clock_s) * 1e9)
    said = said._replace(stamp_ns=said.stamp_ns + begin_ns)
    imu, outputs, told = walks["left"].imu, [], 0
    for start in range(0, length(imu), piece):
        some = part(imu, start, start + piece)
        outputs.append(foot.run(some))
        reached = int(np.searchsorted(came_ns, some.stamp_ns[-1], side="right"))
        if reached > told:
            foot.fixes(part(said, told, reached))
        told = reached
    outputs.append(foot.finish())
    return foot, joined([output.nav for output in outputs])


@cache
def good():
    return walked()


def same(one, other):
    return all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def kinds(foot):
    return {n.kind for n in foot.notices if n.kind.startswith("external")}


def error_m(foot, nav, source=GOOD):
    off_m = foot.frame.theirs_m(nav.position_m)[:, :2] - truth_m(feet()["left"], nav.stamp_ns, source)
    late = nav.stamp_ns > nav.stamp_ns[0] + ALIGNED_S * 1e9
    return np.linalg.norm(off_m, axis=1)[late]


def test_frame_and_place_are_found():
    foot, nav = good()
    assert kinds(foot) == {"external_aligned"}
    assert foot.frame.clock_ns * 1e-9 == pytest.approx(GOOD.clock_s, abs=0.15)
    assert error_m(foot, nav).max() < 0.4


@pytest.mark.parametrize(("piece", "arrives_s"), [(7, 0.0), (20, 0.15)])
def test_it_is_the_same_whatever_came_when(piece, arrives_s):
    assert same(walked(piece=piece, arrives_s=arrives_s)[1], good()[1])


def test_without_fixes_it_is_the_foot_alone():
    foot = FootInertial(changed(PARAMS, "filter", heading_feedback=True))
    imu = feet()["left"].imu
    alone = joined([output.nav for output in (foot.run(imu), foot.finish())])
    assert same(walked(replace(GOOD, silent=((0.0, 1e6),)))[1], alone)


def test_a_comparison_changes_nothing():
    foot, nav = walked(foot=ComparedFoot(PARAMS))
    assert same(nav, walked(replace(GOOD, silent=((0.0, 1e6),)))[1])
    assert foot.comparison.frame.yaw_rad == pytest.approx(good()[0].frame.yaw_rad, abs=0.03)
    assert 0.1 < foot.comparison.ate_m < 0.5


def test_an_outlier_moves_nothing_at_all():
    at_s = (55.0, 60.0, 61.0)
    foot, nav = walked(replace(GOOD, outliers_s=at_s))
    silent = replace(GOOD, silent=tuple((s, s + 1.0) for s in at_s))
    assert same(nav, walked(silent)[1])
    assert kinds(foot) == {"external_aligned", "external_outlier"}


def test_a_source_that_stays_where_it_is_is_left_out_and_named():
    foot, nav = walked(replace(GOOD, frozen=((55.0, 65.0),)))
    assert kinds(foot) == {"external_aligned", "external_frozen"}
    assert error_m(foot, nav).max() < 0.5


def test_silence_is_named_and_survived():
    foot, nav = walked(replace(GOOD, silent=((50.0, 65.0),)))
    assert kinds(foot) == {"external_aligned", "external_silent"}
    assert error_m(foot, nav).max() < 0.6


def test_a_clock_that_counts_from_another_moment():
    foot, nav = walked(begin_ns=-(10**15) + 10**9 * 77)
    assert kinds(foot) == {"external_aligned", "external_clocks_apart"}
    assert error_m(foot, nav).max() < 0.5


def test_a_source_that_is_started_anew_is_aligned_anew():
    """Its frame is another one then: nothing of the old one is believed."""
    walks = feet()
    truth = midway(walks["left"].truth, walks["right"].truth)
    first, then = fixes(truth, GOOD), fixes(truth, replace(GOOD, yaw_rad=-1.0))
    half = int(np.searchsorted(first.stamp_ns, first.stamp_ns[0] + 50 * 10**9))
    foot, imu = AidedFoot(PARAMS), walks["left"].imu
    said = [part(first, 0, half), then._replace(stamp_ns=then.stamp_ns - 10**12)]
    told = joined([said[0], part(said[1], half)])
    came_ns = np.concatenate([first.stamp_ns[:half], then.stamp_ns[half:]])
    for start in range(0, length(imu), 50):
        some = part(imu, start, start + 50)
        foot.run(some)
        now = (came_ns <= some.stamp_ns[-1]) & (came_ns > some.stamp_ns[0] - 1)
        if now.any():
            foot.fixes(FixBlock(*(column[now] for column in told)))
    foot.finish()
    assert {"external_clock_back", "external_aligned"} <= kinds(foot)
    assert foot.frame is None or abs(foot.frame.yaw_rad - 2.0) > 1.0


MAP_LOST_S = 45.0
ELSEWHERE = replace(GOOD, yaw_rad=-1.0, shift_m=(-50.0, 20.0, 0.0))


def one_after_the_other(first, then, at_s):
    """What a source says whose frame is another one from a time on, by the same clock."""
    early, late = said_by(first), said_by(then)
    count = int(np.searchsorted(early.stamp_ns, early.stamp_ns[0] + round(at_s * 1e9)))
    return joined([part(early, 0, count), part(late, count)])


def test_a_source_that_lost_its_map_is_aligned_anew_and_nobody_is_moved():
    foot, nav = walked(said=one_after_the_other(GOOD, ELSEWHERE, MAP_LOST_S))
    found = {n.kind: n for n in foot.notices if n.kind.startswith("external")}
    assert set(found) == {"external_aligned", "external_outlier", "external_let_go", "external_realigned"}
    again_ns = found["external_realigned"].first_stamp_ns
    assert 15.0 < (again_ns - nav.stamp_ns[0]) * 1e-9 - MAP_LOST_S < 25.0
    alone = walked(replace(GOOD, silent=((MAP_LOST_S, 1e6),)))[1]
    assert np.linalg.norm(nav.position_m - alone.position_m, axis=1)[nav.stamp_ns < again_ns].max() < 0.3
    moved_m = np.linalg.norm(np.diff(nav.position_m, axis=0), axis=1)
    assert moved_m[nav.stamp_ns[1:] > again_ns].max() < 0.1
    off_m = foot.frame.theirs_m(nav.position_m)[:, :2] - truth_m(feet()["left"], nav.stamp_ns, ELSEWHERE)
    assert np.linalg.norm(off_m, axis=1)[nav.stamp_ns > again_ns].max() < 0.6


def test_a_source_that_comes_back_to_its_old_frame_is_taken_back_there():
    """It was elsewhere for too short a time to be aligned there."""
    for_a_while = one_after_the_other(GOOD, ELSEWHERE, MAP_LOST_S)
    back = one_after_the_other(GOOD, GOOD, MAP_LOST_S)
    count = int(np.searchsorted(back.stamp_ns, back.stamp_ns[0] + round((MAP_LOST_S + 12.0) * 1e9)))
    foot, _ = walked(said=joined([part(for_a_while, 0, count), part(back, count)]))
    assert "external_realigned" not in kinds(foot)
    assert "external_taken_back" in kinds(foot)
    assert foot.frame.yaw_rad == pytest.approx(good()[0].frame.yaw_rad, abs=0.05)


def test_one_that_goes_away_slowly_is_not_aligned_anew():
    foot, _ = walked(replace(GOOD, drifts=(35.0, np.inf), drift_mps=0.15))
    assert "external_let_go" in kinds(foot)
    assert "external_realigned" not in kinds(foot)


BESIDE = replace(GOOD, beside_m=(0.5, 1.5))


@pytest.mark.parametrize(
    "known",
    [
        {"offset_x_m": 0.5, "offset_y_m": 1.5},
        {"offset_from": "theirs", "offset_x_m": -0.5, "offset_y_m": -1.5},
    ],
)
def test_a_robot_at_a_known_place_beside_the_person(known):
    foot, nav = walked(BESIDE, params=changed(PARAMS, "external", **known))
    assert kinds(foot) == {"external_aligned"}
    assert error_m(foot, nav).max() < 0.4


def test_a_robot_at_an_unknown_place_beside_the_person_is_as_good_as_it_is_near():
    """It is 1.6 m away: who says so has it believed, who takes it for her own has it let go of."""
    foot, nav = walked(BESIDE, params=changed(PARAMS, "external", point_sd_m=1.0))
    assert kinds(foot) == {"external_aligned"}
    assert error_m(foot, nav).max() < 1.6
    assert "external_let_go" in kinds(walked(BESIDE)[0])

"""Two feet that somebody else sees: both are corrected, and the body is where they say; or they are compared alone."""

from functools import cache

import numpy as np
import pytest
from feet_cases import START_NS, later, midway_m

from pdr_core.params import Params, SimulationParams, changed
from pdr_core.pipeline import AidedFeet, BothFeet, ComparedFeet
from pdr_core.pipeline.aided_fusion import both_known
from pdr_core.records import PositionError, joined, length, part
from pdr_core.records_external import FixBlock, about_up, unknown_yaws
from pdr_core.simulation import simulated_feet
from pdr_core.simulation.external_source import ExternalSource, fixes, midway

WALK = SimulationParams(  # whose feet turn alike, which they cannot tell each other
    walk="rectangle", walk_length_m=90.0, sample_rate_hz=100.0, sensor_model="g_sensitive", feet_errors="alike", seed=4
)
SOURCE = ExternalSource(noise_sd_m=0.1)
SETTLED_S = 25.0


@cache
def feet_walks():
    return simulated_feet(WALK, start_ns=START_NS)


@cache
def told(pipeline=AidedFeet, piece=40, right_ns=0):
    """The chain of both feet after the walk, and the person's way; the right one's clock shows so much more."""
    walks = feet_walks()
    imus = {"left": walks["left"].imu, "right": later(walks["right"].imu, right_ns * 1e-9)}
    said = fixes(midway(walks["left"].truth, walks["right"].truth), SOURCE)
    came_ns, done, outputs, both = said.stamp_ns - round(0.3e9), 0, [], pipeline(Params())
    for start in range(0, max(map(length, imus.values())), piece):
        for name, imu in imus.items():
            outputs.append(both.run(name, part(imu, start, start + piece)))
        now_ns = imus["left"].stamp_ns[: start + piece][-1]
        reached = int(np.searchsorted(came_ns, now_ns, side="right"))
        if pipeline is not BothFeet and reached > done:
            both.fixes(part(said, done, reached))
        done = reached
    outputs.append(both.finish())
    return both, joined([output.body for output in outputs]), outputs


def nav_of(outputs, name):
    """The estimates of a foot."""
    return joined([one.nav for output in outputs for foot, one in output.feet if foot == name])


def errors_m(body, frame):
    """By how much the person is off in their frame, once all has settled."""
    truth_m = midway_m(feet_walks(), body.stamp_ns) @ about_up(SOURCE.yaw_rad).T + SOURCE.shift_m
    late = body.stamp_ns > body.stamp_ns[0] + round(SETTLED_S * 1e9)
    return np.linalg.norm((frame.theirs_m(body.position_m) - truth_m)[:, :2], axis=1)[late]


def test_the_person_is_where_they_say():
    both, body, _ = told()
    assert "external_aligned" in {n.kind for n in both.notices["body"]}
    aided = errors_m(body, both.comparison.frame)
    alone = errors_m(told(BothFeet)[1], both.comparison.frame)
    assert aided.max() < 0.4
    assert alone.max() > 2.0 * aided.max()


def test_both_feet_are_corrected():
    """The track of each lies in their world where the foot was."""
    both, _, outputs = told()
    walks = feet_walks()
    for name, walk in walks.items():
        nav, frame = nav_of(outputs, name), both.frame_of(name)
        at_m = np.column_stack([np.interp(nav.stamp_ns, walk.truth.stamp_ns, x) for x in walk.truth.position_m.T])
        off_m = frame.theirs_m(nav.position_m) - at_m @ about_up(SOURCE.yaw_rad).T - SOURCE.shift_m
        late = nav.stamp_ns > nav.stamp_ns[0] + round(SETTLED_S * 1e9)
        assert np.linalg.norm(off_m[late, :2], axis=1).max() < 0.6
        assert nav.pose_covariance[late][:, [0, 1], [0, 1]].max() < 0.05  # of one that is told nothing: 0.4 m^2


def test_it_is_the_same_in_whatever_pieces():
    one, other = told()[1], told(piece=17)[1]
    np.testing.assert_array_equal(one.position_m, other.position_m)


def test_a_foot_on_another_clock_is_aided_on_its_own():
    """Their clock is compared with that of each foot: that of the right one shows a time that is long gone."""
    both, body, _ = told(right_ns=-START_NS)
    assert {n.kind for n in both.notices["body"]} >= {"clocks_apart", "external_aligned"}
    clocks_s = [1e-9 * both.frame_of(foot).clock_ns for foot in ("left", "right")]
    assert clocks_s[1] - clocks_s[0] == pytest.approx(1e-9 * START_NS, abs=0.3)
    assert errors_m(body, both.comparison.frame).max() < 0.4


def test_the_body_is_compared_by_the_clock_of_the_first_foot():
    both, _, _ = told(ComparedFeet, right_ns=-START_NS)
    assert {"clocks_apart"} == {n.kind for n in both.notices["body"]}
    assert both.comparison.frame.clock_ns * 1e-9 == pytest.approx(SOURCE.clock_s, abs=0.2)


def test_compared_both_feet_and_the_body_are_as_if_nobody_had_said_anything():
    _, body, outputs = told(ComparedFeet)
    _, alone, outputs_alone = told(BothFeet)
    for one, other in zip(body, alone, strict=True):
        np.testing.assert_array_equal(one, other)
    for name in feet_walks():
        np.testing.assert_array_equal(nav_of(outputs, name).position_m, nav_of(outputs_alone, name).position_m)


def test_compared_it_says_where_the_body_and_each_foot_lie_in_their_frame():
    both, body, outputs = told(ComparedFeet)
    assert both.comparison.frame.yaw_rad == pytest.approx(SOURCE.yaw_rad, abs=0.1)  # these sensors turn the track
    assert both.comparison.frame.clock_ns * 1e-9 == pytest.approx(SOURCE.clock_s, abs=0.2)
    assert both.comparison.pairs > 50
    assert 0.05 < both.comparison.ate_m < 0.7
    body_m = both.comparison.frame.theirs_m(body.position_m)
    for name in feet_walks():  # half a stride ahead or behind at most
        nav = nav_of(outputs, name)
        foot_m = both.frame_of(name).theirs_m(nav.position_m)
        at_m = np.column_stack([np.interp(body.stamp_ns, nav.stamp_ns, axis_m) for axis_m in foot_m.T])
        assert np.linalg.norm((at_m - body_m)[:, :2], axis=1).max() < 1.0


def test_known_points_lay_the_body_where_they_are():
    """The last one as the recording ends."""
    both, walks = ComparedFeet(changed(Params(), "external", message="point")), feet_walks()
    at = [100, 4000, length(walks["left"].imu) - 1]
    at_ns = walks["left"].imu.stamp_ns[at]
    places_m = midway_m(walks, at_ns) @ about_up(SOURCE.yaw_rad).T + SOURCE.shift_m
    said, start = FixBlock(at_ns, places_m, np.zeros((3, 3)), unknown_yaws(3)), 0
    for i, stop in enumerate(np.array(at) + 1):
        for name, walk in walks.items():
            both.run(name, part(walk.imu, start, stop))
        both.fixes(part(said, i, i + 1))
        start = stop
    both.finish()
    assert [n.kind for n in both.notices["body"] if n.kind.startswith("known")] == ["known_point", "known_points"]
    assert both.comparison.pairs == 3
    assert both.comparison.frame.yaw_rad == pytest.approx(SOURCE.yaw_rad, abs=0.1)


def test_two_measurements_of_one_place_are_weighted_by_their_information():
    one = PositionError(np.array([1.0, 0.0, 0.0]), np.diag([1.0, 1.0, 1e6]))
    other = PositionError(np.array([0.0, 2.0, 0.0]), np.diag([3.0, 1.0, 1.0]))
    both = both_known(one, other)
    np.testing.assert_allclose(both.error_m, [0.75, 1.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(np.diag(both.covariance_m2), [0.75, 0.5, 1e6 / (1e6 + 1.0)])
    assert both_known(one, None) is one
    assert both_known(None, None) is None

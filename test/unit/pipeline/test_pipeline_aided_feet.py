"""Two feet that somebody else sees: both are corrected, and the body between them is where they say."""

from functools import cache

import numpy as np
import pytest
from feet_cases import START_NS, midway_m

from pdr_core.params import Params, SimulationParams
from pdr_core.pipeline import AidedFeet, BothFeet
from pdr_core.pipeline.aided_fusion import both_known, of_body
from pdr_core.records import PositionError, joined, length, part
from pdr_core.records_external import ExternalFrame, about_up
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
def told(aids=True, piece=40):
    """The chain of both feet after the walk, and the person's way."""
    walks = feet_walks()
    said = fixes(midway(walks["left"].truth, walks["right"].truth), SOURCE)
    came_ns, done, outputs = said.stamp_ns - round(0.3e9), 0, []
    both = AidedFeet(Params()) if aids else BothFeet(Params())
    for start in range(0, max(length(walk.imu) for walk in walks.values()), piece):
        for name, walk in walks.items():
            outputs.append(both.run(name, part(walk.imu, start, start + piece)))
        now_ns = walks["left"].imu.stamp_ns[: start + piece][-1]
        reached = int(np.searchsorted(came_ns, now_ns, side="right"))
        if aids and reached > done:
            both.fixes(part(said, done, reached))
        done = reached
    outputs.append(both.finish())
    return both, joined([output.body for output in outputs]), outputs


def errors_m(body, frame):
    """By how much the person is off in their frame, once all has settled."""
    truth_m = midway_m(feet_walks(), body.stamp_ns) @ about_up(SOURCE.yaw_rad).T + SOURCE.shift_m
    late = body.stamp_ns > body.stamp_ns[0] + round(SETTLED_S * 1e9)
    return np.linalg.norm((frame.theirs_m(body.position_m) - truth_m)[:, :2], axis=1)[late]


def test_the_person_is_where_they_say():
    both, body, _ = told()
    assert "external_aligned" in {n.kind for n in both.notices["body"]}
    aided = errors_m(body, both.comparison.frame)
    alone = errors_m(told(False)[1], both.comparison.frame)
    assert aided.max() < 0.4
    assert alone.max() > 2.0 * aided.max()


def test_both_feet_are_corrected():
    """The track of each lies in their world where the foot was."""
    both, _, outputs = told()
    walks = feet_walks()
    for name, walk in walks.items():
        nav = joined([one.nav for output in outputs for foot, one in output.feet if foot == name])
        frame = both._aided._aids[name].frame
        at_m = np.column_stack([np.interp(nav.stamp_ns, walk.truth.stamp_ns, x) for x in walk.truth.position_m.T])
        off_m = frame.theirs_m(nav.position_m) - at_m @ about_up(SOURCE.yaw_rad).T - SOURCE.shift_m
        late = nav.stamp_ns > nav.stamp_ns[0] + round(SETTLED_S * 1e9)
        assert np.linalg.norm(off_m[late, :2], axis=1).max() < 0.6
        assert nav.pose_covariance[late][:, [0, 1], [0, 1]].max() < 0.05  # of one that is told nothing: 0.4 m^2


def test_it_is_the_same_in_whatever_pieces():
    one, other = told()[1], told(piece=17)[1]
    np.testing.assert_array_equal(one.position_m, other.position_m)


def test_two_measurements_of_one_place_are_weighted_by_their_information():
    one = PositionError(np.array([1.0, 0.0, 0.0]), np.diag([1.0, 1.0, 1e6]))
    other = PositionError(np.array([0.0, 2.0, 0.0]), np.diag([3.0, 1.0, 1.0]))
    both = both_known(one, other)
    np.testing.assert_allclose(both.error_m, [0.75, 1.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(np.diag(both.covariance_m2), [0.75, 0.5, 1e6 / (1e6 + 1.0)])
    assert both_known(one, None) is one
    assert both_known(None, None) is None


@pytest.mark.parametrize("turn_rad", [0.0, 1.2])
def test_their_frame_from_the_body_is_that_of_a_foot_seen_from_there(turn_rad):
    frame = ExternalFrame(2.0, np.array([5.0, 6.0, 0.5]), 7, np.eye(4), np.array([3.0, 1.0]))
    foot_m = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [4.0, -3.0, 0.2]])
    body_m = foot_m @ about_up(turn_rad).T + [0.0, 0.1, 0.0]
    found = of_body(frame, body_m[:2])
    np.testing.assert_allclose(found.theirs_m(body_m), frame.theirs_m(foot_m), atol=1e-12)
    np.testing.assert_allclose(found.pose_covariance(body_m[2]), frame.pose_covariance(foot_m[2]), atol=1e-12)

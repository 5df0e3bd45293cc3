"""A foot that is missing for a while, or comes late, is found beside the other one, and the body does not go astray."""

import numpy as np
import pytest
from feet_cases import FEET, START_NS, Together, by_messages, feet_walks, later, midway_m, samples, yaw_rad

from pdr_core.evaluation.metrics import ate2_m
from pdr_core.records import joined, length, part


@pytest.mark.parametrize("foot", FEET)
def test_a_foot_that_is_lost_while_the_person_turns_is_found_beside_the_other(foot):
    """Its stream breaks off for 5 s, in which the person walks around a corner before any straight line was walked."""
    imus, walks = samples(length_m=40.0), feet_walks(length_m=40.0)
    t = (imus[foot].stamp_ns - START_NS) / 1e9
    broken = imus | {foot: type(imus[foot])(*(column[(t < 12.0) | (t > 17.0)] for column in imus[foot]))}
    found, whole = Together(broken), Together(imus)
    off_m = (found.body.position_m - midway_m(walks, found.body.stamp_ns))[:, :2]
    assert np.linalg.norm(off_m, axis=1).max() < 1.0
    assert (np.abs(off_m) < 3.0 * np.sqrt(found.body.pose_covariance[:, [0, 1], [0, 1]]) + 0.02).all()
    turned_rad = np.interp(found.body.stamp_ns, whole.body.stamp_ns, np.unwrap(yaw_rad(whole.body)))
    assert np.abs(np.angle(np.exp(1j * (yaw_rad(found.body) - turned_rad)))).max() < 1.0
    assert found.kinds == []


@pytest.mark.parametrize("foot", FEET)
def test_a_foot_that_begins_when_the_person_walks_is_found_beside_the_other(foot):
    imus, walks = samples(length_m=40.0), feet_walks(length_m=40.0)
    found = Together(imus | {foot: part(imus[foot], 1200, length(imus[foot]))})
    assert ate2_m(found.body.position_m, midway_m(walks, found.body.stamp_ns)) < 0.4
    assert np.linalg.norm(np.diff(found.body.position_m, axis=0), axis=1).max() < 0.5
    assert found.kinds == []


def test_a_foot_that_begins_later_while_the_person_stands_is_beside_the_other_all_the_same():
    """It begins 5 s later, and the person stands for 4 s more."""
    imus, walks = samples(length_m=24.0), feet_walks(length_m=24.0)
    rest = {foot: repeated(imu, 6.0) for foot, imu in imus.items()}
    found = Together(rest | {"right": part(rest["right"], 500, length(rest["right"]))})
    moved = found.body._replace(stamp_ns=found.body.stamp_ns - 6_000_000_000)
    walked = moved.stamp_ns >= START_NS + 6_000_000_000
    off_m = (moved.position_m - midway_m(walks, moved.stamp_ns))[walked, :2]
    assert np.linalg.norm(off_m, axis=1).max() < 0.1


def test_both_feet_may_be_lost_at_once_and_the_body_goes_on():
    imus = samples(length_m=40.0)
    t = (imus["left"].stamp_ns - START_NS) / 1e9
    broken = {
        foot: type(imu)(*(column[: len(t)][(t < 12.0) | (t > 14.0)] for column in imu)) for foot, imu in imus.items()
    }
    body = Together(broken).body
    assert length(body) > 0.95 * length(broken["left"])
    assert np.isfinite(body.position_m).all()


@pytest.mark.parametrize("missing_s", [(0.0, 9.0), (6.0, 9.0)])
def test_the_order_of_arrival_does_not_matter(missing_s):
    imus = samples()
    t = (imus["left"].stamp_ns - START_NS) / 1e9
    here = (t < missing_s[0]) | (t > missing_s[1])
    imus = imus | {"left": type(imus["left"])(*(column[here] for column in imus["left"]))}
    exact = Together(imus).body
    for seed in range(6):
        body, _ = by_messages(imus, np.random.default_rng(seed))
        n = length(body)  # where a stream just stops, the last rows wait for more
        assert n > 0.8 * length(exact)
        assert all(np.array_equal(a, b) for a, b in zip(body, part(exact, 0, n), strict=True)), seed


def repeated(imu, rest_s):
    """Return samples with a longer rest before the walk: its first sample again and again."""
    count = round(rest_s * 100.0)
    rest = type(imu)(*(np.repeat(column[:1], count, axis=0) for column in imu))
    rest = rest._replace(stamp_ns=imu.stamp_ns[0] + np.arange(count) * 10_000_000)
    return joined([rest, later(imu, rest_s)])

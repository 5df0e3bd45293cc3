"""A source is let go of when it parts from the track, and not when both are right."""

import numpy as np
import pytest
from external_cases import BEGIN_NS, SPEED_MPS, track_of, way

from pdr_core.conventions import NANOSECONDS
from pdr_core.external.trust import Seen, Trust
from pdr_core.params import ExternalParams

T, PLACES_M = way(200.0, [50.0, 120.0])
TRACK = track_of(T, PLACES_M)
TRUE_YAW_SD_RAD = 0.01


def judged(off_m, seed=0, until_s=190, believed=None, sd_m=0.3):
    """The seconds at which a source is believed; `off_m` gives by how much it is off at a time."""
    trust, rng, holds = Trust(ExternalParams()), np.random.default_rng(seed), {}
    for at_s in range(5, until_s):
        at_ns = BEGIN_NS + at_s * NANOSECONDS
        place_m = TRACK.at(np.array([at_ns]))[0][0, :2] + off_m(at_s) + sd_m * rng.standard_normal(2)
        seen = Seen(at_ns, place_m, sd_m, TRUE_YAW_SD_RAD, believed(at_s) if believed else True)
        held = trust.holds
        holds[at_s] = trust.judge(seen, TRACK, 0.1)
        if held and not holds[at_s]:
            trust.begin_anew()
    return holds


def test_a_good_source_is_never_let_go_of_in_an_hour():
    assert all(all(judged(lambda _: np.zeros(2), seed).values()) for seed in range(20))


@pytest.mark.parametrize("direction", [np.array([1.0, 0.0]), np.array([0.0, 1.0]), np.array([-0.7, 0.7])])
def test_one_that_goes_away_at_a_decimetre_a_second_is_let_go_of_soon(direction):
    latest = []
    for seed in range(10):
        holds = judged(lambda s: 0.1 * max(s - 60, 0) * direction, seed)
        latest.append(next(s for s, held in holds.items() if not held))
    assert min(latest) > 60
    assert max(latest) <= 80


def test_a_heading_that_may_be_wrong_explains_a_parting():
    """What our own yaw may make of the way is not the source's fault."""
    trust = Trust(ExternalParams())
    for at_s in range(5, 40):
        at_ns = BEGIN_NS + at_s * NANOSECONDS
        place_m = TRACK.at(np.array([at_ns]))[0][0, :2] + 0.1 * at_s
        assert trust.judge(Seen(at_ns, place_m, 0.3, 0.14 / SPEED_MPS, True), TRACK, 0.1)


def test_one_whose_fixes_are_not_believed_is_let_go_of_and_taken_back_when_they_are():
    holds = judged(lambda _: np.zeros(2), believed=lambda s: not 60 <= s < 90)
    assert not holds[75]
    assert holds[59]
    assert holds[110]
    back = next(s for s in range(75, 190) if holds[s])
    assert 90 + 8 <= back <= 90 + 15


def test_single_wrong_fixes_say_nothing_of_the_others():
    wrong = (60, 67, 74, 81)
    holds = judged(lambda s: np.array([100.0, 0.0]) * (s in wrong), believed=lambda s: s not in wrong)
    assert all(holds.values())


def test_a_fix_is_measured_by_both_covariances_and_by_the_way_since_the_last():
    trust = Trust(ExternalParams())
    P = 0.04 * np.eye(2)
    assert trust.believes(np.array([1.3, 0.0]), P, 0.3, 0.0)
    assert not trust.believes(np.array([1.4, 0.0]), P, 0.3, 0.0)
    assert trust.believes(np.array([1.4, 0.0]), P, 0.4, 0.0)
    assert not trust.believes(np.array([100.0, 0.0]), P, 0.3, 100.0)
    assert trust.believes(np.array([3.9, 0.0]), P, 0.3, 100.0)

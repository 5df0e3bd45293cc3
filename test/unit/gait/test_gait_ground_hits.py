"""How a foot moves, and when it hits the ground: drawn courses of the distance to a standing foot."""

import numpy as np
import pytest

from pdr_core.conventions import NO_STAMP
from pdr_core.gait.behaviour import BehaviourRecognition
from pdr_core.gait.foot_motion import FootMotion, MotionBlock
from pdr_core.gait.ground_hits import GroundHits
from pdr_core.gait.lowpass import GRID_NS, EvenBlock
from pdr_core.gait.stride_features import StrideFeatures
from pdr_core.params import GaitParams
from pdr_core.records import Floats, joined, length
from pdr_core.records_gait import Behaviour

PARAMS = GaitParams()
UP = np.array([0.0, 0.0, 9.81])


def even(accel_mps2: Floats, first: int = 0) -> EvenBlock:
    n = len(accel_mps2)
    return EvenBlock(GRID_NS * np.arange(first, first + n), accel_mps2, np.arange(n) == 0)


def motion(knots: list[tuple[float, float]], still_below: float = 1.0) -> MotionBlock:
    """A course through (time s, distance m/s^2), still where it is below a level."""
    time_s, distance = np.array(knots).T
    at_s = np.arange(0.0, time_s[-1], GRID_NS * 1e-9)
    d = np.interp(at_s, time_s, distance)
    return MotionBlock(np.rint(at_s * 1e9).astype(np.int64), d, d, d < still_below, np.arange(len(d)) == 0)


def hits_s(course: MotionBlock) -> list[float]:
    stamps, _ = GroundHits(PARAMS).run(course)
    return [stamp * 1e-9 for stamp in stamps if stamp != NO_STAMP]


def test_a_foot_moves_beside_what_it_showed_standing() -> None:
    turned = 9.81 * np.array([np.sin(0.5), 0.0, np.cos(0.5)])
    block = FootMotion(PARAMS).run(even(np.concatenate([np.tile(UP, (20, 1)), [turned, 2.0 * UP, 0.0 * UP]])))
    assert block.distance_mps2[20:] == pytest.approx([2.0 * 9.81 * np.sin(0.25), 9.81, 9.81])
    assert block.beside_mps2[20:] == pytest.approx([0.0, 9.81, -9.81])
    assert block.still[10:20].all()
    assert not block.still[20:].any()


def test_after_a_gap_a_still_foot_must_be_seen_anew() -> None:
    foot, before, after = FootMotion(PARAMS), even(np.tile(UP, (20, 1))), even(np.tile(UP, (20, 1)), first=500)
    foot.run(before)
    still = foot.run(after).still
    window = round(PARAMS.calm_s * 50)
    assert not still[: window - 1].any()
    assert still[window - 1 :].all()


def test_an_acceleration_that_is_not_gravity_is_no_standing_foot() -> None:
    block = FootMotion(PARAMS).run(even(np.tile(1.5 * UP, (50, 1))))
    assert not block.still.any()
    assert block.distance_mps2.tolist() == [0.0] * 50


def test_a_walked_stride_ends_where_the_foot_may_stand() -> None:
    walked = [(0.0, 0.5), (0.5, 0.5), (0.7, 10.0), (0.85, 3.0), (1.05, 19.0), (1.25, 0.0), (1.6, 0.0)]
    assert hits_s(motion(walked)) == pytest.approx([1.24], abs=0.021)


def test_a_dip_between_push_off_and_braking_is_no_hit() -> None:
    slow = [(0.0, 0.5), (0.5, 0.5), (0.65, 18.0), (0.8, 2.5), (1.2, 3.0), (1.35, 17.0), (1.6, 0.0), (2.0, 0.0)]
    assert hits_s(motion(slow)) == pytest.approx([1.56], abs=0.05)


def test_a_runner_hits_at_every_dip() -> None:
    stride = [(0.15, 12.0), (0.25, 9.0), (0.45, 32.0), (0.6, 3.0)]
    knots = [(0.0, 0.5), (0.5, 0.5)] + [(0.5 + 0.7 * k + t, d) for k in range(6) for t, d in stride] + [(5.0, 5.0)]
    assert hits_s(motion(knots)) == pytest.approx([1.1 + 0.7 * k for k in range(6)], abs=0.021)


def test_what_hardly_moves_is_no_stride() -> None:
    assert hits_s(motion([(0.0, 0.5), (0.5, 0.5), (0.8, 3.5), (1.2, 0.0), (2.0, 0.0)])) == []


def test_a_gap_begins_a_new_stride() -> None:
    half = motion([(0.0, 0.5), (0.5, 0.5), (0.7, 19.0), (0.75, 18.0)])
    rest = motion([(0.0, 0.0), (1.0, 0.0)])
    rest = rest._replace(stamp_ns=rest.stamp_ns + 9 * 10**9)
    assert hits_s(joined([half, rest])) == []


def test_who_moves_on_without_a_hit_does_not_walk_any_more() -> None:
    recognition = BehaviourRecognition(PARAMS)
    still = motion([(0.0, 0.0), (1.0, 0.0)])
    for i in range(length(still)):
        recognition.run(still, i)
    assert (
        recognition.stride(StrideFeatures(0, 10**9, 1.0, 0.45, False, 3.0, 5.0, 3.5, 14.0, -4.0)) is Behaviour.WALKING
    )
    moving = motion([(0.0, 6.0), (5.0, 6.0)])
    moving = moving._replace(stamp_ns=moving.stamp_ns + 10**9, fresh=np.zeros(length(moving), np.bool_))
    seen = [recognition.run(moving, i) for i in range(length(moving))]
    walked_s = seen.count(Behaviour.WALKING) * 0.02
    assert walked_s == pytest.approx(PARAMS.stride_longest_s, abs=0.05)
    assert seen[-1] is Behaviour.SWING

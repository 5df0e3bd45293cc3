"""Standing, swinging, walking, running, and every change between them within two strides."""

import numpy as np
import pytest
from accelerometer_cases import BEGIN_NS, dangling, row, still_noise, walk

from pdr_core.gait.accelerometer_steps import AccelerometerSteps, GaitSeen
from pdr_core.gait.behaviour import BehaviourRecognition
from pdr_core.gait.stride_features import StrideFeatures
from pdr_core.params import GaitParams
from pdr_core.records import ImuBlock
from pdr_core.records_gait import Behaviour
from pdr_core.simulation.gait import RUN, SHUFFLE, STROLL, WALK, Gait, Stride

STANDING, SWING, WALKING, RUNNING = Behaviour.STANDING, Behaviour.SWING, Behaviour.WALKING, Behaviour.RUNNING
WALKED = StrideFeatures(0, 10**9, 1.0, 0.45, False, 3.0, 5.0, 3.5, 14.0, -4.0)
RUN_ON = WALKED._replace(rest_s=0.04, by_dip=True)
ODD = WALKED._replace(rest_s=0.1)  # begins in the short stance that the stride before ended in


def seen(imu: ImuBlock) -> GaitSeen:
    return AccelerometerSteps(GaitParams()).run(imu)


def looks(strides: list[StrideFeatures]) -> list[Behaviour]:
    recognition = BehaviourRecognition(GaitParams())
    return [recognition.stride(stride) for stride in strides]


def at(out: GaitSeen, time_s: float) -> Behaviour:
    return Behaviour(int(out.behaviour[np.searchsorted(out.stamp_ns, BEGIN_NS + round(time_s * 1e9))]))


@pytest.mark.parametrize("rate_hz", [20.0, 50.0, 200.0, 400.0])
@pytest.mark.parametrize("pace", [0.8, 1.0, 1.2])
def test_every_change_is_found_within_two_strides(rate_hz: float, pace: float) -> None:
    parts = [(WALK.paced(pace), 8), (RUN.paced(pace), 10), (WALK.paced(pace), 8)]
    found = [s.behaviour for s in seen(walk([s for gait, n in parts for s in row(gait, n)], rate_hz)).steps]
    assert len(found) == 26
    assert found[:8] == [WALKING] * 8
    assert found[9:18] == [RUNNING] * 9
    assert found[19:] == [WALKING] * 7


def test_standing_walking_standing() -> None:
    out = seen(walk([*row(WALK, 6, pause_s=5.0), *row(WALK, 6)]))
    stride_s = Stride(WALK).duration_s
    stopped_s = 3.0 + 6.0 * stride_s
    assert at(out, 2.9) is STANDING
    assert at(out, 3.4) is SWING  # it moves, and no ground hit has told that it walks
    assert at(out, 3.0 + 2.0 * stride_s) is WALKING
    assert at(out, stopped_s + 2.0 * stride_s) is STANDING
    assert at(out, stopped_s + 5.0 + 2.0 * stride_s) is WALKING


@pytest.mark.parametrize("gait", [WALK, STROLL, SHUFFLE], ids=["walk", "stroll", "shuffle"])
def test_a_stance_is_no_standing(gait: Gait) -> None:
    out = seen(walk([Stride(gait)] * 12))
    inside = out.behaviour[(out.stamp_ns > BEGIN_NS + 5 * 10**9) & (out.stamp_ns < BEGIN_NS + 12 * 10**9)]
    assert set(inside.tolist()) == {WALKING.value}


def test_a_foot_that_dangles_does_not_walk() -> None:
    out = seen(dangling(30.0))
    late = out.behaviour[out.stamp_ns > BEGIN_NS + 6 * 10**9]
    assert set(late.tolist()) == {SWING.value}
    assert [step.index for step in out.steps if step.behaviour in (WALKING, RUNNING)] in ([], [1])  # as it begins


def test_a_foot_on_the_ground_stands_whatever_its_noise_and_tilt() -> None:
    time_s = np.arange(2000) / 100.0
    out = seen(still_noise(time_s, np.tile([5.0, -6.0, 5.9], (2000, 1))))
    assert set(out.behaviour[20:].tolist()) == {STANDING.value}
    assert out.steps == []


def test_one_short_stance_is_no_run() -> None:
    assert looks([WALKED, WALKED, RUN_ON, ODD, WALKED]) == [WALKING] * 5


def test_two_short_stances_are() -> None:
    assert looks([WALKED, RUN_ON, RUN_ON, RUN_ON]) == [WALKING, WALKING, RUNNING, RUNNING]
    still_each = WALKED._replace(rest_s=0.15)  # a slow run, in which the foot is still for an instant
    assert looks([WALKED, still_each, still_each]) == [WALKING, WALKING, RUNNING]


def test_in_between_it_goes_on_as_before() -> None:
    between = WALKED._replace(rest_s=0.245)
    assert looks([WALKED, between, between]) == [WALKING] * 3
    assert looks([RUN_ON, between, between]) == [RUNNING] * 3


def test_strides_without_energy_or_direct_component_are_swings() -> None:
    assert looks([WALKED._replace(direct_mps2=-0.5)]) == [SWING]
    assert looks([WALKED._replace(energy_mps2=0.5)]) == [SWING]

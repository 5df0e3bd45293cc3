import copy

import numpy as np
import pytest

from pdr_core.params import PlaceParams, SimulationParams, StanceParams
from pdr_core.records import ImuBlock, joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.stance import StanceDetection
from support.verdicts import longest_wait_s

WALK = simulated_walk(SimulationParams(walk="straight", walk_length_m=3.6, sample_rate_hz=100.0), start_ns=10**18)


def detection(**changed):
    return StanceDetection(StanceParams(**changed), PlaceParams())


def judged_whole(imu, **changed):
    d = detection(**changed)
    return joined([d.run(imu), d.finish()])


def same(a, b):
    return all(np.array_equal(x, y) for x, y in zip((*a.imu, *a[1:]), (*b.imu, *b[1:]), strict=True))


def test_the_stances_of_a_simulated_walk_are_found():
    found = judged_whole(WALK.imu).stance
    inside = np.convolve(WALK.motion.stance, np.ones(9), "same") == 9  # away from toe-off and heel strike
    assert found[inside].all()
    middle_of_swing = np.convolve(~WALK.motion.stance, np.ones(61), "same") == 61
    assert middle_of_swing.any()
    assert not found[middle_of_swing].any()


@pytest.mark.parametrize("rate_hz", [50, 100, 200])
def test_a_verdict_comes_after_20_ms_whatever_the_rate(rate_hz):
    walk = simulated_walk(SimulationParams(walk="straight", walk_length_m=1.2, sample_rate_hz=rate_hz), start_ns=10**18)
    assert longest_wait_s(detection(), walk.imu) == pytest.approx(0.02)


@pytest.mark.parametrize(("gate", "intervals"), [("none", 1), ("gait_phases", 2), ("kmeans", 2)])
@pytest.mark.parametrize("window_s", [0.035, 0.3])
def test_a_verdict_never_needs_later_samples_than_the_latency_and_an_interval(window_s, gate, intervals):
    d, period_s = detection(window_s=window_s, time_gate=gate), 0.01
    waited_s = longest_wait_s(d, WALK.imu)
    assert waited_s <= d.latency_s + intervals * period_s


def test_what_comes_after_the_latency_does_not_change_a_verdict():
    whole = judged_whole(WALK.imu)
    for stop in range(40, length(WALK.imu), 23):
        early = detection().run(part(WALK.imu, 0, stop))
        assert same(early, part(whole, 0, length(early)))


@pytest.mark.parametrize("window_s", [0.0, 0.01])
def test_a_window_shorter_than_an_interval_gives_the_same_sample_by_sample(window_s):
    d = detection(window_s=window_s)
    pieces = [d.run(part(WALK.imu, i, i + 1)) for i in range(length(WALK.imu))]
    assert same(joined([*pieces, d.finish()]), judged_whole(WALK.imu, window_s=window_s))


def test_all_samples_come_out_once_and_in_order():
    assert same(judged_whole(WALK.imu), judged_whole(WALK.imu))
    np.testing.assert_array_equal(judged_whole(WALK.imu).imu.stamp_ns, WALK.imu.stamp_ns)


def test_the_threshold_is_told_with_every_verdict():
    fixed = judged_whole(WALK.imu, threshold_min=123.0, relative_share=0.0)
    np.testing.assert_array_equal(fixed.threshold, np.full(length(fixed), 123.0))
    whole = judged_whole(WALK.imu)
    assert len(np.unique(whole.threshold)) > 10
    np.testing.assert_array_equal(whole.stance, whole.statistic <= whole.threshold)


@pytest.mark.parametrize("first", [0, 100])
def test_a_jump_of_the_clock_splits_the_stream_where_it_is(first):
    imu = ImuBlock(*(c.copy() for c in part(WALK.imu, first)))
    imu.stamp_ns[200:] -= 500_000_000_000
    before, after = judged_whole(part(imu, 0, 200)), detection()
    whole = judged_whole(imu)
    assert same(part(whole, 0, 200), before)
    np.testing.assert_array_equal(whole.statistic[200:], joined([after.run(part(imu, 200)), after.finish()]).statistic)
    np.testing.assert_array_equal(whole.imu.stamp_ns, imu.stamp_ns)


def test_a_copy_goes_on_like_the_original():
    d = detection()
    d.run(part(WALK.imu, 0, 333))
    other = copy.deepcopy(d)
    assert same(
        joined([d.run(part(WALK.imu, 333)), d.finish()]), joined([other.run(part(WALK.imu, 333)), other.finish()])
    )


def test_nothing_in_nothing_out():
    d = detection()
    assert length(d.run(part(WALK.imu, 0, 0))) == 0
    assert length(d.finish()) == 0

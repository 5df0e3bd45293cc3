"""The filter is as uncertain as it says; told the wrong noise, both bounds notice."""

import os

import numpy as np
import pytest
from scipy.stats import chi2

from pdr_core.bench.believed_walk import believed_walk, ground, told
from pdr_core.bench.consistency import CAMPAIGNS, Campaign, consistency, spread
from pdr_core.params import changed

RUNS, LENGTH_M = 50, 18.0
full = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


def shown(result):
    percent = f"{result.end_error_median_percent:.3f} %, 95th percentile {result.end_error_95_percent:.3f} %"
    print(f"\n{result.name}: end error {percent}, stance found {result.stance_found:.0%}")
    for s in result.spreads:
        shares = f"{s.below:.1%} below, {s.inside:.1%} inside, {s.above:.1%} above"
        print(f"  {s.name:<22}{s.mean:7.3f} of {s.freedom}: {shares}")
    return {s.name: s for s in result.spreads}


def wrongly_told(group, **factors):
    params = told()
    values = {name: getattr(getattr(params, group), name) * factor for name, factor in factors.items()}
    return Campaign("wrongly told", params=changed(params, group, **values))


def test_the_filter_is_as_uncertain_as_it_says():
    spreads = shown(consistency(Campaign("true verdicts"), RUNS, LENGTH_M))
    assert spreads["velocity and tilt"].inside >= 0.9
    assert spreads["zero-velocity update"].inside >= 0.9
    assert spreads["yaw"].above < 0.1


def test_so_is_the_smoother():
    spreads = shown(consistency(Campaign("true verdicts, smoothed", smoothed=True), RUNS, LENGTH_M))
    assert spreads["velocity"].inside >= 0.9
    assert spreads["velocity and tilt"].above < 0.1
    assert spreads["velocity and tilt"].mean > 0.9 * 5
    assert spreads["yaw"].above < 0.1


@pytest.mark.parametrize(("factor", "side"), [(0.7, "above"), (2.0, "below")])
def test_a_filter_told_the_wrong_noise_is_noticed(factor, side):
    campaign = wrongly_told("filter", zero_velocity_sd_mps=factor)
    spreads = shown(consistency(campaign, RUNS, 6.0))
    for name in ("velocity and tilt", "zero-velocity update"):
        assert getattr(spreads[name], side) > 0.5, name


@full
def test_a_hundred_walks_of_100_m():
    result = consistency(CAMPAIGNS[0], 100, 100.0)
    spreads = shown(result)
    assert result.distance_m >= 99.0
    assert spreads["velocity and tilt"].inside >= 0.9
    assert spreads["zero-velocity update"].inside >= 0.9
    assert result.end_error_median_percent < 0.3
    assert result.end_error_95_percent < 1.0


@full
@pytest.mark.parametrize("campaign", CAMPAIGNS[1:3], ids=lambda c: c.name)
def test_with_the_default_detector_beside_it(campaign):
    result = consistency(campaign, 100, 100.0)
    shown(result)
    assert np.isfinite([s.mean for s in result.spreads]).all()


def test_the_bounds_are_those_of_the_runs_that_have_a_value():
    rng = np.random.default_rng(0)
    squares = rng.chisquare(3, (40, 4000))
    squares[:30, 1000:2000] = np.nan
    squares[:, 2000:2100] = np.nan
    found = spread("any", 3, squares)
    assert found.inside == pytest.approx(0.95, abs=0.015)
    assert found.below == pytest.approx(found.above, abs=0.01)
    assert found.mean == pytest.approx(chi2.mean(3), rel=0.02)


def test_the_walks_are_those_that_the_filter_believes_in():
    where, believed = ground(6.0), told().filter
    walks = [believed_walk(where, believed, True, seed) for seed in range(40)]
    stance = where.motion.stance
    tremble = np.array([w.velocity_mps[stance] for w in walks])
    assert tremble.std() == pytest.approx(believed.zero_velocity_sd_mps, rel=0.02)
    assert abs(np.mean(tremble[:, 1:] * tremble[:, :-1])) < 0.02 * tremble.var()  # white
    bias = np.array([w.imu.gyro_radps[1:] - np.median(where.motion.rate_radps, axis=0) for w in walks])[:, :900].mean(1)
    assert bias.std() == pytest.approx(believed.initial_gyro_bias_sd_radps, rel=0.2)
    np.testing.assert_array_equal(walks[3].imu.accel_mps2, believed_walk(where, believed, True, 3).imu.accel_mps2)
    still = believed_walk(where, believed, False, 3)
    assert not still.velocity_mps[stance].any()

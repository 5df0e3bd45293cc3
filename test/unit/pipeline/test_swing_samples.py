"""What a rate that was filled in does not tell is not asked of it."""

import numpy as np
import pytest
from swing_cases import BIAS_RADPS, LEARNT_NS, PARAMS, ideal_walk, switched

from pdr_core.pipeline.swing_samples import SwingSamples
from pdr_core.records import joined


@pytest.fixture(scope="module")
def bridged():
    walk, samples = ideal_walk(magnetometer=True), SwingSamples(PARAMS)
    given, asleep = switched(walk.imu)
    known = [samples.run(given, BIAS_RADPS), samples.finish()]
    return given, asleep, known


def test_no_field_of_a_filled_rate_is_asked_for_the_bias_but_the_gait_sees_all(bridged):
    given, asleep, known = bridged
    judged, imu = joined([k.judged for k in known]), joined([k.imu for k in known])
    assert asleep.any()
    assert (given.field_sd_tesla >= 0.0).all()
    assert np.array_equal(judged.imu.field_sd_tesla < 0.0, asleep)
    assert np.array_equal(imu.field_sd_tesla, given.field_sd_tesla)


def test_a_rest_tells_the_bias_only_as_long_as_the_gyro_has_not_slept():
    walk, samples = ideal_walk(), SwingSamples(PARAMS)
    given, asleep = switched(walk.imu)
    before = samples.run(given._replace(gyro_sd_radps=walk.imu.gyro_sd_radps), BIAS_RADPS)
    assert (before.judged.rest_sd_radps > 0.0).any()
    after = SwingSamples(PARAMS).run(given, BIAS_RADPS)
    assert asleep.any()
    assert not (after.judged.rest_sd_radps > 0.0).any()


def test_only_filled_rates_know_the_vertical_better(bridged):
    given, asleep, known = bridged
    share = np.concatenate([k.share_about_up for k in known])
    assert (share[~asleep] == 1.0).all()
    assert ((share[asleep] < 1.0) & (share[asleep] >= 0.0)).all()
    assert given.stamp_ns[asleep].min() > given.stamp_ns[0] + LEARNT_NS

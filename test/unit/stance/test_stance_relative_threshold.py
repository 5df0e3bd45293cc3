import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.stance.relative_threshold import ThresholdLimits, fresh_threshold, next_threshold, thresholds

MS = 1_000_000
LIMITS = ThresholdLimits(900 * MS, 0.02, 30.0, 1e5, 300.0, 0.005, 0.0022)


def judged(statistic, period_ms=5, limits=LIMITS):
    stamps = 10**18 + np.arange(len(statistic)) * period_ms * MS
    threshold, sd = thresholds(stamps, statistic, limits, fresh_threshold())
    return statistic <= threshold, threshold, sd


def gait(scale, strides=5):
    """Return the statistic of strides: .7 s of swing, .4 s of stance a thousandth as large."""
    swing, stance = np.sin(np.linspace(0.1, 3.0, 140)), np.full(80, 1e-3)
    return scale * np.concatenate([np.concatenate([swing, stance])] * strides)


@given(st.floats(3e4, 3e6))
def test_the_verdict_does_not_depend_on_the_size_of_the_motion(scale):
    reference, _, _ = judged(gait(1e5))
    np.testing.assert_array_equal(judged(gait(scale))[0], reference)
    assert reference[150:210].all()
    assert not reference[20:130].any()


def test_a_foot_that_has_rested_for_long_still_stands():
    standing, threshold, _ = judged(np.concatenate([gait(1e6, 1), np.full(400, 20.0)]))
    assert standing[-400:].all()
    assert threshold[-1] == 40.0  # twice the quietest moments


@pytest.mark.parametrize("noise", [0.0, 50.0, 200.0])
def test_a_noisy_sensor_at_rest_stands(noise):
    rng = np.random.default_rng(0)
    statistic = np.concatenate([np.full(400, 1.0) + noise * rng.uniform(0.5, 1.5, 400), gait(1e6)])
    standing, threshold, _ = judged(statistic)
    assert standing[185:400].all()  # once so much time has been seen
    assert threshold[399] <= max(30.0, 4.0 * noise)


def test_what_is_no_noise_does_not_raise_the_threshold():
    _, threshold, _ = judged(np.full(1000, 5000.0))
    np.testing.assert_array_equal(threshold, np.full(1000, 0.02 * 5000.0) + np.r_[np.zeros(180), np.full(820, 500.0)])


def test_where_the_gyro_is_off_nothing_is_learned():
    statistic = np.concatenate([np.full(300, 2.0), np.full(10, np.inf), np.full(300, 2.0)])
    standing, threshold, _ = judged(statistic)
    assert threshold.max() == 30.0
    np.testing.assert_array_equal(standing, np.isfinite(statistic))


@pytest.mark.parametrize(("period_ms", "factor"), [(10, 1.0), (5, 1.0), (1, np.sqrt(5.0))])
def test_a_stance_tells_the_same_at_any_rate_above_the_usual(period_ms, factor):
    _, _, sd = judged(np.array([1.0, 1.0, 100.0, 400.0]), period_ms)
    np.testing.assert_allclose(sd[1:], np.array([0.005, 0.022, 0.044]) * factor)


def test_a_gap_begins_a_new_look_at_the_noise():
    state = fresh_threshold()
    for stamp_ms in [*range(0, 500, 5), *range(700, 1600, 5)]:
        assert next_threshold(stamp_ms * MS, 100.0, LIMITS, state) == 30.0
        state.last_ns[0] = stamp_ms * MS
    assert next_threshold(1605 * MS, 100.0, LIMITS, state) == 200.0

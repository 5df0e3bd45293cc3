"""A lower rate shows what it can show, and nothing of what it cannot."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.signal import firwin, freqz

from pdr_core.conventions import GAP_NS
from pdr_core.maths.thinning import kept_of, reached, thinned, weights
from pdr_core.recording.decimation import Decimation, ThinnedStream, decimated, rate_of_hz
from pdr_core.recording.session import Sensor
from pdr_core.records import inertial_block, joined, length, part

RATE_HZ, STEP_NS = 200.0, 5_000_000
RATIOS = (2, 4, 5)


def samples(values, sd=0.0):
    """Return samples whose axes all have these values, (n,)."""
    n, columns = len(values), np.repeat(np.asarray(values, float)[:, None], 3, axis=1)
    return inertial_block(np.arange(n) * STEP_NS, columns.copy(), columns.copy(), np.full(n, sd), np.full(n, sd))


def with_field(block, there):
    """Return samples of which those that are flagged have a field like their rate."""
    field = np.where(there[:, None], block.gyro_radps, 0.0)
    return block._replace(field_tesla=field, field_sd_tesla=np.where(there, block.gyro_sd_radps, -1.0))


def noisy(n=400, seed=1):
    return samples(np.random.default_rng(seed).standard_normal(n), 1.0)


def patchy():
    """Return samples with a field at first, then now and then, then without one."""
    row = np.arange(150)
    return with_field(noisy(150), (row < 50) | ((row < 100) & (row % 7 == 0)))


def whole(block, k):
    return thinned(block, 0, length(block), k)


def same(a, b):
    return all(np.array_equal(x, y, equal_nan=True) for x, y in zip(a, b, strict=True))


def inner(block):
    """Leave out what the ends have shortened."""
    return part(block, 5, length(block) - 5)


@pytest.mark.parametrize("k", RATIOS)
def test_the_weights_are_those_of_a_windowed_sinc(k):
    np.testing.assert_allclose(weights(k), firwin(8 * k + 1, 0.9 / k), atol=1e-12)


@pytest.mark.parametrize("k", RATIOS)
@pytest.mark.parametrize("tone", [0.05, 0.2, 0.45, 0.7, 0.85, 1.0])  # of the new rate
def test_a_tone_comes_through_as_the_theory_says(k, tone):
    turns = tone / k * np.arange(200 * k)
    found = [inner(whole(samples(wave(2.0 * np.pi * turns)), k)).gyro_radps[:, 0] for wave in (np.cos, np.sin)]
    _, response = freqz(weights(k), worN=[2.0 * np.pi * tone / k])
    np.testing.assert_allclose(np.hypot(*found), abs(response[0]), atol=1e-9)
    assert tone < 0.5 or abs(response[0]) < 0.01
    assert tone > 0.25 or abs(response[0]) > 0.99


@pytest.mark.parametrize("k", RATIOS)
def test_what_does_not_change_stays_and_a_ramp_keeps_its_time(k):
    np.testing.assert_allclose(whole(samples(np.full(300, 9.81)), k).accel_mps2, 9.81, rtol=1e-13)
    ramp = whole(samples(np.arange(300.0)), k)
    np.testing.assert_allclose(ramp.gyro_radps[:, 0], ramp.stamp_ns / STEP_NS, atol=1e-9)


def test_the_stamps_are_those_of_the_samples_that_are_kept():
    block = noisy()
    block.stamp_ns[:] = np.cumsum(np.random.default_rng(3).integers(1, STEP_NS, 400)) + 1_700_000_000_000_000_001
    np.testing.assert_array_equal(whole(block, 4).stamp_ns, block.stamp_ns[::4])


def test_every_sample_kept_is_as_it_was():
    assert same(whole(noisy(), 1), noisy())


@pytest.mark.parametrize("k", RATIOS)
def test_the_noise_that_is_told_is_the_noise_there_is(k):
    out = inner(whole(noisy(60_000), k))
    np.testing.assert_allclose(out.gyro_radps.std(), out.gyro_sd_radps[9], rtol=0.02)
    np.testing.assert_allclose(out.accel_sd_mps2[9], np.sqrt(np.sum(weights(k) ** 2)))
    assert out.gyro_sd_radps[9] < 1.0 / np.sqrt(k)
    assert not whole(samples(np.zeros(99)), k).gyro_sd_radps.any(), "unknown stays unknown"


@pytest.mark.parametrize(("values", "deviations"), [("gyro_radps", "gyro_sd_radps"), ("accel_mps2", "accel_sd_mps2")])
def test_what_was_not_measured_stays_so_and_nothing_of_it_is_mixed_in(values, deviations):
    block, off = noisy(), slice(100, 203)
    getattr(block, deviations)[off], getattr(block, values)[off] = -1.0, 0.0
    out = whole(block, 4)
    on = getattr(out, deviations) >= 0.0
    np.testing.assert_array_equal(on, getattr(block, deviations)[::4] >= 0.0)
    assert not getattr(out, values)[~on].any()
    getattr(block, values)[off] = 1e6
    np.testing.assert_array_equal(getattr(whole(block, 4), values)[on], getattr(out, values)[on])


@pytest.mark.parametrize("k", RATIOS)
def test_the_field_is_filtered_like_the_rest(k):
    out = whole(with_field(noisy(), np.ones(400, bool)), k)
    np.testing.assert_allclose(out.field_tesla, out.gyro_radps, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(out.field_sd_tesla, out.gyro_sd_radps, rtol=1e-12)


@pytest.mark.parametrize("k", RATIOS)
def test_a_slow_magnetometer_loses_no_field_and_mixes_none_in(k):
    there = np.random.default_rng(4).random(400) < 0.2
    block = with_field(noisy(), there)
    block.field_tesla[~there] = 1e6
    out = whole(block, k)
    for n, i in enumerate(range(0, 400, k)):
        mine = [j for j in range(max(i - k // 2, 0), min(i + (k - 1) // 2 + 1, 400)) if there[j]]
        if 4 * k <= i < 400 - 4 * k:
            assert (out.field_sd_tesla[n] >= 0.0) == bool(mine)
            expected = block.field_tesla[mine].mean(axis=0) if mine else np.zeros(3)
            np.testing.assert_allclose(out.field_tesla[n], expected, rtol=1e-12)
            assert not mine or out.field_sd_tesla[n] == pytest.approx(1.0 / np.sqrt(len(mine)))
    plain = whole(noisy(), k)
    assert same(out[:5], plain[:5]), "the others do not notice"


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_value_that_is_no_number_spoils_no_other(value):
    block = noisy()
    block.accel_mps2[[100, 202], 1] = value
    out = whole(block, 4)
    np.testing.assert_array_equal(np.flatnonzero(~np.isfinite(out.accel_mps2[:, 1])), [25])
    assert np.isfinite(out.gyro_radps).all()


def test_nothing_crosses_a_gap():
    block = noisy()
    block.stamp_ns[200:] += GAP_NS
    parts = [whole(part(block, 0, 200), 4), whole(part(block, 200), 4)]
    assert same(whole(block, 4), joined(parts))


def test_a_burst_on_arrival_is_filtered_like_even_samples():
    block, even = noisy(), noisy()
    block.stamp_ns[1::2] = block.stamp_ns[:-1:2]
    np.testing.assert_array_equal(whole(block, 4).gyro_radps, whole(even, 4).gyro_radps)


@given(st.sampled_from([1, 2, 3, 7]), st.lists(st.integers(0, 150), max_size=6))
def test_a_stream_cut_anywhere_gives_the_same_bits(k, cuts):
    block, decimation = patchy(), Decimation(k)
    edges = [0, *sorted(cuts), 150]
    pieces = [decimation.run(part(block, a, b)) for a, b in pairwise(edges)]
    assert same(joined([*pieces, decimation.finish()]), whole(block, k))


@given(st.lists(st.integers(1, 6), min_size=1, max_size=30), st.integers(1, 150))
def test_a_stream_whose_rate_changes_gives_each_sample_as_its_rate_wants_it(ratios, cut):
    block, i = patchy(), 0
    stream = ThinnedStream(iter([part(block, 0, cut), part(block, cut)]))
    for k in ratios:
        if stream.next is None:
            break
        assert same(stream.next, part(block, i, i + 1))
        assert same(stream.take(k), thinned(block, i, i + 1, k))
        i += k
    assert (stream.next is None) == (i >= 150)


def test_a_long_stream_forgets_what_no_filter_needs():
    stream = ThinnedStream(iter(part(noisy(40_000), a, a + 1000) for a in range(0, 40_000, 1000)))
    for _ in range(19_000):
        stream.take(2)
    assert length(stream._samples) < 8000
    assert same(stream.take(2), thinned(noisy(40_000), 38_000, 38_001, 2))


def test_a_sensor_is_lowered_as_near_to_the_rate_as_possible():
    sensor = Sensor("imu", None, lambda most: iter(part(noisy(), a, a + most) for a in range(0, 400, most)))
    assert rate_of_hz(sensor) == RATE_HZ
    assert [kept_of(RATE_HZ, hz) for hz in (1000.0, 100.0, 61.0, 50.0)] == [1, 2, 3, 4]
    lower = decimated(sensor, 4)
    assert same(joined(list(lower.pieces())), whole(noisy(), 4))
    assert same(joined(list(lower.pieces(30))), whole(noisy(), 4))
    assert all(length(piece) for piece in lower.pieces(3))
    assert reached(1) == 0


def test_the_rate_of_nothing_is_none():
    assert rate_of_hz(Sensor("imu", None, lambda _: iter([]))) == 0.0

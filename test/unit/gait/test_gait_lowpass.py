"""The even, low-passed acceleration: the filter it is, and streams that are cut, late, broken or of another rate."""

import numpy as np
import pytest
from scipy.signal import firwin

from pdr_core.gait.lowpass import GRID_NS, EvenBlock, LowPass
from pdr_core.params import GaitParams
from pdr_core.records import Floats, ImuBlock, inertial_block, joined, length, part

PARAMS = GaitParams()
G = np.array([0.0, 0.0, 9.81])


def block(time_s: Floats, accel_mps2: Floats) -> ImuBlock:
    n = len(time_s)
    stamp_ns = np.rint(time_s * 1e9).astype(np.int64)
    return inertial_block(stamp_ns, np.full((n, 3), np.nan), accel_mps2, np.full(n, -1.0), np.zeros(n))


def noise(rate_hz: float, seconds: float = 3.0, seed: int = 1) -> ImuBlock:
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    return block(time_s, G + np.random.default_rng(seed).standard_normal((len(time_s), 3)))


def same(a: EvenBlock, b: EvenBlock) -> bool:
    return all(np.array_equal(left, right) for left, right in zip(a, b, strict=True))


@pytest.mark.parametrize("rate_hz", [100.0, 200.0, 500.0])
def test_it_is_the_filter_that_scipy_designs_for_the_rate(rate_hz: float) -> None:
    imu = noise(rate_hz)
    even = LowPass(PARAMS).run(imu)
    weights = firwin(round(PARAMS.filter_s * rate_hz) + 1, PARAMS.cutoff_hz, window="hamming", fs=rate_hz)
    weights[[0, -1]] *= 0.5
    weights /= weights.sum()
    whole = np.stack([np.convolve(imu.accel_mps2[:, axis], weights, "valid") for axis in range(3)], axis=1)
    assert even.accel_mps2 == pytest.approx(whole[:: round(rate_hz / 50.0)], abs=2e-3)


@pytest.mark.parametrize("rate_hz", [20.0, 37.0, 100.0, 400.0])
def test_a_slow_motion_passes_without_delay_at_any_rate(rate_hz: float) -> None:
    def motion(time_s: Floats) -> Floats:
        return G + np.sin(2.0 * np.pi * 1.3 * time_s)[:, None] * [3.0, -2.0, 1.0]

    time_s = np.arange(round(4.0 * rate_hz)) / rate_hz
    even = LowPass(PARAMS).run(block(time_s, motion(time_s)))
    assert even.accel_mps2 == pytest.approx(motion(even.stamp_ns * 1e-9), abs=0.25)
    assert np.diff(even.stamp_ns) == pytest.approx(GRID_NS)
    assert even.stamp_ns[0] == round(0.5e9 * PARAMS.filter_s)
    assert even.stamp_ns[-1] > (time_s[-1] - 0.5 * PARAMS.filter_s) * 1e9 - GRID_NS


@pytest.mark.parametrize("rate_hz", [100.0, 75.0, 50.0, 20.0])
@pytest.mark.parametrize("motion_hz", [0.8, 2.4, 3.2])
def test_a_motion_is_as_large_from_any_rate(motion_hz: float, rate_hz: float) -> None:
    """With ends that count whole, 50 Hz would show 3.2 Hz as .6 % larger than 200 Hz does."""
    assert size(motion_hz, rate_hz) == pytest.approx(size(motion_hz, 200.0), rel=1e-3)


def size(motion_hz: float, rate_hz: float) -> float:
    """Return the amplitude with which a motion of 1 m/s^2 passes."""
    time_s = np.arange(round(20.0 * rate_hz)) / rate_hz
    moved = np.sin(2.0 * np.pi * motion_hz * time_s)[:, None] * [1.0, 0.0, 0.0]
    even = LowPass(PARAMS).run(block(time_s, moved))
    angle = 2.0 * np.pi * motion_hz * even.stamp_ns * 1e-9
    waves = np.column_stack([np.sin(angle), np.cos(angle)])
    return float(np.linalg.norm(np.linalg.lstsq(waves, even.accel_mps2[:, 0])[0]))


def test_a_vibration_does_not_pass() -> None:
    time_s = np.arange(800) / 200.0
    shaken = G + 5.0 * np.sin(2.0 * np.pi * 25.0 * time_s)[:, None] * [1.0, 1.0, 1.0]
    assert np.abs(LowPass(PARAMS).run(block(time_s, shaken)).accel_mps2 - G).max() < 0.05


@pytest.mark.parametrize("piece", [1, 2, 7, 150])
def test_however_the_stream_is_cut(piece: int) -> None:
    imu = noise(100.0)
    imu = imu._replace(stamp_ns=np.where(np.arange(300) >= 200, imu.stamp_ns + 10**9, imu.stamp_ns))
    lowpass = LowPass(PARAMS)
    pieces = [lowpass.run(part(imu, i, i + piece)) for i in range(0, 300, piece)]
    assert same(joined(pieces), LowPass(PARAMS).run(imu))


def test_later_stamps_shift_nothing() -> None:
    imu = noise(90.0)
    later = imu._replace(stamp_ns=imu.stamp_ns + 1_700_000_000_123_456_789)
    even, after = LowPass(PARAMS).run(imu), LowPass(PARAMS).run(later)
    assert np.array_equal(even.accel_mps2, after.accel_mps2)
    assert np.array_equal(after.stamp_ns - even.stamp_ns, np.full(length(even), 1_700_000_000_123_456_789))


@pytest.mark.parametrize("jump_s", [0.2, 30.0, -5.0])
def test_a_gap_or_a_clock_set_back_begins_anew(jump_s: float) -> None:
    before, after = noise(100.0), noise(100.0, seed=2)
    after = after._replace(stamp_ns=after.stamp_ns + before.stamp_ns[-1] + round(jump_s * 1e9))
    lowpass = LowPass(PARAMS)
    first, second = lowpass.run(before), lowpass.run(after)
    assert same(second, LowPass(PARAMS).run(after))
    assert np.flatnonzero(joined([first, second]).fresh).tolist() == [0, length(first)]
    assert same(joined([first, second]), LowPass(PARAMS).run(joined([before, after])))


def test_samples_that_are_no_numbers_or_not_measured_are_left_out() -> None:
    imu = noise(200.0)
    imu.accel_mps2[50], imu.accel_mps2[51, 1] = np.nan, np.inf
    imu.accel_sd_mps2[100:104] = -1.0
    imu.accel_mps2[100:104] = 1e6
    even = LowPass(PARAMS).run(imu)
    assert np.isfinite(even.accel_mps2).all()
    assert np.abs(even.accel_mps2 - G).max() < 1.5
    assert even.fresh.sum() == 1


def test_nothing_in_nothing_out() -> None:
    lowpass = LowPass(PARAMS)
    assert length(lowpass.run(part(noise(100.0), 0, 0))) == 0
    assert length(lowpass.run(part(noise(100.0), 0, 5))) == 0

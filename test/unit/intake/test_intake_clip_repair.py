import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdr_core.intake.clip_stage import ClipRepair
from pdr_core.params import IntakeParams
from pdr_core.records import inertial_block, joined, length, part

MS, BEGIN_NS = 1_000_000, 10**18


def block(gyro, rate_hz=200.0):
    n = len(gyro)
    stamps = BEGIN_NS + np.rint(np.arange(n) * 1e9 / rate_hz).astype(np.int64)
    return inertial_block(
        stamps, np.ascontiguousarray(gyro), np.tile([0.0, 0.0, 9.81], (n, 1)), np.zeros(n), np.zeros(n)
    )


def swings(rate_hz=200.0, peak=14.0, limit=np.inf, seed=0, noise=0.0):
    """Return two seconds of rates about y that swing to both sides with 3 Hz, clipped at a limit."""
    t = np.arange(0.0, 2.0, 1.0 / rate_hz)
    rate = peak * np.sin(2 * np.pi * 3.0 * t) ** 3
    gyro = np.column_stack([0.2 * rate, rate, -0.1 * rate])
    gyro += noise * np.random.default_rng(seed).standard_normal(gyro.shape)
    return np.clip(gyro, -limit, limit)


def repaired(imu):
    stage = ClipRepair(IntakeParams())
    (a, x), (b, y) = stage.run(imu), stage.finish()
    return joined([a, b]), np.concatenate([x, y])


@pytest.mark.parametrize("rate_hz", [100.0, 200.0, 400.0, 1000.0])
@pytest.mark.parametrize("limit", [8.73, 10.0])
def test_a_clipped_swing_gets_most_of_its_peak_back(rate_hz, limit):
    true, clipped = swings(rate_hz), swings(rate_hz, limit=limit, noise=0.003)
    out, flags = repaired(block(clipped, rate_hz))
    lost, left = np.abs(true - clipped)[:, 1].mean(), np.abs(true - out.gyro_radps)[:, 1].mean()
    print(f"{left / lost:.2f} of the lost angle stays lost, peak {np.abs(out.gyro_radps).max():.1f} of 14")
    assert left < 0.35 * lost
    assert flags[(out.gyro_radps != clipped).any(axis=1)].all()
    assert not flags[np.abs(clipped[:, 1]) < 0.9 * limit].any()


@pytest.mark.parametrize("rate_hz", [100.0, 200.0, 1000.0])
@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_a_swing_within_the_range_is_left_as_it_is(rate_hz, noise):
    imu = block(swings(rate_hz, noise=noise), rate_hz)
    out, flags = repaired(imu)
    np.testing.assert_array_equal(out.gyro_radps, imu.gyro_radps)
    assert not flags.any()


def test_a_steady_turn_is_no_plateau():
    rate = np.concatenate([np.zeros(100), np.linspace(0, 6, 50), np.full(300, 6.0), np.linspace(6, 0, 50)])
    imu = block(np.column_stack([rate, np.zeros(500), np.zeros(500)]))
    out, flags = repaired(imu)
    np.testing.assert_array_equal(out.gyro_radps, imu.gyro_radps)
    assert not flags.any()


def test_an_axis_that_has_shown_more_does_not_clip_at_less():
    small, large = swings(limit=9.0), swings()
    assert repaired(block(np.concatenate([small, large])))[1][:400].any()
    assert not repaired(block(np.concatenate([large, small])))[1].any()


def test_a_repaired_peak_is_at_most_twice_the_level():
    rate = np.zeros((60, 3))
    rate[20:33, 0] = np.concatenate([[1.0, 4.0], np.full(9, 8.0), [4.0, 1.0]])
    out, flags = repaired(block(rate))
    assert flags[22:31].all()
    assert 9.0 < out.gyro_radps.max() <= 16.0


def test_each_axis_clips_by_itself():
    gyro = swings(limit=9.0)
    out, _ = repaired(block(gyro))
    np.testing.assert_array_equal(out.gyro_radps[:, [0, 2]], gyro[:, [0, 2]])


@given(st.lists(st.integers(0, 400), max_size=10), st.booleans())
def test_a_stream_gives_the_bits_of_the_whole(cuts, long_plateau):
    gyro = swings(limit=9.0, noise=0.01)
    if long_plateau:
        gyro[50:75, 2] = 9.1
    imu = block(gyro)
    imu.stamp_ns[120:] += 200 * MS  # a gap within a plateau
    stage, found = ClipRepair(IntakeParams()), []
    for start, stop in zip([0, *sorted(cuts)], [*sorted(cuts), 400], strict=True):
        found.append(stage.run(part(imu, start, stop)))
    found.append(stage.finish())
    out, flags = repaired(imu)
    np.testing.assert_array_equal(joined([b for b, _ in found]).gyro_radps, out.gyro_radps)
    np.testing.assert_array_equal(joined([b for b, _ in found]).stamp_ns, imu.stamp_ns)
    np.testing.assert_array_equal(np.concatenate([f for _, f in found]), flags)


@pytest.mark.parametrize("rate_hz", [100.0, 200.0, 1000.0])
def test_no_sample_waits_longer_than_it_may(rate_hz):
    gyro = swings(rate_hz, limit=9.0)
    gyro[60:95] = 9.5
    imu, stage, out, waited_ns = block(gyro, rate_hz), ClipRepair(IntakeParams()), 0, 0
    for i in range(length(imu)):
        out += length(stage.run(part(imu, i, i + 1))[0])
        waited_ns = max(waited_ns, imu.stamp_ns[i] - imu.stamp_ns[min(out, i)])
    assert 10 * MS < waited_ns <= 100 * MS

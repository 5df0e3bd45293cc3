import numpy as np
import pytest

from pdr_core.params import PlaceParams, StanceParams
from pdr_core.records import inertial_block, joined, part
from pdr_core.stance import StanceDetection

RATE_HZ, BIAS = 200.0, np.array([0.002, -0.001, 0.003])


def walked(*pieces, noise=0.0, seed=0, start_ns=10**18):
    """Return samples of (seconds, rate about y [rad/s]) pieces on top of the bias, and where each piece begins."""
    counts = [round(seconds * RATE_HZ) for seconds, _ in pieces]
    n = sum(counts)
    gyro = np.tile(BIAS, (n, 1)) + noise * np.random.default_rng(seed).standard_normal((n, 3))
    gyro[:, 1] += np.concatenate([np.full(c, rate) for c, (_, rate) in zip(counts, pieces, strict=True)])
    stamps = start_ns + np.arange(n, dtype=np.int64) * round(1e9 / RATE_HZ)
    imu = inertial_block(stamps, gyro, np.tile([0.0, 0.0, 9.81], (n, 1)), np.full(n, 0.01), np.full(n, 0.1))
    return imu, np.concatenate([[0], np.cumsum(counts)])


def evidence(imu, **changed):
    """Return sample, rate and deviation of every rest that was found."""
    detection = StanceDetection(StanceParams(**changed), PlaceParams())
    judged = joined([detection.run(imu), detection.finish()])
    at = np.flatnonzero(judged.rest_sd_radps != 0.0)
    return at, judged.rest_rate_radps[at], judged.rest_sd_radps[at]


def test_the_first_rest_shows_a_constant_bias_when_it_ends():
    imu, begins = walked((2.0, 0.0), (1.0, 3.0))
    at, rate, sd = evidence(imu)
    assert len(at) == 1
    assert begins[1] < at[0] <= begins[1] + 0.05 * RATE_HZ
    np.testing.assert_allclose(rate[0], BIAS, atol=1e-10)
    assert sd[0] == pytest.approx(np.hypot(8.7e-4, np.sqrt(2) * 5.2e-4 / 1.9), rel=0.03)


def test_the_deviation_holds_for_a_noisy_gyro():
    errors = [
        evidence(walked((3.0, 0.0), (0.5, 3.0), noise=0.0142, seed=s)[0]) for s in range(60)
    ]  # .001 rad/s/sqrt(Hz)
    off = np.array([(rate[0] - BIAS) / sd[0] for _, rate, sd in errors])
    assert np.sqrt(np.mean(off**2)) < 1.2


def test_a_wobble_lowers_the_weight():
    quiet, begins = walked((2.0, 0.0), (1.0, 3.0))
    wobbling = quiet._replace(gyro_radps=quiet.gyro_radps.copy())
    time = np.arange(begins[1]) / RATE_HZ
    wobbling.gyro_radps[: begins[1], 2] += 0.1 * np.cos(2 * np.pi * 2.0 * time)
    (_, _, sd_quiet), (_, rate, sd) = evidence(quiet), evidence(wobbling)
    assert sd[0] > 4 * sd_quiet[0]
    assert np.abs(rate[0] - BIAS).max() < 3 * sd[0]


def test_the_quietest_window_speaks_for_the_rest():
    imu, _ = walked((1.5, 0.3), (2.0, 0.0), (1.0, 3.0))
    _, rate, _ = evidence(imu)
    np.testing.assert_allclose(rate[0], BIAS, atol=1e-9)


def test_a_walk_gives_no_evidence():
    imu, begins = walked((2.0, 0.0), *[(0.6, 4.0), (0.5, 0.0)] * 10, (0.6, 4.0))
    at, *_ = evidence(imu)
    assert len(at) == 1
    assert at[0] < begins[2]


@pytest.mark.parametrize(("seconds", "found"), [(1.9, 1), (2.5, 2)])
def test_a_later_rest_must_be_long(seconds, found):
    imu, _ = walked((2.0, 0.0), (1.0, 4.0), (seconds, 0.0), (1.0, 4.0))
    assert len(evidence(imu)[0]) == found


def test_a_first_rest_that_is_too_short_says_nothing():
    assert len(evidence(walked((0.4, 0.0), (1.0, 4.0))[0])[0]) == 0


def test_a_rest_ends_when_the_gyro_is_switched_off():
    imu, begins = walked((2.0, 0.0), (1.0, 0.0))
    imu.gyro_sd_radps[begins[1] :] = -1.0
    at, rate, _ = evidence(imu)
    assert at.tolist() == [begins[1]]
    np.testing.assert_allclose(rate[0], BIAS, atol=1e-10)


def test_missing_samples_end_a_rest_instead_of_being_taken_for_it():
    noisy, _ = walked((0.3, 0.0), (0.3, 0.0), (1.0, 4.0), noise=0.02, seed=3)
    noisy.stamp_ns[60:] += 2_000_000_000
    assert len(evidence(noisy)[0]) == 0
    imu, begins = walked((2.0, 0.0), (2.5, 0.0), (1.0, 4.0))
    imu.stamp_ns[begins[1] :] += 10**18  # 30 years: also must not be searched in steps of 40 ms
    at, *_ = evidence(imu)
    assert at[0] == begins[1]
    assert len(at) == 2


def test_a_rest_after_the_clock_has_jumped_back_counts_anew():
    imu, begins = walked((2.0, 0.0), (2.5, 0.0), (1.0, 4.0))
    imu.stamp_ns[begins[1] :] -= 10**15
    at, rate, _ = evidence(imu)
    assert at[0] == begins[1]
    assert len(at) == 2
    np.testing.assert_allclose(rate, np.tile(BIAS, (2, 1)), atol=1e-10)


def test_movement_is_noticed_without_smoothing():
    assert len(evidence(walked((2.0, 0.0), (1.0, 4.0))[0], rest_smoothing_s=0.0)[0]) == 1


def test_a_long_rest_uses_its_last_part_and_bounded_memory():
    imu, begins = walked((60.0, 0.0), (1.0, 4.0))
    at, rate, _ = evidence(imu)
    assert len(at) == 1
    assert begins[1] < at[0]
    np.testing.assert_allclose(rate[0], BIAS, atol=1e-9)


def test_a_shorter_stream_gives_the_same_evidence_sample_by_sample():
    imu, _ = walked((2.0, 0.0), (0.5, 3.0), (2.5, 0.0), (0.5, 3.0), noise=0.01)
    detection = StanceDetection(StanceParams(), PlaceParams())
    pieces = [detection.run(part(imu, i, i + 1)) for i in range(len(imu.stamp_ns))]
    streamed = joined([*pieces, detection.finish()])
    at, rate, sd = evidence(imu)
    np.testing.assert_array_equal(streamed.rest_sd_radps[at], sd)
    np.testing.assert_array_equal(streamed.rest_rate_radps[at], rate)

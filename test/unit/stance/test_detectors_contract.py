"""What every stance detector and every time gate of the catalogue must keep."""

import dataclasses
import warnings
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pdr_core.conventions import gravity_mps2
from pdr_core.parameter import meta
from pdr_core.params import DetectorParams, PlaceParams, SimulationParams, StanceParams
from pdr_core.records import ImuBlock, inertial_block, joined, length, part
from pdr_core.simulation import simulated_walk
from pdr_core.stance import StanceDetection, catalogue

PLACE = PlaceParams()
G = gravity_mps2(np.radians(PLACE.latitude_deg), PLACE.height_m)
CHOICES = {field.name: meta(field).choices for field in dataclasses.fields(StanceParams)}
DETECTORS = CHOICES["detector"]
WITHOUT_GYRO = ("acceleration_moving_variance", "acceleration_magnitude", "mbgtd")
EACH = pytest.mark.parametrize("detector", DETECTORS)
EACH_GATE = pytest.mark.parametrize("gate", CHOICES["time_gate"])


def walk(rate_hz):
    params = SimulationParams(motion="smooth", walk="straight", walk_length_m=4.8, sample_rate_hz=rate_hz)
    return simulated_walk(params, start_ns=10**18)


def troubled():
    """Return a walk with a gap, a clock that is set back, and a pause of the gyro."""
    imu = ImuBlock(*(column.copy() for column in walk(200.0).imu))
    imu.stamp_ns[650:] += 3_000_000_000
    imu.stamp_ns[900:] -= 500_000_000_000
    imu.gyro_radps[1000:1100], imu.gyro_sd_radps[1000:1100] = 0.0, -1.0
    return imu


WALK, TROUBLED = walk(200.0), troubled()


def stage(detector, gate="none"):
    return StanceDetection(StanceParams(detector=detector, time_gate=gate), PLACE)


def judged(imu, detector, gate="none"):
    stance = stage(detector, gate)
    return joined([stance.run(imu), stance.finish()])


def same(a, b):
    return all(np.array_equal(x, y) for x, y in zip((*a.imu, *a[1:]), (*b.imu, *b[1:]), strict=True))


def resting(seconds=3.0, rate_hz=200.0, gyro_sd=0.014, accel_sd=0.21):
    """Return a consumer sensor at rest, tilted; its noise in one sample at 200 Hz."""
    rng, n = np.random.default_rng(5), round(seconds * rate_hz)
    stamps = 10**18 + np.arange(n, dtype=np.int64) * round(1e9 / rate_hz)
    force = G * np.array([0.6, 0.0, 0.8]) + accel_sd * rng.standard_normal((n, 3))
    return inertial_block(
        stamps, gyro_sd * rng.standard_normal((n, 3)), force, np.full(n, gyro_sd), np.full(n, accel_sd)
    )


def shaken(seconds=2.0):
    """Return a foot that swings all the time: it turns and is accelerated, never twice alike."""
    imu = resting(seconds)
    time = (imu.stamp_ns - imu.stamp_ns[0]) / 1e9
    waves = [np.sin(2 * np.pi * f * time + phase) for f, phase in ((5.0, 0.0), (7.0, 1.0), (6.0, 2.0))]
    return imu._replace(
        gyro_radps=np.column_stack(waves) * 4.0 + 4.0, accel_mps2=imu.accel_mps2 + 25.0 * np.column_stack(waves)
    )


def test_the_parameters_offer_what_the_catalogue_has():
    assert tuple(catalogue.detectors(StanceParams(), DetectorParams(), G)) == DETECTORS
    assert tuple(catalogue.time_gates(DetectorParams(), None)) == CHOICES["time_gate"]
    assert StanceParams().detector == DETECTORS[0] == "adaptive"


@EACH
@EACH_GATE
def test_rest_stays_at_rest(detector, gate):
    assert judged(resting(), detector, gate).stance.all()


@EACH
@EACH_GATE
def test_a_foot_in_swing_does_not_stand(detector, gate):
    assert not judged(shaken(), detector, gate).stance.any()


@EACH
def test_the_stances_of_a_walk_are_found(detector):
    found = judged(WALK.imu, detector).stance
    inside = np.convolve(WALK.motion.stance, np.ones(25), "same") == 25  # away from toe-off and heel strike
    assert np.mean(found[inside]) > 0.85  # the foot rolls meanwhile
    begins = np.flatnonzero(np.diff(WALK.motion.stance.astype(int), prepend=0) == 1)
    assert np.all(np.add.reduceat(found & WALK.motion.stance, begins) > 0)
    assert np.mean(found[~WALK.motion.stance]) < 0.35


@EACH
def test_turning_the_sensor_changes_nothing(detector):
    turn = Rotation.from_rotvec([0.4, -1.9, 0.8]).as_matrix().T
    turned = WALK.imu._replace(gyro_radps=WALK.imu.gyro_radps @ turn, accel_mps2=WALK.imu.accel_mps2 @ turn)
    one, other = judged(WALK.imu, detector), judged(turned, detector)
    np.testing.assert_allclose(other.statistic, one.statistic, rtol=1e-9, atol=1e-12)
    np.testing.assert_array_equal(other.stance, one.stance)


@EACH
@EACH_GATE
def test_later_stamps_shift_nothing(detector, gate):
    one = judged(WALK.imu, detector, gate)
    later = judged(WALK.imu._replace(stamp_ns=WALK.imu.stamp_ns + 10**17), detector, gate)
    assert same(later._replace(imu=one.imu), one)


@EACH
@EACH_GATE
@given(cuts=st.lists(st.integers(0, length(TROUBLED)), max_size=6))
@settings(max_examples=8)
def test_cutting_the_stream_anywhere_changes_nothing(detector, gate, cuts):
    stance = stage(detector, gate)
    ends = [0, *sorted(cuts), length(TROUBLED)]
    pieces = [stance.run(part(TROUBLED, a, b)) for a, b in pairwise(ends)]
    assert same(joined([*pieces, stance.finish()]), judged(TROUBLED, detector, gate))


@EACH_GATE
def test_sample_by_sample_no_verdict_waits_longer_than_the_latency(gate):
    stance, known, waited_ns = stage("mbgtd", gate), 0, 0
    for i in range(length(WALK.imu)):
        known += length(stance.run(part(WALK.imu, i, i + 1)))
        if known <= i:
            waited_ns = max(waited_ns, WALK.imu.stamp_ns[i] - WALK.imu.stamp_ns[known])
    assert waited_ns < stance.latency_s * 1e9 + 5_000_000  # the window ends at the next sample there is


@EACH
@pytest.mark.parametrize("trouble", ["free fall", "one sample", "no gyro", "a gap", "clipped"])
def test_a_verdict_follows_from_its_statistic_and_nothing_is_nan(detector, trouble):
    imu = ImuBlock(*(column.copy() for column in WALK.imu))
    if trouble == "free fall":
        imu.accel_mps2[:], imu.gyro_radps[:] = 0.0, 0.0
    if trouble == "one sample":
        imu = part(imu, 0, 1)
    if trouble == "no gyro":
        imu.gyro_radps[:], imu.gyro_sd_radps[:] = 0.0, -1.0
    if trouble == "a gap":
        imu.stamp_ns[300:] += 3_000_000_000
    if trouble == "clipped":
        imu.accel_mps2[:] = np.clip(imu.accel_mps2, -20.0, 20.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        out = judged(imu, detector)
    for column in (out.statistic, out.threshold, out.zero_velocity_sd_mps):
        assert not np.isnan(column).any()
    np.testing.assert_array_equal(out.stance, out.statistic <= out.threshold)
    assert np.isfinite(out.zero_velocity_sd_mps[out.stance]).all()


@EACH
def test_without_the_gyro_only_the_accelerometer_judges(detector):
    off = WALK.imu._replace(gyro_radps=WALK.imu.gyro_radps * 0.0, gyro_sd_radps=np.full(length(WALK.imu), -1.0))
    blind, seeing = judged(off, detector).stance, judged(WALK.imu, detector).stance
    np.testing.assert_array_equal(blind, seeing if detector in WITHOUT_GYRO else np.zeros_like(seeing))


@EACH
@pytest.mark.parametrize("rate_hz", [50.0, 100.0, 500.0, 1000.0])
def test_the_rate_hardly_changes_a_verdict(detector, rate_hz):
    other = walk(rate_hz)
    found, usual = judged(other.imu, detector), judged(WALK.imu, detector)
    there = np.searchsorted(found.imu.stamp_ns, usual.imu.stamp_ns[:-4:4])
    assert np.mean(found.stance[there] == usual.stance[:-4:4]) > 0.93


@EACH
def test_a_threshold_is_in_si_units(detector):
    """A sensor that says g and degrees instead of SI does not pass as one at rest while it walks, or the reverse."""
    in_degrees = resting()._replace(gyro_radps=np.degrees(shaken(3.0).gyro_radps))
    assert (not judged(in_degrees, detector).stance.any()) == (detector not in WITHOUT_GYRO)
    in_g = resting()._replace(accel_mps2=resting().accel_mps2 / 9.81)
    cares = detector not in ("angular_rate_energy", "acceleration_moving_variance", "mbgtd")
    assert (not judged(in_g, detector).stance.any()) == cares

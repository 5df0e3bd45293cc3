"""Somebody else who follows a simulated person says what the source is said to do wrong, when it is said."""

import numpy as np
import pytest

from pdr_core.records import Truth, TruthKind
from pdr_core.records_external import about_up
from pdr_core.simulation.external_source import ExternalSource, body_of, fixes

T = np.arange(0, 120 * 10**9, 10**7, dtype=np.int64)
PLACES_M = np.column_stack([1.3e-9 * T, np.sin(1e-10 * T), np.zeros(len(T))])
TRUTH = Truth(TruthKind.POSITION, T + 7, PLACES_M)
EXACT = {"noise_sd_m": 0.0, "tells_noise": False}


def off_m(source):
    """When they speak [s], and by how much each fix is off in their frame."""
    said = fixes(TRUTH, source)
    at_s = (said.stamp_ns - 7) * 1e-9 - source.clock_s
    true_m = np.column_stack([np.interp(at_s, T * 1e-9, column) for column in PLACES_M.T])
    return at_s, said.position_m - true_m @ about_up(source.yaw_rad).T - source.shift_m


def test_a_source_without_errors_is_exact_in_its_frame_and_by_its_clock():
    at_s, off = off_m(ExternalSource(**EXACT))
    np.testing.assert_allclose(off, 0.0, atol=1e-9)
    np.testing.assert_allclose(np.diff(at_s), 1.0)


def test_noise_is_as_large_as_it_says():
    said = fixes(TRUTH, ExternalSource(rate_hz=20.0))
    assert off_m(ExternalSource(rate_hz=20.0))[1].std() == pytest.approx(0.3, rel=0.05)
    assert said.variance_m2 == pytest.approx(0.09)
    assert (fixes(TRUTH, ExternalSource(tells_noise=False)).variance_m2 == 0.0).all()


def test_trouble_comes_when_it_shall():
    troubles = {"outliers_s": (50.0,), "silent": ((20.0, 30.0),), "drifts": (70.0, 90.0), "back_s": 100.0}
    at_s, off = off_m(ExternalSource(**EXACT, **troubles))
    size_m = np.linalg.norm(off, axis=1)
    assert not ((at_s > 20.0) & (at_s < 30.0)).any()
    wrong = (at_s >= 50.0) & (at_s < 51.0)
    assert size_m[wrong] == pytest.approx([100.0])
    assert size_m[(at_s < 70.0) & ~wrong].max() < 1e-9
    assert np.interp(80.0, at_s, size_m) == pytest.approx(1.0)
    assert size_m[(at_s > 91.0) & (at_s < 99.0)] == pytest.approx(2.0)
    assert size_m[at_s > 100.0].max() < 1e-9


def test_a_frozen_source_says_the_same_to_the_last_bit():
    said = fixes(TRUTH, ExternalSource(frozen=((40.0, 60.0),)))
    at_s = (said.stamp_ns - 7) * 1e-9 - 0.4
    frozen = (at_s >= 40.0) & (at_s < 60.0)
    assert len(np.unique(said.position_m[frozen], axis=0)) == 1
    assert len(np.unique(said.position_m[~frozen], axis=0)) == (~frozen).sum()


def test_the_body_above_a_foot_goes_evenly():
    phase = (T * 1e-9 / 1.1) % 1.0
    foot = 1.4 * (np.floor(T * 1e-9 / 1.1) + np.clip((phase - 0.6) / 0.4, 0.0, 1.0))
    body = body_of(Truth(TruthKind.POSITION, T, np.column_stack([foot, np.zeros((len(T), 2))])))
    speed = np.diff(body.position_m[200:-200, 0]) / 0.01
    assert speed == pytest.approx(1.4 / 1.1, rel=0.1)

"""The walks with somebody else's fixes: what is measured there, on short ones."""

from dataclasses import replace

import numpy as np
import pytest

from pdr_core.bench.external_tables import external_walks
from pdr_core.bench.external_walks import GOOD, LENGTH_M, external_walk, moved_m, silenced, trials

SHORT_M = 240.0


def test_the_walk_is_that_of_the_issue():
    found = {trial.name: trial for trial in trials(0)}
    good = found[GOOD].source
    assert LENGTH_M == 600.0
    assert (good.noise_sd_m, good.rate_hz, good.clock_s) == (0.3, 1.0, 0.4)
    assert found["drifts away at 0.1 m/s"].source.drift_mps == 0.1
    assert found["outliers of 100 m"].source.outlier_m == 100.0
    (begin_s, end_s) = found["silent for 60 s"].source.silent[0]
    assert end_s - begin_s == 60.0


def test_a_source_that_is_silenced_is_good_where_it_speaks():
    for trial in trials(0):
        source = silenced(trial).source
        assert replace(source, silent=()) == trials(0)[0].source
    assert silenced(trials(0)[0]) == trials(0)[0]


@pytest.fixture(scope="module")
def found():
    return external_walks(1, SHORT_M, names=(GOOD, "drifts away at 0.1 m/s"))


def test_the_aided_walk_stays_near_the_truth_and_the_one_without_does_not(found):
    good, drifting = found.rows
    assert good.aligned_s < 90.0
    assert good.worst_m < 1.0
    assert found.unaided_worst_m > 2.0 * good.worst_m
    assert (good.moved_m, good.let_go) == (0.0, 0)
    assert drifting.let_go == 1
    assert 0.0 < drifting.moved_m < 1.0


def test_the_squares_are_those_of_the_place_with_and_without_the_frame(found):
    alone, both = found.consistency
    assert both.mean < alone.mean
    assert 0.2 < both.mean < 6.0


def test_moved_is_the_distance_of_two_tracks():
    track = external_walk(trials(0, 12.0)[0])
    assert np.isnan(track.aligned_s)
    assert np.isnan(track.error_m).all()
    away_m = track.ours_m + np.array([3.0, 4.0])
    assert moved_m(track, track._replace(ours_m=away_m)) == pytest.approx(5.0)

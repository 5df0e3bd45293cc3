"""Real walks with the gyro off in their second half: what the accelerometer and the field are good for.

The bounds leave room for other walks; the figures themselves stand in pdr_core/docs/dead_reckoning.md.
"""

import numpy as np
import pytest

from pdr_core.bench.gyro_off import half_walk
from pdr_core.bench.gyro_off_methods import METHODS, taught
from pdr_core.bench.gyro_off_walk import seen
from pdr_core.bench.trial import Walk
from pdr_core.bench.turn_roc import IMPULSE, rocs
from pdr_core.params import Params
from support.held_recordings import TILES, held, only

NUMBERS = (31, 33, 36, 39)
PARAMS = Params()


@pytest.fixture(scope="module")
def walks(recordings):
    sessions = held(recordings, TILES, [f"SensorConnectData_{n}" for n in NUMBERS])
    return [seen(Walk(n, list(only(s).pieces()), only(s).truth), PARAMS) for n, s in sessions.items()]


@pytest.fixture(scope="module")
def results(walks):
    return {method: [half_walk(walk, method, PARAMS) for walk in walks] for method in METHODS}


def mean_error(results, method):
    return float(np.mean([one.end_error_percent for one in results[method]]))


def test_the_accelerometer_alone_finds_every_stand(walks):
    assert [len(walk.stands) - 1 for walk in walks] == [33, 47, 58, 80]


def test_the_push_across_the_walk_tells_turns_and_the_rest_does_not(walks):
    found = {roc.sign: roc for roc in rocs(walks, PARAMS)}
    at_10, at_30 = found[IMPULSE].detected
    assert found[IMPULSE].area > 0.78
    assert at_10 > 0.5
    assert at_30 > 0.7
    for sign in ("tilt of the stand", "field strength", "field dip"):
        assert found[sign].area < 0.6


def test_the_deviation_of_the_first_half_is_that_of_the_second(walks):
    for walk in walks:
        along = np.diff(walk.nav.position_m[walk.half :, :2], axis=0)
        own = np.arctan2(along[:, 1], along[:, 0]) - walk.yaws_rad[walk.half : -1] - 0.5 * walk.turns_rad[walk.half :]
        off = np.angle(np.mean(np.exp(1j * (own - taught(walk, PARAMS).deviation.rad))))
        assert abs(np.degrees(off)) < 4.0


def test_each_thing_that_is_known_shortens_the_error(results):
    assert mean_error(results, "gyro") < 2.5
    assert mean_error(results, "gyro yaw") < 9.0
    assert mean_error(results, "woken, field") < 16.0
    assert mean_error(results, "woken late, field") < 18.0
    assert mean_error(results, "impulse, field") < 26.0
    assert mean_error(results, "held") > 100.0


def test_the_error_is_as_large_as_the_covariance_says(results):
    for method, walks in results.items():
        if method.endswith("field") and method != "any field":
            squares = [(one.end_error_percent / one.end_sd_percent) ** 2 for one in walks]
            assert np.mean(squares) < 2.5
            assert max(squares) < 6.0

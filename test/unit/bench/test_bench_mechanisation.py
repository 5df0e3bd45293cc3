from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from pdr_core.bench.mechanisation import RATES_HZ, error, mechanisation_errors
from pdr_core.params import SimulationParams

ERRORS = mechanisation_errors(walked_s=6.0)


def test_both_motions_are_measured_at_every_rate():
    assert [(e.motion, e.rate_hz) for e in ERRORS] == [(m, r) for m in ("gui", "smooth") for r in RATES_HZ]
    assert all(5.0 < e.walked_s < 7.0 and 4.0 < e.distance_m < 9.0 for e in ERRORS)


@pytest.mark.parametrize("what", ["position_m", "velocity_mps", "attitude_rad"])
@pytest.mark.parametrize("motion", ["gui", "smooth"])
def test_the_error_falls_with_the_rate_but_never_to_nothing(motion, what):
    errors = [getattr(e, what) for e in ERRORS if e.motion == motion]
    assert all(after < before for before, after in pairwise(errors))
    assert errors[-1] > 0.0


def test_the_attitude_lags_by_second_order_and_the_track_does_not():
    slow, fast = (e for e in ERRORS if e.motion == "smooth" and e.rate_hz in (100.0, 1000.0))
    assert slow.attitude_rad / fast.attitude_rad == pytest.approx(100.0, rel=0.05)
    assert slow.position_m / fast.position_m > 300.0


def test_a_biased_sensor_is_seen():
    params = SimulationParams(walk="straight", walk_length_m=6.0, sensor_model="ideal", motion="smooth")
    biased = replace(params, sensor_model="consumer")
    assert error(biased).position_m > 3.0 * error(params).position_m
    assert error(biased).attitude_rad > np.radians(0.05)

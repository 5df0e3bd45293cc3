"""Real walks whose gyro is switched in their second half: issue bounds, and the curve of docs/energy.md."""

import numpy as np
import pytest

from pdr_core.bench.energy_walks import ALWAYS, FAST, SWING, energy_runs, known, mean
from pdr_core.bench.trial import Walk
from support.held_recordings import TILES, held, only

NUMBERS = (31, 33, 36, 39)


@pytest.fixture(scope="module")
def runs(recordings):
    sessions = held(recordings, TILES, [f"SensorConnectData_{n}" for n in NUMBERS])
    walks = [known(Walk(name, list(only(s).pieces()), only(s).truth)) for name, s in sessions.items()]
    return [run for walk in walks for run in energy_runs(walk, (ALWAYS, SWING, FAST))]


def of(runs, scheme):
    return [run for run in runs if run.scheme == scheme]


@pytest.mark.parametrize("scheme", [SWING, FAST])
def test_the_distance_of_the_second_half_is_kept(runs, scheme):
    errors = np.abs([run.distance_error_percent for run in of(runs, scheme)])
    assert errors.mean() < 3.0
    assert errors.max() < 5.0
    assert all(run.strides_missed == 0 for run in of(runs, scheme))


def test_half_of_the_gyros_time_is_enough_for_the_end(runs):
    swing, fast, always = (mean(of(runs, scheme)) for scheme in (SWING, FAST, ALWAYS))
    assert always.end_error_percent < 1.5
    assert swing.gyro_share < 0.51
    assert swing.end_error_percent < 6.0
    assert fast.gyro_share < 0.51
    assert fast.end_error_percent < 4.0


def test_a_gyro_that_is_on_half_of_the_time_saves_charge_with_its_starts_counted(runs):
    for run in of(runs, SWING):
        assert run.switch_ons >= 15
        assert run.sensor_saved_share > 0.1

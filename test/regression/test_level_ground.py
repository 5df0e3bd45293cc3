"""Level ground on real recordings: heights hold where it is level, and stairs stay stairs."""

from pathlib import Path

import numpy as np
import pytest

from pdr_core.params import Params, changed
from pdr_core.pipeline import FootInertial
from pdr_core.recording import open_recording
from pdr_core.records import Floats
from support.held_recordings import TILES, VICON, XIO, ate2_m, held, results

LEVEL = changed(Params(), "filter", level_ground=True)
RISE_M = 0.08  # a stance that is higher than the one before by more is on the next step
STAIRS = Path("xio_ximu_marg") / "stairsAndCorridor_CalInertialAndMag.csv"


def test_heights_hold_in_the_motion_capture_room(recordings: Path) -> None:
    walks = held(recordings, VICON)
    without, level = results(walks), results(walks, LEVEL)
    ate3_m = {name: result.truth.ate3_m for name, result in level.items()}
    assert len(ate3_m) == 28
    assert np.mean(list(ate3_m.values())) <= 0.070 < np.mean([r.truth.ate3_m for r in without.values()])
    assert max(ate3_m.values()) <= 0.20
    assert {name: r.truth.ate2_m for name, r in level.items()} == {n: r.truth.ate2_m for n, r in without.items()}


def test_a_loop_closes_in_height(recordings: Path) -> None:
    walks = held(recordings, XIO)
    (without,), (level,) = results(walks).values(), results(walks, LEVEL).values()
    assert level.closure_3d_m <= 0.05 < without.closure_3d_m
    assert level.closure_2d_m == without.closure_2d_m


def test_tile_walks_are_level_and_their_tracks_unchanged(recordings: Path) -> None:
    walks = held(recordings, TILES)
    assert ate2_m(walks, LEVEL) == ate2_m(walks)
    for name, result in results(walks, LEVEL).items():
        assert abs(result.end_position_m[2]) <= 0.03, name


def heights_m(path: Path, params: Params) -> Floats:
    """Return the heights of all stances of a recording."""
    (sensor,) = open_recording(path).sensors.values()
    chain = FootInertial(params)
    outputs = [*(chain.run(piece) for piece in sensor.pieces()), chain.finish()]
    return np.array([0.0, *(step.position_m[2] for o in outputs for step in o.steps)])


def test_a_staircase_keeps_its_steps_and_floors(recordings: Path) -> None:
    without, level = (heights_m(recordings / STAIRS, params) for params in (Params(), LEVEL))
    climbs = np.flatnonzero(np.diff(without) > RISE_M)
    assert len(climbs) >= 9
    np.testing.assert_allclose(np.diff(level)[climbs], np.diff(without)[climbs], atol=0.03)
    below, above = level[: climbs[0] + 1], level[climbs[-1] + 1 :]
    assert above.mean() - below.mean() == pytest.approx(without[climbs[-1] + 1] - without[climbs[0]], abs=0.10)
    for floor, drifting in ((below, without[: climbs[0] + 1]), (above, without[climbs[-1] + 1 :])):
        assert np.ptp(floor) <= 0.03 < np.ptp(drifting)

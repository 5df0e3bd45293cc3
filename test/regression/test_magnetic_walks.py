"""Tile walks with their magnetometer: it must help, and never harm; `-s` shows the table."""

from pathlib import Path

import numpy as np
import pytest

from pdr_core.bench.trial import Walk, trial
from pdr_core.params import Params, changed
from pdr_core.recording import open_recording
from pdr_core.records import ImuBlock

WALKS = (31, 33, 36, 39)
ALL_AXES_DEGPS = np.array([1.0, 1.0, 1.0])
WITHOUT = changed(Params(), "filter", magnetometer="off")


def biased(block: ImuBlock, bias_degps: np.ndarray) -> ImuBlock:
    return block._replace(gyro_radps=block.gyro_radps + np.radians(bias_degps))


def ate2_m(recordings: Path, params: Params, bias_degps: np.ndarray | float = 0.0) -> np.ndarray:
    """Return the horizontal error of each walk, (4,)."""
    found = []
    for number in WALKS:
        sensor = open_recording(recordings / f"tile_walks_marg/SensorConnectData_{number}.csv").sensors["imu"]
        pieces = [biased(piece, np.asarray(bias_degps)) for piece in sensor.pieces()]
        assert (pieces[0].field_sd_tesla >= 0.0).all()
        found.append(trial(Walk(str(number), pieces, sensor.truth), params).score.error_m)
    print(f"{params.filter.magnetometer:>6} {bias_degps}: {np.round(found, 3)} mean {np.mean(found):.3f} m")
    return np.array(found)


def test_the_magnetometer_harms_no_walk(recordings: Path) -> None:
    without, with_field = ate2_m(recordings, WITHOUT), ate2_m(recordings, Params())
    assert (with_field <= 1.05 * without).all()
    assert np.mean(with_field) <= 0.21


@pytest.mark.parametrize("axes", [(1, 1, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
def test_the_magnetometer_removes_a_bias_of_one_degree_a_second(recordings: Path, axes: tuple[int, ...]) -> None:
    assert np.mean(ate2_m(recordings, Params(), np.array(axes))) <= 0.28

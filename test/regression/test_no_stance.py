"""No real foot is taken for one that never stands: else it would be told to be a card on the chest."""

import pytest

from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.recording import open_recording

SETS = {  # the recordings of each folder, and how many sensors they have
    "pyshoe_vicon": ("*.mat", 28),
    "tile_walks_marg": ("*.csv", 5),
    "xio_ngimu": ("*.csv", 1),
    "xio_ximu_marg": ("*.csv", 2),
    "ros1_foot_imu": ("*.csv", 1),
    "gaitmap_dual_foot": ("imu_sample.csv", 2),
}


@pytest.mark.parametrize("folder", SETS)
def test_a_real_foot_stands(recordings, folder):
    pattern, count = SETS[folder]
    sensors = [
        (path.name, sensor)
        for path in sorted((recordings / folder).glob(pattern))
        for sensor in open_recording(path).sensors.values()
    ]
    assert len(sensors) >= count
    assert [name for name, sensor in sensors if lost(sensor)] == []


def lost(sensor):
    """Whether the foot is said never to stand."""
    foot = FootInertial(Params())
    for piece in sensor.pieces():
        foot.run(piece)
    foot.finish()
    return "no_stance" in [notice.kind for notice in foot.notices]

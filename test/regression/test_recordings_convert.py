"""Real recordings come out of a conversion as they went in."""

import numpy as np
import pytest

from pdr_core.recording import open_recording
from pdr_core.recording.export import write_recording
from pdr_core.records import TruthKind, joined

WALKS = (
    "pyshoe_vicon/2017-11-22-11-22-03.mat",
    "xio_ngimu/short_walk.csv",
    "tile_walks_marg/SensorConnectData_31.csv",
    "xio_ximu_marg/straightLine_CalInertialAndMag.csv",
    "gaitmap_dual_foot/imu_sample.csv",
)


@pytest.mark.parametrize("name", ["out", "out.mcap", "out.csv"])
@pytest.mark.parametrize("walk", WALKS)
def test_samples_and_positions_are_the_same_to_the_last_bit(recordings, tmp_path, walk, name):
    session = open_recording(recordings / walk)
    sensors = list(session.sensors.values())[: 1 if name.endswith(".csv") else None]
    write_recording(session, sensors, tmp_path / name)
    after = open_recording(tmp_path / name)
    assert sorted(after.sensors) == sorted(sensor.name for sensor in sensors)
    for sensor in sensors:
        for before, now in zip(
            joined(list(sensor.pieces())), joined(list(after.sensors[sensor.name].pieces())), strict=True
        ):
            np.testing.assert_array_equal(now, before)
        truth, kept = sensor.truth, after.sensors[sensor.name].truth
        if truth is None:
            assert kept is None
        elif truth.kind is TruthKind.POSITION:
            assert kept.stamp_ns.tolist() == truth.stamp_ns.tolist()
            np.testing.assert_array_equal(kept.position_m, truth.position_m)
        else:
            assert (kept is not None) == name.endswith(".csv")

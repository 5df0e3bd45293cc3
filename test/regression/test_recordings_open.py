"""Every real recording opens, and holds what its authors say it holds."""

import numpy as np
import pytest

from pdr_core.recording import RecordingError, open_recording
from pdr_core.records import TruthKind, joined

TILE_STRIDES = {31: 33, 33: 47, 36: 58, 39: 80, 43: 60}
TILE_SAMPLES = {31: 8549, 33: 11000, 36: 14000, 39: 20000, 43: 15500}


def check(session, name, count, rate_hz):
    """Check length, rate and size of gravity; return the samples."""
    block = joined(list(session.sensors[name].pieces()))
    assert session.notices == []
    assert len(block.stamp_ns) == count
    span_s = (block.stamp_ns[-1] - block.stamp_ns[0]) / 1e9
    assert (count - 1) / span_s == pytest.approx(rate_hz, rel=2e-3)
    assert np.isfinite(block.gyro_radps).all()
    rate = np.linalg.norm(block.gyro_radps, axis=1)
    calm = rate <= np.percentile(rate, 10)
    assert np.median(np.linalg.norm(block.accel_mps2[calm], axis=1)) == pytest.approx(9.8, abs=0.3)
    assert 2.0 < rate.max() < 40.0
    return block


def check_field(block, everywhere=True):
    """Check that samples have a field, or none at all, and that it is about as strong as that of the earth."""
    there = block.field_sd_tesla >= 0.0
    assert there.all() if everywhere else not there.any()
    assert np.isfinite(block.field_tesla).all()
    assert not everywhere or 20e-6 < np.median(np.linalg.norm(block.field_tesla, axis=1)) < 80e-6


def test_vicon_trials(recordings):
    trials = sorted((recordings / "pyshoe_vicon").glob("*.mat"))
    assert len(trials) == 28
    counts = []
    for path in trials:
        session = open_recording(path)
        truth = session.sensors["imu"].truth
        counts.append(len(truth.stamp_ns))
        block = check(session, "imu", counts[-1], 200.0)
        assert (session.format, truth.kind) == ("pyshoe_vicon", TruthKind.POSITION)
        assert (truth.stamp_ns == block.stamp_ns).all()
        assert truth.position_m.shape == (counts[-1], 3)
        lowest_m, middle_m, highest_m = np.percentile(truth.position_m[:, 2], [0, 50, 100])
        assert highest_m - middle_m > 1.5 * (middle_m - lowest_m)  # feet swing upwards
    assert (min(counts), max(counts), sum(counts)) == (3310, 15400, 183562)


@pytest.mark.parametrize("number", sorted(TILE_STRIDES))
def test_tile_walks(recordings, number):
    session = open_recording(recordings / "tile_walks_marg" / f"SensorConnectData_{number}.csv")
    block = check(session, "imu", TILE_SAMPLES[number], 250.0 if number == 43 else 200.0)
    check_field(block, everywhere=number != 43)
    assert block.stamp_ns[0] == 0
    truth = session.sensors["imu"].truth
    assert (truth.kind, truth.position_m.shape) == (TruthKind.STRIDES, (TILE_STRIDES[number] + 1, 2))
    assert 40 < np.hypot(*np.diff(truth.position_m, axis=0).T).sum() < 105
    with pytest.raises(RecordingError, match=f"open the samples beside it, SensorConnectData_{number}.csv"):
        open_recording(recordings / "tile_walks_marg" / f"SensorConnectData_{number}.mat")


def test_ngimu_walk(recordings):
    session = open_recording(recordings / "xio_ngimu" / "short_walk.csv")
    block = check(session, "imu", 16539, 397.4)
    assert session.sensors["imu"].truth.kind is TruthKind.CLOSED_LOOP
    assert (np.diff(block.stamp_ns) == 0).sum() > 200


@pytest.mark.parametrize(("name", "count"), [("straightLine", 9963), ("stairsAndCorridor", 15153)])
def test_x_imu_walks(recordings, name, count):
    session = open_recording(recordings / "xio_ximu_marg" / f"{name}_CalInertialAndMag.csv")
    check_field(check(session, "imu", count, 256.0))
    assert session.sensors["imu"].truth is None


def test_ros1_dump(recordings):
    session = open_recording(recordings / "ros1_foot_imu" / "2020-03-23-17-15-36.csv")
    block = check(session, "imu", 8958, 40.0)
    assert block.stamp_ns[0] == 1584954936793327157


@pytest.mark.parametrize("foot", ["left_sensor", "right_sensor"])
def test_both_feet_and_the_cameras_run_on_one_clock(recordings, foot):
    session = open_recording(recordings / "gaitmap_dual_foot" / "imu_sample.csv")
    block, truth = check(session, foot, 7928, 204.8), session.sensors[foot].truth
    assert (truth.kind, truth.position_m.shape) == (TruthKind.POSITION, (3870, 3))
    assert truth.stamp_ns[0] == block.stamp_ns[0]
    assert abs(truth.stamp_ns[-1] - block.stamp_ns[-1]) < 2e7
    at_s = truth.stamp_ns / 1e9
    speed = np.linalg.norm(np.gradient(truth.position_m, at_s, axis=0), axis=1)
    turning = np.linalg.norm(block.gyro_radps, axis=1)
    lags = np.arange(-0.5, 0.5, 0.01)
    likeness = [np.corrcoef(speed, np.interp(at_s + lag, block.stamp_ns / 1e9, turning))[0, 1] for lag in lags]
    assert max(likeness) > 0.7
    assert abs(lags[np.argmax(likeness)]) < 0.08

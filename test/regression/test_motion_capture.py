"""Both feet against motion capture: strides, their lengths and the pitch of the foot, by every method."""

import numpy as np
import pytest

from pdr_core.bench.mocap_gait import study
from pdr_core.bench.orientations import ORIENTATIONS
from pdr_core.bench.trial import Walk
from pdr_core.evaluation.mocap_gait import gait_errors, markers, true_strides_ns
from pdr_core.params import Params
from pdr_core.pipeline import OrientedIntake
from pdr_core.recording import open_recording
from pdr_core.records import joined

FEET = ("left_sensor", "right_sensor")
STRIDES = 32


@pytest.fixture(scope="module")
def walks(recordings):
    session = open_recording(recordings / "gaitmap_dual_foot" / "imu_sample.csv")
    return {name: Walk(name, list(sensor.pieces()), sensor.truth) for name, sensor in session.sensors.items()}


@pytest.fixture(scope="module")
def studies(walks):
    return {name: study(walk, Params(), list(ORIENTATIONS)) for name, walk in walks.items()}


@pytest.mark.parametrize("foot", FEET)
def test_the_markers_tell_the_strides(walks, foot):
    assert len(true_strides_ns(markers(walks[foot].truth))) == STRIDES


@pytest.mark.parametrize(("method", "mean_percent"), [("error_state", 1.0), ("quaternion_ekf", 1.5)])
@pytest.mark.parametrize("foot", FEET)
def test_our_filters_find_every_stride_and_how_long_it_is(studies, foot, method, mean_percent):
    found = studies[foot].gait[method]
    assert (found.strides_found, found.strides_true, found.strides_false) == (STRIDES, STRIDES, 0)
    assert len(found.length_error_m) >= 27
    assert abs(found.mean_percent) <= mean_percent
    assert found.sd_m <= 0.03
    assert np.degrees(found.pitch_rmse_rad) <= 4.0


@pytest.mark.parametrize("foot", FEET)
def test_the_orientation_that_the_ingestion_gives_needs_no_verdict(walks, foot):
    chain = OrientedIntake(Params())
    pieces = [chain.run(piece)[1] for piece in walks[foot].pieces] + [chain.finish()[1]]
    attitude = joined(pieces)
    found = gait_errors(markers(walks[foot].truth), attitude.stamp_ns, attitude.quat_xyzw, [])
    assert np.degrees(found.pitch_rmse_rad) <= 4.0


@pytest.mark.parametrize("foot", FEET)
def test_the_others_are_measured_on_the_same_strides(studies, foot):
    assert set(studies[foot].left_out) == {"factored_quaternion"}  # these samples have no field
    for method in ("gradient_descent", "complementary"):
        found = studies[foot].gait[method]
        assert found.strides_found == STRIDES
        assert abs(found.mean_percent) < 3.0
        assert found.sd_m < 0.07
        assert studies[foot].gait["error_state"].sd_m < 1.05 * found.sd_m  # given the rest's bias, GDA is as good


def test_without_a_filter_the_strides_of_the_tile_walks_are_counted_and_the_track_is_near(recordings):
    scores = []
    for number in (31, 33, 36, 39):
        session = open_recording(recordings / "tile_walks_marg" / f"SensorConnectData_{number}.csv")
        (sensor,) = session.sensors.values()
        done = study(Walk(str(number), list(sensor.pieces()), sensor.truth), Params(), ["quaternion_ekf"])
        scores.append(done.scores["quaternion_ekf"])
    assert [s.strides for s in scores] == [s.strides_true for s in scores]
    assert np.mean([s.stride_ate2_m for s in scores]) < 0.45


@pytest.mark.parametrize("foot", FEET)
def test_before_the_drift_is_taken_off_the_velocity_runs_away(studies, foot):
    drift = studies[foot].drift
    assert np.linalg.norm(drift.before_mps[-1]) > 1.0
    assert np.linalg.norm(drift.after_mps[-1]) < 0.05

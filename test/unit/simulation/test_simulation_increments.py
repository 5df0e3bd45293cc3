"""The filter's own mechanisation gets back from the means where the foot was."""

import os
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.conventions import gravity_mps2, stamp_ns_from_seconds
from pdr_core.eskf import ZuptFilter
from pdr_core.params import Params, PlaceParams, SimulationParams, changed
from pdr_core.records import StanceBlock, inertial_block, length, part
from pdr_core.simulation.increments import interval_means
from pdr_core.simulation.walk import course, simulated_walk

G = gravity_mps2(np.radians(45.0))
LENGTH_M = {"gui": 500.0, "smooth": 800.0}  # ten minutes
full = pytest.mark.skipif(os.environ.get("PDR_FULL") != "1", reason="long figures: `pdr test --full`")


def walked(motion, stamp_ns):
    """Return the means that a sensor gives of the walk, with verdicts that never say stance, and the true motion."""
    true = course(SimulationParams(motion=motion, walk_length_m=LENGTH_M[motion])).at(stamp_ns * 1e-9)
    gyro, accel = interval_means(stamp_ns, true.position_m, true.velocity_mps, true.quat_xyzw, G)
    none, zeros = np.zeros(len(stamp_ns)), np.zeros((len(stamp_ns), 3))
    imu = inertial_block(stamp_ns, gyro, accel, none, none)
    return StanceBlock(imu, none.astype(bool), none, none + 1.0, none, zeros, none), true


def furthest(motion, stamp_ns, samples="means"):
    """Navigate by inertia alone; return the largest errors of position [m] and attitude [rad]."""
    block, true = walked(motion, stamp_ns)
    params = changed(Params(), "filter", samples=samples, gravity_source="place", alignment_s=0.0).filter
    f, found = ZuptFilter(params, PlaceParams()), []
    for start in range(0, length(block), 20_000):
        piece = slice(start, start + 20_000)
        nav, _ = f.run(part(block, piece.start, piece.stop))
        turned = (Rotation.from_quat(nav.quat_xyzw).inv() * Rotation.from_quat(true.quat_xyzw[piece])).magnitude()
        found.append([np.linalg.norm(nav.position_m - true.position_m[piece], axis=1).max(), turned.max()])
    return np.max(found, axis=0)


def ten_minutes(rate_hz):
    return stamp_ns_from_seconds(np.arange(0.0, 610.0, 1.0 / rate_hz))


@pytest.mark.parametrize("motion", ["gui", "smooth"])
@pytest.mark.parametrize("rate_hz", [50.0, 100.0, 333.0, pytest.param(1000.0, marks=full)])
def test_ten_minutes_of_inertia_alone_return_the_truth(motion, rate_hz):
    position_m, attitude_rad = furthest(motion, ten_minutes(rate_hz))
    print(f"\n{motion} at {rate_hz:.0f} Hz: {position_m * 1e3:.4f} mm, {attitude_rad:.1e} rad", end="")
    assert position_m < 1e-3
    assert attitude_rad < 1e-6


def test_the_walks_last_ten_minutes():
    for motion, length_m in LENGTH_M.items():
        assert course(SimulationParams(motion=motion, walk_length_m=length_m)).duration_s > 600.0


def test_stamps_that_jitter_change_nothing():
    stamp_ns = ten_minutes(100.0)
    stamp_ns[1:] += np.random.default_rng(0).integers(-4_000_000, 4_000_000, len(stamp_ns) - 1)
    position_m, attitude_rad = furthest("gui", stamp_ns)
    assert position_m < 1e-3
    assert attitude_rad < 1e-6


def test_means_taken_for_points_do_not_return():
    position_m, attitude_rad = furthest("gui", ten_minutes(100.0), samples="points")
    assert position_m > 1.0
    assert attitude_rad > 1e-3


def test_a_simulated_sensor_gives_means_if_it_is_told_to():
    asked = SimulationParams(walk="straight", walk_length_m=2.4, sensor_model="ideal", output="means")
    walk, points = simulated_walk(asked), simulated_walk(replace(asked, output="points"))
    m, g = walk.motion, gravity_mps2(np.radians(45.0))
    gyro, accel = interval_means(walk.imu.stamp_ns, m.position_m, m.velocity_mps, m.quat_xyzw, g)
    np.testing.assert_allclose(walk.imu.gyro_radps, gyro, atol=1e-15)
    np.testing.assert_allclose(walk.imu.accel_mps2, accel, atol=1e-13)
    assert np.abs(points.imu.gyro_radps - gyro).max() > 0.01

"""The filter's own mechanisation gets back from the means where the foot was."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.conventions import gravity_mps2, stamp_ns_from_seconds
from pdr_core.eskf import ZuptFilter
from pdr_core.params import Params, PlaceParams, changed
from pdr_core.records import ImuBlock, StanceBlock, length, part
from pdr_core.simulation.foot_motion import Phase, move, steps, turn
from pdr_core.simulation.imu_model import orientation
from pdr_core.simulation.increments import interval_means

G = gravity_mps2(np.radians(45.0))
TEN_MINUTES = [Phase(3.0), *((steps(12) + turn(np.pi / 2)) * 4 + steps(9) + turn(-2.0)) * 7, Phase(3.0)]


def walked(stamp_ns):
    """Return the means that a sensor gives of the walk, with verdicts that never say stance, and the true pose."""
    motion = move(TEN_MINUTES, stamp_ns * 1e-9)
    quat = orientation(motion).as_quat()
    gyro, accel = interval_means(stamp_ns, motion.position_m, motion.velocity_mps, quat, G)
    none, zeros = np.zeros(len(stamp_ns)), np.zeros((len(stamp_ns), 3))
    imu = ImuBlock(stamp_ns, gyro, accel, none, none)
    return StanceBlock(imu, none.astype(bool), none, none + 1.0, zeros, none), motion.position_m, quat


def furthest(stamp_ns, samples="means"):
    """Navigate by inertia alone; return the largest errors of position [m] and attitude [rad]."""
    block, position_m, quat = walked(stamp_ns)
    params = changed(Params(), "filter", samples=samples, gravity_source="place", alignment_s=0.0).filter
    f, found = ZuptFilter(params, PlaceParams()), []
    for start in range(0, length(block), 20_000):
        piece = slice(start, start + 20_000)
        nav, _ = f.run(part(block, start, start + 20_000))
        turned = (Rotation.from_quat(nav.quat_xyzw).inv() * Rotation.from_quat(quat[piece])).magnitude()
        found.append([np.linalg.norm(nav.position_m - position_m[piece], axis=1).max(), turned.max()])
    return np.max(found, axis=0)


def regular(rate_hz):
    return stamp_ns_from_seconds(np.arange(0.0, sum(p.duration_s for p in TEN_MINUTES), 1.0 / rate_hz))


@pytest.mark.parametrize("rate_hz", [50.0, 100.0, 333.0, 1000.0])
def test_ten_minutes_of_inertia_alone_return_the_truth(rate_hz):
    stamp_ns = regular(rate_hz)
    assert stamp_ns[-1] > 600e9
    position_m, attitude_rad = furthest(stamp_ns)
    print(f"{rate_hz:.0f} Hz: {position_m * 1e3:.4f} mm, {attitude_rad:.1e} rad")
    assert position_m < 1e-3
    assert attitude_rad < 1e-6


def test_stamps_that_jitter_change_nothing():
    stamp_ns = regular(100.0)
    stamp_ns[1:] += np.random.default_rng(0).integers(-4_000_000, 4_000_000, len(stamp_ns) - 1)
    position_m, attitude_rad = furthest(stamp_ns)
    assert position_m < 1e-3
    assert attitude_rad < 1e-6


def test_means_taken_for_points_do_not_return():
    position_m, attitude_rad = furthest(regular(100.0), samples="points")
    assert position_m > 1.0
    assert attitude_rad > 1e-3

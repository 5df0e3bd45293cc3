"""Who moves without steps goes nowhere, and walks on from there."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pdr_core.params import SimulationParams
from pdr_core.records import joined, length, part
from pdr_core.simulation import simulated_walk
from support.chest import RATE_HZ, end_error_m, estimated, walk

BEGIN, REST = 2 * RATE_HZ, 2 * RATE_HZ  # of the rest of 5 s before the walk
BUSY_S = 60


def busy(imu):
    """Insert a minute of bending over and up again to a walk, by a sensor that goes on as it rested, a bit warmer."""
    again = joined([part(imu, BEGIN, BEGIN + REST)] * (BUSY_S * RATE_HZ // REST))
    time_s = np.arange(length(again)) / RATE_HZ
    swing = 0.15 * np.sin(np.pi * time_s) ** 2
    turn = Rotation.from_rotvec(swing[:, None] * [0.0, 1.0, 0.0])
    rate = 0.15 * np.pi * np.sin(2.0 * np.pi * time_s)
    bent = again._replace(
        stamp_ns=imu.stamp_ns[BEGIN + REST] + (time_s * 1e9).astype(np.int64),
        accel_mps2=turn.inv().apply(again.accel_mps2),
        gyro_radps=turn.inv().apply(again.gyro_radps) + rate[:, None] * [0.0, 1.0, 0.0] + np.radians(0.05),
    )
    late = part(imu, BEGIN + REST)
    late = late._replace(stamp_ns=late.stamp_ns + BUSY_S * 1_000_000_000, gyro_radps=late.gyro_radps + np.radians(0.05))
    return joined([part(imu, 0, BEGIN + REST), bent, late])


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_who_is_busy_on_the_spot_stays_there(seed):
    true = walk(seed, 44.0)
    nav, _, card = estimated(busy(true.imu))
    there = nav.stamp_ns < (4 + BUSY_S) * 1_000_000_000
    assert np.linalg.norm(nav.position_m[there], axis=1).max() < 2.0
    assert "no_steps" in [n.kind for n in card.notices]
    assert end_error_m(nav, true) < 0.06 * 44.0


@pytest.mark.parametrize("seed", [1, 2])
def test_who_walks_too_gently_for_steps_gets_no_track_that_runs_away(seed):
    """At 0.3 m/s: it ended 1.5 km off, and said nothing."""
    settings = SimulationParams(
        motion="chest", walk="rectangle", walk_length_m=44.0, sensor_model="icm_20602", chest_speed_mps=0.3, seed=seed
    )
    true = simulated_walk(settings)
    nav, _, card = estimated(true.imu)
    off_m = (nav.position_m - true.motion.position_m[: length(nav)])[:, :2]
    assert np.abs(off_m).max() < 44.0
    assert np.mean(np.abs(off_m) < 3.0 * np.sqrt(nav.pose_covariance[:, :1, 0])) > 0.95
    assert "no_steps" in [n.kind for n in card.notices]

"""Simulated walks as blocks, as messages and as files."""

from pathlib import Path

import numpy as np

from pdr_core.intake import Ingestion
from pdr_core.maths import quaternion
from pdr_core.params import Params, SimulationParams
from pdr_core.records import ImuBlock, Stamps, StanceBlock, inertial_block, joined, length
from pdr_core.simulation import SimulatedWalk, simulated_walk
from pdr_core.stance import StanceDetection
from pdr_nodes.convert import field_message, imu_message, stance_message

BEGIN_NS = 1_700_000_000_000_000_000
EARTH_FIELD_TESLA = np.array([0.0, 2.1e-5, -4.3e-5])  # east, north, up: in the middle of Europe
COLUMNS = "t,wx,wy,wz,ax,ay,az"
COLUMN_MAP = """name: test
time: {column: t, unit: ns}
sensors:
  imu:
    gyro: {columns: [wx, wy, wz], unit: rad/s}
    accel: {columns: [ax, ay, az], unit: m/s^2}
"""


def straight_walk(strides: int, rate_hz: float = 100.0) -> SimulatedWalk:
    """Return a walk along x that stands for three seconds at both ends."""
    params = SimulationParams(walk="straight", walk_length_m=1.2 * strides, sample_rate_hz=rate_hz)
    return simulated_walk(params, start_ns=BEGIN_NS)


def magnetic_walk(strides: int, rate_hz: float = 100.0) -> ImuBlock:
    """Return a walk whose sensor has a magnetometer, with noise, that leaves out every seventh sample."""
    walk = straight_walk(strides, rate_hz)
    n = length(walk.imu)
    R_world_from_foot = np.array([quaternion.matrix(xyzw) for xyzw in walk.motion.quat_xyzw])
    field = EARTH_FIELD_TESLA @ R_world_from_foot + 3e-7 * np.random.default_rng(1).standard_normal((n, 3))
    there = np.arange(n) % 7 != 3
    return walk.imu._replace(
        field_tesla=np.where(there[:, None], field, 0.0), field_sd_tesla=np.where(there, 3e-7, -1.0)
    )


def walk_with_dips(strides: int) -> tuple[ImuBlock, Stamps]:
    """Return a walk at 200 Hz in whose swings the foot is still for 50 ms, and the rows of these samples."""
    walk = straight_walk(strides, 200.0)
    toe_offs = np.flatnonzero(np.diff(walk.motion.stance.astype(int)) == -1)
    dips = np.concatenate([np.arange(at + 40, at + 50) for at in toe_offs])
    walk.imu.gyro_radps[dips], walk.imu.accel_mps2[dips] = 0.0, [0.0, 0.0, 9.81]
    return walk.imu, dips


def still(seconds: float, begin_ns: int, rate_hz: float = 100.0) -> ImuBlock:
    """Return a resting sensor without noise."""
    n = round(seconds * rate_hz)
    stamp_ns = begin_ns + np.arange(n, dtype=np.int64) * round(1e9 / rate_hz)
    return inertial_block(stamp_ns, np.zeros((n, 3)), np.tile([0.0, 0.0, 9.81], (n, 1)), np.zeros(n), np.zeros(n))


def judged(raw: ImuBlock) -> StanceBlock:
    """Return the samples as they reach the filter."""
    params = Params()
    stance = StanceDetection(params.stance, params.place)
    return joined([stance.run(Ingestion(params.intake).run(raw)), stance.finish()])


def imu_messages(block: ImuBlock) -> list:
    """Return the samples as a driver sends them."""
    return [imu_message(block, i, "imu_link") for i in range(length(block))]


def field_messages(block: ImuBlock) -> list:
    """Return the magnetic fields of the samples as a driver sends them: none where a sample has none."""
    return [field_message(block, i, "imu_link") for i in np.flatnonzero(block.field_sd_tesla >= 0.0)]


def stance_messages(block: StanceBlock) -> list:
    """Return the samples with their verdicts as the stance detector sends them."""
    return [stance_message(block, i, "foot") for i in range(length(block))]


def stamps(messages: list) -> list[int]:
    """Return the header stamps [ns] of messages, StanceImu included."""
    headers = [m.header if hasattr(m, "header") else m.imu.header for m in messages]
    return [h.stamp.sec * 10**9 + h.stamp.nanosec for h in headers]


def write_csv(path: Path, block: ImuBlock) -> Path:
    """Write a text recording with its column map beside it, exact to the last bit."""
    path.with_suffix(".yaml").write_text(COLUMN_MAP)
    rows = [COLUMNS]
    for stamp_ns, gyro, accel in zip(block.stamp_ns, block.gyro_radps, block.accel_mps2, strict=True):
        rows.append(",".join([str(stamp_ns), *map(repr, [*gyro.tolist(), *accel.tolist()])]))
    path.write_text("\n".join(rows) + "\n")
    return path

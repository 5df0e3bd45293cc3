"""What the filter-free method takes from and gives to the other stages: accelerations in, estimates and step ends out.

The covariance of the position is that of a sum of displacements d, each with a noise of its own and turned by the yaw
error y at its time, which walks at random: p <- p + d, its error by y (z x d) more. The filter's record of the last
stance ends holds what the displacement between two of them shares with both, so steps are read off it as they are
there.
"""

import numpy as np

from pdr_core.conventions import UNKNOWN_RATE_SD_RADPS
from pdr_core.eskf.error_state import ATTITUDE, POSITION, SIZE
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.eskf.step_events import roam, stance_is_over, stand
from pdr_core.eskf.zupt import rolling_velocity
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import rows
from pdr_core.maths.vector import difference, rotated, row, transposed
from pdr_core.records import AttitudeBlock, Flags, Floats, NavBlock, StanceBlock
from pdr_core.strapdown.dedrift import Accelerations, Track

YAW = ATTITUDE + 2
UNKNOWN_SPEED_SD_MPS = 2.0  # of a foot in a swing whose start nobody has seen


@compiled
def accelerations(
    judged: StanceBlock,
    attitude: AttitudeBlock,
    whole: Flags,
    gravity_mps2: float,
    stance_sd_mps: float,
    steady: bool,
    s: Settings,
) -> Accelerations:
    """Return what the samples say in the world frame: the first line of Qiu eq. 23, with the gravity of the second."""
    n = judged.stance.shape[0]
    accel, still, still_sd, drift, stance = np.empty((n, 3)), np.empty((n, 3)), np.empty(n), np.empty(n), whole.copy()
    for i in range(n):
        force = rotated(rows(attitude.quat_xyzw[i]), row(judged.imu.accel_mps2, i))
        accel[i] = difference(force, (0.0, 0.0, gravity_mps2))
        rate = difference(row(judged.imu.gyro_radps, i), row(attitude.gyro_bias_radps, i))
        still[i] = rolling_velocity(attitude.quat_xyzw[i], rate, s.contact_height_m)
        said_mps = judged.zero_velocity_sd_mps[i]
        still_sd[i] = said_mps if said_mps > 0.0 else s.zero_velocity_sd_mps
        stance[i] = judged.stance[i] and said_mps <= stance_sd_mps
        drift[i] = 1.0 if steady else judged.imu.accel_sd_mps2[i] ** 2
    return Accelerations(judged.imu.stamp_ns, accel, drift, still, still_sd, stance, whole)


@compiled
def pace(
    judged: StanceBlock,
    attitude: AttitudeBlock,
    whole: Flags,
    track: Track,
    start: int,
    s: Settings,
    state: FilterState,
    out: NavBlock,
) -> tuple[int, bool]:
    """Write estimates from `start` on, until the stamp of one shows that a stance is over.

    Returns the index of the next sample to take, and whether a stance is over.
    """
    for i in range(start, judged.stance.shape[0]):
        stamp_ns = judged.imu.stamp_ns[i]
        if stance_is_over(stamp_ns, s.merge_ns, state):
            return i, True
        forget(attitude.attitude_covariance[i], state)
        swinging = i > 0 and not track.stands[i - 1]
        before_m2 = track.moved_sd_m[i - 1] ** 2 if swinging else 0.0
        carry(track.position_m[i], max(0.0, track.moved_sd_m[i] ** 2 - before_m2), state)
        if state.samples > 0 and (not whole[i] or np.isinf(track.velocity_sd_mps[i])):
            drift_off((stamp_ns - state.last_ns) * 1e-9, s.process.gap_speed_mps, state)
        state.quat_xyzw[:] = attitude.quat_xyzw[i]
        state.last_ns = stamp_ns
        state.samples += 1
        roam(state)
        if track.stands[i]:
            stand(stamp_ns, state)
        write(judged, attitude, track, i, state, out)
    return judged.stance.shape[0], False


@compiled
def forget(attitude_covariance: Floats, state: FilterState) -> None:
    """Take the covariance of the attitude as it is told; a yaw that was corrected shares less with the track behind."""
    before, now = state.P[YAW, YAW], attitude_covariance[2, 2]
    kept = now / before if now < before else 1.0
    for axis in range(3):
        state.P[POSITION + axis, YAW] *= kept
        state.P[YAW, POSITION + axis] *= kept
    for j in range(6):
        state.cross[YAW, j] *= kept
    for i in range(3):
        for j in range(3):
            state.P[ATTITUDE + i, ATTITUDE + j] = attitude_covariance[i, j]


@compiled
def carry(position_m: Floats, grown_m2: float, state: FilterState) -> None:
    """Move the position, with the noise that its displacement has for itself and what the yaw error makes of it."""
    across = (state.position_m[1] - position_m[1], position_m[0] - state.position_m[0])
    for axis in range(2):
        for j in range(SIZE):
            state.P[POSITION + axis, j] += across[axis] * state.P[YAW, j]
        for j in range(6):
            state.cross[POSITION + axis, j] += across[axis] * state.cross[YAW, j]
    for axis in range(2):
        for j in range(SIZE):
            state.P[j, POSITION + axis] += across[axis] * state.P[j, YAW]
    for axis in range(3):
        state.P[POSITION + axis, POSITION + axis] += grown_m2
    state.position_m[:] = position_m


@compiled
def drift_off(dt_s: float, speed_mps: float, state: FilterState) -> None:
    """Let a person walk anywhere while nobody looks: at random below a second, steadily beyond."""
    for axis in range(3):
        state.P[POSITION + axis, POSITION + axis] += speed_mps**2 * max(dt_s, 0.0) * max(dt_s, 1.0)


@compiled
def write(
    judged: StanceBlock, attitude: AttitudeBlock, track: Track, i: int, state: FilterState, out: NavBlock
) -> None:
    """Write sample i of the output; the rate is as good as the gyro's noise, its bias is taken as known."""
    out.stamp_ns[i] = judged.imu.stamp_ns[i]
    out.position_m[i] = track.position_m[i]
    out.quat_xyzw[i] = attitude.quat_xyzw[i]
    out.velocity_mps[i] = rotated(transposed(rows(attitude.quat_xyzw[i])), track.velocity_mps[i])
    out.rate_radps[i] = judged.imu.gyro_radps[i] - attitude.gyro_bias_radps[i]
    out.twist_covariance[i] = 0.0
    gyro_sd = judged.imu.gyro_sd_radps[i]
    for j in range(3):
        out.twist_covariance[i, j, j] = min(track.velocity_sd_mps[i], UNKNOWN_SPEED_SD_MPS) ** 2
        out.twist_covariance[i, 3 + j, 3 + j] = (gyro_sd if gyro_sd >= 0.0 else UNKNOWN_RATE_SD_RADPS) ** 2
        for k in range(3):
            out.pose_covariance[i, j, k] = state.P[POSITION + j, POSITION + k]
            out.pose_covariance[i, j, 3 + k] = state.P[POSITION + j, ATTITUDE + k]
            out.pose_covariance[i, 3 + j, k] = state.P[ATTITUDE + j, POSITION + k]
            out.pose_covariance[i, 3 + j, 3 + k] = state.P[ATTITUDE + j, ATTITUDE + k]

"""The orientation filter's loop: align, turn, correct, one sample after the other. The only text of it."""

from typing import NamedTuple

import numpy as np

from pdr_core.attitude import gravity
from pdr_core.attitude.process import turn
from pdr_core.attitude.settings import Settings
from pdr_core.attitude.sphere import rotation_covariance, spread
from pdr_core.attitude.state import GYRO_BIAS, AttitudeState
from pdr_core.attitude.updates import level, point, rest
from pdr_core.conventions import GAP_NS
from pdr_core.maths.compiled import compiled
from pdr_core.maths.levelling import levelled
from pdr_core.maths.quaternion import rows
from pdr_core.maths.vector import Triple, difference, norm, rotated, row
from pdr_core.records import AttitudeBlock, ImuBlock, StanceBlock
from pdr_core.strapdown.samples import between

UNKNOWN_GAP_S = 1.0  # where the clock has jumped back, nobody knows how much time has passed
MOVING = -1.0  # in place of how far the force may be off gravity
NO_FORCE = (0.0, 0.0, 0.0)


class Sample(NamedTuple):
    """One sample."""

    stamp_ns: int
    rate_radps: Triple
    force_mps2: Triple
    gyro_sd_radps: float
    field_tesla: Triple
    field_sd_tesla: float


@compiled
def sample(imu: ImuBlock, i: int) -> Sample:
    """Return sample i of the block."""
    return Sample(
        imu.stamp_ns[i],
        row(imu.gyro_radps, i),
        row(imu.accel_mps2, i),
        imu.gyro_sd_radps[i],
        row(imu.field_tesla, i),
        imu.field_sd_tesla[i],
    )


@compiled
def orient(block: StanceBlock, s: Settings, state: AttitudeState, out: AttitudeBlock) -> None:
    """Take judged samples: a foot that stands shows where up is."""
    for i in range(block.imu.stamp_ns.shape[0]):
        now = sample(block.imu, i)
        dt_s = predict(now, s, state)
        if block.rest_sd_radps[i] > 0.0 and not state.aligning:
            rest(row(block.rest_rate_radps, i), block.rest_sd_radps[i], state)
        sd_mps2 = MOVING
        if block.stance[i] and block.zero_velocity_sd_mps[i] > 0.0:
            sd_mps2 = gravity.standing_sd_mps2(block.zero_velocity_sd_mps[i], s)
        elif block.stance[i]:
            sd_mps2 = np.hypot(s.accel_sd_mps2, gravity.motion_mps2(now.force_mps2, now.rate_radps, s))
        update(now, sd_mps2, dt_s, s, state)
        write(out, i, s, state)


@compiled
def orient_unjudged(imu: ImuBlock, s: Settings, state: AttitudeState, out: AttitudeBlock) -> None:
    """Take samples that nobody has judged: each counts the less, the more the foot moves or has just moved."""
    for i in range(imu.stamp_ns.shape[0]):
        now = sample(imu, i)
        dt_s = predict(now, s, state)
        kept = np.exp(-dt_s / s.motion_memory_s) if s.motion_memory_s > 0.0 else 0.0
        motion_mps2 = gravity.motion_mps2(now.force_mps2, now.rate_radps, s)
        state.motion_mps2 = max(motion_mps2, kept * state.motion_mps2)
        update(now, np.hypot(s.accel_sd_mps2, state.motion_mps2), dt_s, s, state)
        write(out, i, s, state)


@compiled
def predict(now: Sample, s: Settings, state: AttitudeState) -> float:
    """Move the estimate to the time of a sample; return the interval [s]."""
    if state.aligning:
        return 0.0
    dt_ns = now.stamp_ns - state.last_ns
    dt_s = dt_ns * 1e-9
    if dt_ns <= 0 or dt_ns > GAP_NS or now.gyro_sd_radps < 0.0 or state.last_gyro_sd_radps < 0.0:
        coast(dt_s if dt_ns > 0 else UNKNOWN_GAP_S, s, state)
        return min(dt_s, GAP_NS * 1e-9) if dt_ns > 0 else GAP_NS * 1e-9
    state.coasting = False
    last = difference(state.last_rate_radps, state.gyro_bias_radps)
    rate, _, _ = between(s.samples, last, difference(now.rate_radps, state.gyro_bias_radps), NO_FORCE, NO_FORCE, dt_s)
    turn(rate, now.gyro_sd_radps, dt_s, s, state)
    return dt_s


@compiled
def coast(dt_s: float, s: Settings, state: AttitudeState) -> None:
    """Hold the attitude across an interval in which nobody knows how the foot has turned, and trust it less."""
    turn_rad2 = min(s.gap_rate_radps**2 * dt_s * max(dt_s, 1.0), np.pi**2)  # more than unknown it cannot be
    spread(np.full(3, turn_rad2), state)
    state.gaps += not state.coasting
    state.coasting = True


@compiled
def update(now: Sample, gravity_sd_mps2: float, dt_s: float, s: Settings, state: AttitudeState) -> None:
    """Correct the estimate by what a sample tells beside its interval, and remember it."""
    if state.aligning:
        align(now, s, state)
    elif gravity_sd_mps2 > 0.0:
        level(now.force_mps2, gravity_sd_mps2, dt_s, s, state)
        if s.use_field and now.field_sd_tesla >= 0.0:
            point(now.field_tesla, gravity_sd_mps2, dt_s, s, state)
    state.last_ns = now.stamp_ns
    state.last_rate_radps[:] = now.rate_radps
    state.last_gyro_sd_radps = now.gyro_sd_radps


@compiled
def align(now: Sample, s: Settings, state: AttitudeState) -> None:
    """Take one sample into the mean force, level the foot by it, and see where the field points."""
    if state.force_samples == 0 or now.stamp_ns < state.alignment_start_ns:
        state.alignment_start_ns = now.stamp_ns
    state.force_sum_mps2[:] += np.array(now.force_mps2)
    state.force_samples += 1
    state.quat_xyzw[:] = levelled(state.force_sum_mps2 / state.force_samples, s.initial_yaw_rad)
    if now.field_sd_tesla >= 0.0:
        state.field_sum_tesla[:] += np.array(now.field_tesla)
        state.field_samples += 1
        state.field_tesla[:] = rotated(rows(state.quat_xyzw), state.field_sum_tesla / state.field_samples)
    state.P[:] = 0.0
    for i in range(3):
        state.P[GYRO_BIAS + i, GYRO_BIAS + i] = s.initial_gyro_bias_sd_radps**2
    spread(np.array([s.initial_tilt_sd_rad**2, s.initial_tilt_sd_rad**2, s.initial_yaw_sd_rad**2]), state)
    state.aligning = now.stamp_ns - state.alignment_start_ns < s.alignment_ns


@compiled
def write(out: AttitudeBlock, i: int, s: Settings, state: AttitudeState) -> None:
    """Write the estimate as sample i of the output; a bias of the accelerometer tilts it, and no filter sees that."""
    out.stamp_ns[i] = state.last_ns
    out.quat_xyzw[i] = state.quat_xyzw
    out.gyro_bias_radps[i] = state.gyro_bias_radps
    out.attitude_covariance[i] = rotation_covariance(state)
    for j in range(2):
        out.attitude_covariance[i, j, j] += s.accel_bias_tilt_rad**2

"""The filter's loop: align, propagate, update, one sample after the other. The only text of it, live and offline."""

from pdr_core.conventions import GAP_NS
from pdr_core.eskf.align import align
from pdr_core.eskf.gravity import tilt_is_lost
from pdr_core.eskf.output import write
from pdr_core.eskf.process import carry, cross_gap, link, noise, propagate_covariance
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.eskf.step_events import roam, stance_is_over, stand
from pdr_core.eskf.updates import level, zero_rate, zero_velocity
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import difference, mean
from pdr_core.records import NavBlock, StanceBlock
from pdr_core.strapdown.mechanisation import advance

UNKNOWN_GAP_S = 1.0  # where the clock has jumped back, nobody knows how much time has passed


@compiled
def sample_step(block: StanceBlock, i: int, s: Settings, state: FilterState) -> None:
    """Take sample i of the block into the estimate."""
    stamp_ns = block.imu.stamp_ns[i]
    if state.aligning:
        align(stamp_ns, block.imu.accel_mps2[i], block.imu.gyro_radps[i], s, state)
    else:
        propagate(block, i, s, state)
        if block.rest_sd_radps[i] > 0.0:
            zero_rate(block.rest_rate_radps[i], block.rest_sd_radps[i], state)
        roam(state)
        if block.stance[i]:
            stand_still(block, i, s, state)
        since_s = (stamp_ns - state.last_accepted_ns) * 1e-9
        state.longest_swing_s = max(since_s, state.longest_swing_s)
    state.last_ns = stamp_ns
    state.last_force_mps2[:] = block.imu.accel_mps2[i]
    state.last_rate_radps[:] = block.imu.gyro_radps[i]
    state.last_gyro_sd_radps = block.imu.gyro_sd_radps[i]
    state.samples += 1


@compiled
def stand_still(block: StanceBlock, i: int, s: Settings, state: FilterState) -> None:
    """Take the verdict that the foot stands into the estimate."""
    stamp_ns, sd_mps = block.imu.stamp_ns[i], block.zero_velocity_sd_mps[i]
    sd_mps = sd_mps if sd_mps > 0.0 else s.zero_velocity_sd_mps
    if tilt_is_lost(state.P):
        level(block.imu.accel_mps2[i], sd_mps, state)
    state.adrift = False
    if zero_velocity(stamp_ns, block.imu.gyro_radps[i], sd_mps, s, state):
        stand(stamp_ns, state)


@compiled
def propagate(block: StanceBlock, i: int, s: Settings, state: FilterState) -> None:
    """Move estimate and covariance from the last sample to sample i."""
    dt_ns = block.imu.stamp_ns[i] - state.last_ns
    dt_s = dt_ns * 1e-9
    if dt_ns <= 0 or dt_ns > GAP_NS or gyro_off(block.imu.gyro_sd_radps[i], state):
        if dt_ns < 0:
            turn_back(dt_ns, state)
        coast(dt_s if dt_ns > 0 else UNKNOWN_GAP_S, s, state)
        return
    state.coasting = False
    force_before = difference(state.last_force_mps2, state.accel_bias_mps2)
    force_after = difference(block.imu.accel_mps2[i], state.accel_bias_mps2)
    rate = difference(mean(state.last_rate_radps, block.imu.gyro_radps[i]), state.gyro_bias_radps)
    held = state.position_m[0], state.position_m[1], state.position_m[2]
    R_before, R_after = advance(
        state.position_m, state.velocity_mps, state.quat_xyzw, rate, force_before, force_after, dt_s, state.gravity_mps2
    )
    k = link(R_before, R_after, force_before, force_after, dt_s, s.process.bias_correlation_s)
    q = noise(block.imu.accel_sd_mps2[i], block.imu.gyro_sd_radps[i], dt_s, s.process)
    propagate_covariance(state.P, k, q)
    carry(k, state.cross)
    state.accel_bias_mps2[:] *= k.bias_decay
    state.gyro_bias_radps[:] *= k.bias_decay
    if state.adrift:
        state.velocity_mps[:] = 0.0
        state.position_m[:] = held


@compiled
def gyro_off(gyro_sd_radps: float, state: FilterState) -> bool:
    """Return whether the rate was not measured at one of the ends of the interval."""
    return gyro_sd_radps < 0.0 or state.last_gyro_sd_radps < 0.0


@compiled
def turn_back(dt_ns: int, state: FilterState) -> None:
    """Follow a clock that has jumped back: stamps of the time before would lie in the future."""
    state.last_accepted_ns += dt_ns
    state.contradicted_s = 0.0


@compiled
def coast(dt_s: float, s: Settings, state: FilterState) -> None:
    """Cross a gap: forget the velocity, trust everything less, and hold the position until the foot stands again."""
    state.adrift = True
    state.velocity_mps[:] = 0.0
    cross_gap(state.P, state.cross, dt_s, s.process)
    state.gaps += not state.coasting
    state.coasting = True


@compiled
def navigate(block: StanceBlock, start: int, s: Settings, state: FilterState, out: NavBlock) -> tuple[int, bool]:
    """Take samples from `start` on, until the stamp of one shows that a stance is over, or there are no more.

    Returns the index of the next sample to take, and whether a stance is over.
    """
    for i in range(start, block.imu.stamp_ns.shape[0]):
        if stance_is_over(block.imu.stamp_ns[i], s.merge_ns, state):
            return i, True
        sample_step(block, i, s, state)
        write(out, i, state)
    return block.imu.stamp_ns.shape[0], False

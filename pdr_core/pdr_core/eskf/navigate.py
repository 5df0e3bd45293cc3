"""The filter's loop: align, propagate, update, one sample after the other. The only text of it, live and offline."""

from typing import NamedTuple

from pdr_core.conventions import GAP_NS
from pdr_core.eskf import eleven_states, field_heading, field_places, floor, initial_yaw, quiet_field, rare_bias
from pdr_core.eskf.align import align
from pdr_core.eskf.field_updates import stand_in_field
from pdr_core.eskf.gravity import tilt_is_lost
from pdr_core.eskf.output import write
from pdr_core.eskf.process import NO_TIME, Link, carry, cross_gap, forget_velocity, link, noise, propagate_covariance
from pdr_core.eskf.settings import Settings
from pdr_core.eskf.state import FilterState
from pdr_core.eskf.step_events import roam, stance_is_over, stand
from pdr_core.eskf.updates import (
    level,
    stand_on_floor,
    zero_rate,
    zero_velocity,
)
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Triple, difference, row
from pdr_core.records import NavBlock, StanceBlock
from pdr_core.strapdown.mechanisation import advance
from pdr_core.strapdown.samples import between

UNKNOWN_GAP_S = 1.0  # where the clock has jumped back, nobody knows how much time has passed


class Sample(NamedTuple):
    """One sample of a block: numbers, which cost compiled code less to hand on than ten arrays."""

    stamp_ns: int
    force_mps2: Triple
    rate_radps: Triple
    accel_sd_mps2: float
    gyro_sd_radps: float
    stance: bool
    zero_velocity_sd_mps: float
    rest_rate_radps: Triple
    rest_sd_radps: float
    field_tesla: Triple
    field_sd_tesla: float


@compiled
def sample(block: StanceBlock, i: int) -> Sample:
    """Return sample i of the block."""
    imu = block.imu
    return Sample(
        imu.stamp_ns[i],
        row(imu.accel_mps2, i),
        row(imu.gyro_radps, i),
        imu.accel_sd_mps2[i],
        imu.gyro_sd_radps[i],
        block.stance[i],
        block.zero_velocity_sd_mps[i],
        row(block.rest_rate_radps, i),
        block.rest_sd_radps[i],
        row(imu.field_tesla, i),
        imu.field_sd_tesla[i],
    )


@compiled
def sample_step(now: Sample, s: Settings, state: FilterState) -> None:
    """Take a sample into the estimate."""
    predict(now, s, state)
    update(now, s, state)


@compiled
def predict(now: Sample, s: Settings, state: FilterState) -> Link:
    """Move the estimate to the time of a sample; return the interval as the errors see it, or `NO_TIME`."""
    for i in range(3):
        state.held_m[i] = state.position_m[i]
    if state.aligning:
        return NO_TIME
    return propagate(now, s, state)


@compiled
def update(now: Sample, s: Settings, state: FilterState) -> None:
    """Correct the estimate by what a sample tells beside its interval."""
    if state.aligning:
        align(now.stamp_ns, now.force_mps2, now.rate_radps, s, state)
        if s.compass_start:
            initial_yaw.watch(now.field_tesla, now.field_sd_tesla, state)
            if not state.aligning:
                initial_yaw.decide(s, state)
    else:
        if state.adrift:
            hold(state)
        if now.rest_sd_radps > 0.0:
            rest(now, s, state)
        if s.field.use > field_places.NONE and (state.field_open or now.field_sd_tesla >= 0.0):
            watch_field(now, s, state)
        roam(state)
        if now.stance:
            stand_still(now, s, state)
        since_s = (now.stamp_ns - state.last_accepted_ns) * 1e-9
        state.longest_swing_s = max(since_s, state.longest_swing_s)
    state.last_ns = now.stamp_ns
    state.last_force_mps2[:] = now.force_mps2
    state.last_rate_radps[:] = now.rate_radps
    state.last_gyro_sd_radps = now.gyro_sd_radps
    state.samples += 1


@compiled
def rest(now: Sample, s: Settings, state: FilterState) -> None:
    """Take the mean rate of a rest, which shows the gyro bias, into the estimate."""
    if s.heading_states:
        rare_bias.weigh(now.rest_rate_radps, now.rest_sd_radps, s.initial_sd, state)
        zero_rate(now.rest_rate_radps, now.rest_sd_radps, state)
    else:
        eleven_states.take_rest(now.rest_rate_radps, now.rest_sd_radps, s.gyro_bias_sd_radps, state)


@compiled
def stand_still(now: Sample, s: Settings, state: FilterState) -> None:
    """Take the verdict that the foot stands into the estimate."""
    sd_mps = now.zero_velocity_sd_mps if now.zero_velocity_sd_mps > 0.0 else s.zero_velocity_sd_mps
    if tilt_is_lost(state.P):
        level(now.force_mps2, sd_mps, state)
    state.adrift = False
    if zero_velocity(now.stamp_ns, now.rate_radps, sd_mps, s, state):
        stand_on_floor(sd_mps, s, state)
        stand(now.stamp_ns, state)


@compiled
def watch_field(now: Sample, s: Settings, state: FilterState) -> None:
    """Gather the field while the foot stands quietly, and take what it has told into the estimate thereafter."""
    rate = difference(now.rate_radps, state.gyro_bias_radps)
    measured = not gyro_off(now.gyro_sd_radps, state)
    goes_on = (
        measured
        and quiet_field.quiet(now.stance, now.zero_velocity_sd_mps, rate)
        and quiet_field.continuous(now.stamp_ns, state)
    )
    if state.field_open and (not goes_on or quiet_field.full(now.stamp_ns, state)):
        state.field_open = False
        if quiet_field.told(state):
            stand_in_field(quiet_field.shown(state), s.field, state)
    if goes_on:
        quiet_field.gather(now.stamp_ns, now.rate_radps, now.field_tesla, now.field_sd_tesla, state)


@compiled
def propagate(now: Sample, s: Settings, state: FilterState) -> Link:
    """Move estimate and covariance from the last sample to this one; return the interval, `NO_TIME` for a gap."""
    dt_ns = now.stamp_ns - state.last_ns
    dt_s = dt_ns * 1e-9
    if dt_ns <= 0 or dt_ns > GAP_NS or gyro_off(now.gyro_sd_radps, state):
        if dt_ns < 0:
            turn_back(dt_ns, state)
        coast(dt_s if dt_ns > 0 else UNKNOWN_GAP_S, s, state)
        return NO_TIME
    state.coasting = False
    rate, force_before, force_after = between(
        s.samples,
        difference(state.last_rate_radps, state.gyro_bias_radps),
        difference(now.rate_radps, state.gyro_bias_radps),
        difference(state.last_force_mps2, state.accel_bias_mps2),
        difference(now.force_mps2, state.accel_bias_mps2),
        dt_s,
    )
    R_before, R_after = advance(
        state.position_m, state.velocity_mps, state.quat_xyzw, rate, force_before, force_after, dt_s, state.gravity_mps2
    )
    k = link(R_before, R_after, force_before, force_after, dt_s, s.process.bias_correlation_s)
    q = noise(now.accel_sd_mps2, now.gyro_sd_radps, dt_s, s.process)
    if not s.heading_states:
        q[eleven_states.YAW] = 0.0
    propagate_covariance(state.P, k, q)
    carry(k, state.cross)
    if floor.known(state):
        carry(k, state.floor_cross)
    if field_heading.known(state):
        carry(k, state.north_cross)
    state.accel_bias_mps2[:] *= k.bias_decay
    state.gyro_bias_radps[:] *= k.bias_decay
    return k


@compiled
def hold(state: FilterState) -> None:
    """Stay where the last sample was: nobody knows the velocity and the tilt in the middle of a swing."""
    state.velocity_mps[:] = 0.0
    state.position_m[:] = state.held_m


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
    if not s.heading_states:
        state.P[eleven_states.YAW, eleven_states.YAW] = 0.0
    state.gaps += not state.coasting
    floor.forget(state)
    forget_velocity(state.north_cross)
    state.coasting = True


@compiled
def navigate(
    block: StanceBlock, start: int, stop_ns: int, s: Settings, state: FilterState, out: NavBlock
) -> tuple[int, bool]:
    """Take samples from `start` on, until the stamp of one shows that a stance is over, or reaches `stop_ns`.

    Returns the index of the next sample to take, and whether a stance is over.
    """
    for i in range(start, block.imu.stamp_ns.shape[0]):
        if stance_is_over(block.imu.stamp_ns[i], s.merge_ns, state):
            return i, True
        if block.imu.stamp_ns[i] >= stop_ns:
            return i, False
        sample_step(sample(block, i), s, state)
        write(out, i, state)
    return block.imu.stamp_ns.shape[0], False

"""The chest's loop: judge, turn, move, sample by sample (Cheng eq. 1-12). The only text of it, live and offline.

Attitude, velocity and position (eq. 6-9) are those of the foot, `strapdown.mechanisation`: the exact rotation in place
of the first-order eq. 6, whose quaternion leaves unit length, and the mean velocity in place of the new one in eq. 9.
In eq. 7 gravity is added; here it is what the force shows too much, f - g up, with +g at rest.
"""

import numpy as np

from pdr_core.chest.ahead import chest_yaw_rad
from pdr_core.chest.correction import feed_sample_back
from pdr_core.chest.idle import hold, watch
from pdr_core.chest.output import write
from pdr_core.chest.recovery import LOST_NS, bridge
from pdr_core.chest.rest import judge
from pdr_core.chest.rest_correction import forget_slowly
from pdr_core.chest.settings import Settings
from pdr_core.chest.state import ChestState
from pdr_core.chest.steps import gather, step_ends
from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Triple, difference, mean, norm, rotated, row, scaled
from pdr_core.records import Flags, ImuBlock, NavBlock
from pdr_core.strapdown.mechanisation import advance
from pdr_core.strapdown.samples import POINTS, between


@compiled
def take(stamp_ns: int, force_mps2: Triple, rate_radps: Triple, s: Settings, state: ChestState) -> bool:
    """Take a sample, as measured, into the estimate; return whether it ends a step."""
    dt_ns = stamp_ns - state.last_ns if state.last_ns != NO_STAMP else 0
    jumped = dt_ns > LOST_NS or (dt_ns <= 0 and state.last_ns != NO_STAMP)
    if jumped:
        bridge(stamp_ns, dt_ns, rate_radps, state)
    judge(stamp_ns, force_mps2, rate_radps, s, state)
    force = scaled(state.force_scale, force_mps2)
    ended = False
    if dt_ns > 0 and not jumped:
        state.coasting = False
        move(stamp_ns, force, rate_radps, dt_ns * 1e-9, s, state)
        ended = step_ends(stamp_ns, norm(force) - s.gravity_mps2, dt_ns * 1e-9, s, state)
    watch(stamp_ns, ended, state)
    state.last_ns = stamp_ns
    state.last_force_mps2[:] = force
    state.last_rate_radps[:] = rate_radps
    state.samples += 1
    return ended


@compiled
def move(stamp_ns: int, force: Triple, rate: Triple, dt_s: float, s: Settings, state: ChestState) -> None:
    """Carry the estimate over an interval, once something is known of its attitude; at rest it turns alone (eq. 4)."""
    if not state.aligned:
        return
    if stamp_ns > state.feedback_until_ns:
        state.feedback_radps[:] = 0.0
    bias = difference(state.gyro_bias_radps, state.feedback_radps)  # gB + alpha, eq. 5
    turning, before, after = between(
        POINTS, difference(state.last_rate_radps, bias), difference(rate, bias),
        scaled(1.0, state.last_force_mps2), force, dt_s,
    )  # fmt: skip
    R_before, R_after = advance(
        state.position_m, state.velocity_mps, state.quat_xyzw, turning, before, after, dt_s, s.gravity_mps2
    )
    if state.resting:
        stay(state)
        return
    felt = mean(rotated(R_before, before), rotated(R_after, after))
    gather(felt, norm(force) - s.gravity_mps2, chest_yaw_rad(state.quat_xyzw, state), dt_s, state)
    feed_sample_back(stamp_ns, force, s, state)
    if state.idle:
        hold(state)
    doubt(dt_s, s, state)


@compiled
def stay(state: ChestState) -> None:
    """Hold the position, with no velocity (eq. 4)."""
    state.position_m[:] = state.held_m
    state.velocity_mps[:] = 0.0


@compiled
def doubt(dt_s: float, s: Settings, state: ChestState) -> None:
    """Trust the estimate less: a tilt and a bias that stay are taken to push to one side all the time."""
    forget_slowly(dt_s, s, state)
    pushed_mps: float = state.velocity_sd_mps + s.gravity_mps2 * s.tilt_sd_rad * dt_s
    state.velocity_sd_mps = pushed_mps
    state.position_sd_m += pushed_mps * dt_s
    state.yaw_sd_rad += np.sqrt(state.bias_variance) * dt_s


@compiled
def navigate(
    block: ImuBlock, start: int, s: Settings, state: ChestState, out: NavBlock, resting: Flags
) -> tuple[int, bool]:
    """Take samples from `start` on until one ends a step, whose estimate is not written yet.

    Returns the index of that sample, or the number of samples, and whether a step ends.
    """
    for i in range(start, block.stamp_ns.shape[0]):
        if take(block.stamp_ns[i], row(block.accel_mps2, i), row(block.gyro_radps, i), s, state):
            return i, True
        write(out, i, s, state)
        resting[i] = state.resting
    return block.stamp_ns.shape[0], False

"""What is done where samples or the tilt were lost: the walk is taken to have gone on, and its tilt is found anew.

A stride that shows a knock holds it somewhere: it levels, and the next whole one levels once more. How fast somebody
walks is remembered from the uniform steps, ahead and left of the chest, also over a rest. Before the first of them
nothing is known of it. Then what a lost tilt t has gained since a gap is taken back, g t s after s seconds; since a
knock, of which nobody knows when it was, she is taken to walk as others do. And the speed that is left over at the next
rest was wrong ever since (`settle`).

The rates at both ends of a gap tell what lies between them as long as it is short beside a swing of the trunk, a
stride. The error of that grows with the cube of the time, as of any rate that wanders between two known ones; of a
longer gap nothing is told, and the yaw is as it was, and doubted.
"""

import numpy as np

from pdr_core.chest.ahead import chest_yaw_rad
from pdr_core.chest.correction import level_anew
from pdr_core.chest.rest import interrupt
from pdr_core.chest.settings import Settings
from pdr_core.chest.state import UNKNOWN_SPEED_SD_MPS, ChestState
from pdr_core.chest.steps import stride_force
from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import from_rotation_vector, multiply
from pdr_core.maths.vector import Triple, difference, mean, scaled

WALKING_MPS = 1.25  # people walk at 1.0 to 1.5 m/s: Cheng section 4
GAP_SPEED_SD_MPS = 0.5  # how far off a walk may be that is taken to have gone on
GAP_RATE_SD_RADPS = 0.6  # people turn by 60 deg/s (El-Gohary et al. 2014), here every third gap
IMPOSSIBLE_MPS2 = 2.0  # over a stride: no walker's speed changes by 2 m/s in one
KNOCKED_YAW = 0.5**0.5  # a knock about two level axes is one about the vertical too, as of each of them
TRUSTED_NS = 10_000_000_000  # a walk is taken to have gone on for so long at most
LOST_NS = 200_000_000  # a chest moves so slowly that less is an interval as any
TURNED_NS = 600_000_000  # so long the rates at both ends tell how a chest turns in a gap
LEAST_WAY_S = 0.1  # over which a mean yaw tells more than one of now
BRIDGED_NS = 2_000_000_000  # a walk is taken to go on across a gap of so long


@compiled
def bridge(stamp_ns: int, dt_ns: int, rate_radps: Triple, state: ChestState) -> None:
    """Cross a gap, or a clock that has jumped back: a walk goes on as it did, and its tilt is found anew."""
    state.gaps += not state.coasting
    state.coasting, state.level_due = True, True
    state.level_ns = stamp_ns
    short = 0 < dt_ns <= BRIDGED_NS
    turn_across(dt_ns, rate_radps, state)
    if state.resting:
        start_somewhere(stamp_ns, dt_ns, short, state)
    elif short:
        velocity = walking_velocity(state) if state.walking else scaled(1.0, state.velocity_mps)
        for i in range(3):
            state.position_m[i] += velocity[i] * dt_ns * 1e-9
            state.velocity_mps[i] = velocity[i]
    else:
        state.velocity_mps[:] = 0.0
    interrupt(state)
    state.position_sd_m += GAP_SPEED_SD_MPS * abs(dt_ns) * 1e-9
    speed_sd_mps: float = GAP_SPEED_SD_MPS if state.walking else UNKNOWN_SPEED_SD_MPS
    state.velocity_sd_mps = max(state.velocity_sd_mps, speed_sd_mps)
    state.step_start_ns = NO_STAMP
    state.feedback_radps[:] = 0.0


@compiled
def turn_across(dt_ns: int, rate_radps: Triple, state: ChestState) -> None:
    """Turn the chest across a gap by the rates at both ends, if it is short, and trust the yaw less."""
    gap_s = abs(dt_ns) * 1e-9
    if state.aligned and 0 < dt_ns <= TURNED_NS:
        turning = difference(mean(scaled(1.0, state.last_rate_radps), rate_radps), state.gyro_bias_radps)
        state.quat_xyzw[:] = multiply(state.quat_xyzw, from_rotation_vector(scaled(gap_s, turning)))
    unseen_rad2 = GAP_RATE_SD_RADPS**2 * gap_s**2 * min(gap_s, 1.0)
    state.yaw_sd_rad = min(np.sqrt(state.yaw_sd_rad**2 + unseen_rad2), np.pi)


@compiled
def start_somewhere(stamp_ns: int, dt_ns: int, short: bool, state: ChestState) -> None:
    """Take who rested, should she turn out to walk, to have begun in the middle of the gap; after a long one, now."""
    state.even_m[:] = state.position_m
    state.even_ns = stamp_ns - dt_ns // 2 if short else stamp_ns


@compiled
def known(state: ChestState) -> bool:
    """Return whether this person has been seen to walk in uniform motion."""
    return state.walk_mps[0] != 0.0 or state.walk_mps[1] != 0.0


@compiled
def walking_velocity(state: ChestState) -> Triple:
    """Return how fast this person walks, where the chest points; as others do as long as nothing is known of her."""
    ahead_mps, left_mps = (state.walk_mps[0], state.walk_mps[1]) if known(state) else (WALKING_MPS, 0.0)
    x, y = state.yaw_before[0] + state.step_yaw[0], state.yaw_before[1] + state.step_yaw[1]
    length = np.hypot(x, y)
    if length < LEAST_WAY_S:
        yaw_rad = chest_yaw_rad(state.quat_xyzw, state)
        x, y, length = np.cos(yaw_rad), np.sin(yaw_rad), 1.0
    c, n = x / length, y / length
    return c * ahead_mps - n * left_mps, n * ahead_mps + c * left_mps, 0.0


@compiled
def lost(s: Settings, state: ChestState) -> bool:
    """Return whether the tilt is what is wrong: after a gap, or where nobody moves as the last stride has it."""
    if state.s_before == 0.0 or state.since_rest <= s.start_steps:
        return False
    x, y, _ = stride_force(state)
    too_fast = x**2 + y**2 > (IMPOSSIBLE_MPS2 * (state.s_before + state.step_s)) ** 2
    return state.level_due or state.uneven >= s.steady_steps or too_fast


@compiled
def find_anew(stamp_ns: int, state: ChestState) -> None:
    """Level the chest by the stride that ends, and take the walk to have gone on since it was known to."""
    gained, stride_s = stride_force(state), state.s_before + state.step_s
    knocked_rad = level_anew(gained, state)
    state.yaw_sd_rad = np.hypot(state.yaw_sd_rad, KNOCKED_YAW * knocked_rad)
    if not known(state) and state.settle_ns == NO_STAMP:
        state.settle_ns = state.level_ns if state.level_due else stamp_ns
    if not known(state) and state.level_due:
        take_back(scaled(1.0 / stride_s, gained), (stamp_ns - state.level_ns) * 1e-9, state)
    else:
        go_on_walking(stamp_ns, state)
    state.level_due, state.level_ns = not state.level_due, stamp_ns
    state.releveled, state.uneven = True, 0
    state.velocity_sd_mps = max(state.velocity_sd_mps, GAP_SPEED_SD_MPS)
    state.levelled += 1
    state.feedback_radps[:] = 0.0


@compiled
def take_back(push_mps2: Triple, lost_s: float, state: ChestState) -> None:
    """Take back the speed that a tilt has pushed on for so long, and the way that went by it."""
    for i in range(2):
        state.velocity_mps[i] -= push_mps2[i] * lost_s
        state.position_m[i] -= 0.5 * push_mps2[i] * lost_s**2


@compiled
def go_on_walking(stamp_ns: int, state: ChestState) -> None:
    """Walk on as ever since the last uniform step or rest: what was solved since then was solved with a tilt."""
    velocity = walking_velocity(state)
    state.velocity_mps[:] = velocity
    since_ns = stamp_ns - state.even_ns
    if state.even_ns != NO_STAMP and 0 < since_ns < TRUSTED_NS:
        for i in range(3):
            state.position_m[i] = state.even_m[i] + velocity[i] * since_ns * 1e-9

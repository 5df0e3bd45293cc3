"""What a rest corrects (Cheng eq. 2-4): the bias of the gyro, the scale of the force, attitude and position.

Eq. 2 takes gB for the mean rate of the rest, and aSF for the magnitude of the mean force. But people sway: over a rest
of T seconds the mean rate is off by the change of their tilt over T, with the deviation sqrt(2) sway / T. So gB is the
mean of what was known of it and what this rest shows, by their variances; before the first rest nothing was known, and
it is eq. 2. What `rest_fit` makes of a rest knows better: it sees the sway. Between rests a bias that wanders by s and
is forgotten after WANDER_S changes by 2 s^2 t / WANDER_S. So does it in a rest: in a long one the sums fade, or five
minutes' wander of the bias would stand in the attitude at their end as degrees.

Eq. 3 prints C_b^n where it means its transpose, and the force of a sensor whose axes point down beside one that
measures +g upwards. Levelling is that of the foot (`maths.levelling`): forward-left-up, +g upwards. Eq. 4 holds the
position, and the velocity is zero; the yaw is held too.
"""

import numpy as np

from pdr_core.chest.ahead import chest_yaw_rad, choose
from pdr_core.chest.rest_fit import COUNT, FORCE, RATE, fitted_bias, fitted_turn, mean_of
from pdr_core.chest.settings import Settings
from pdr_core.chest.state import ChestState
from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.levelling import levelled
from pdr_core.maths.quaternion import from_euler, multiply
from pdr_core.maths.vector import norm

WANDER_S = 100.0  # MEMS gyros show their least Allan deviation after 10 to 100 s
MEMORY_S = 5.0  # of a rest: a fit over so long is better than the wander, and longer ones are not
LEAST_NOISE_RADPS = 1e-5
STANDING_SD_MPS = 0.01  # a trunk that sways by sway_sd_rad, some times in ten seconds
BEGIN_SD_M, BEGIN_SD_RAD = 1e-3, 1e-3  # nothing that is published is exact, though the world is defined by it
LEFT_MPS = 1.0  # at the end of a walk of steps that were uniform it is some cm/s
MOMENT_NS = 4_000_000_000  # a turn on the spot, a step or two
FIT_S = 1.2  # measured in the simulator: of a swaying person a fit over T leaves the rate sway FIT_S / T^2


@compiled
def correct(stamp_ns: int, s: Settings, state: ChestState) -> None:
    """Take the bucket into the sums of the rest, and correct bias, scale and attitude by them (eq. 2, 3)."""
    sums, b = state.rest_sums, state.bucket
    for i in range(sums.shape[0]):
        sums[i] += b[i]
    duration_s = (stamp_ns - state.rest_start_ns) * 1e-9
    if duration_s > MEMORY_S:
        fade(s, state)
    weigh_bias(min(duration_s, MEMORY_S), s, state)
    force = mean_of(sums, FORCE)
    state.force_scale = s.gravity_mps2 / norm(force)
    level = levelled(np.array(force), 0.0)
    if not state.aligned:
        choose(level, state)
        begin_track(state)
    now = multiply(level, fitted_turn(state)) if s.sways else level
    state.quat_xyzw[:] = multiply(from_euler(0.0, 0.0, state.held_yaw_rad - chest_yaw_rad(now, state)), now)
    state.velocity_mps[:] = 0.0
    state.velocity_sd_mps = STANDING_SD_MPS
    state.aligned = True


@compiled
def begin_track(state: ChestState) -> None:
    """Let the world begin where the first rest is and the chest points then, unless somebody has told a pose."""
    if not state.placed:
        state.position_sd_m, state.yaw_sd_rad = BEGIN_SD_M, BEGIN_SD_RAD


@compiled
def fade(s: Settings, state: ChestState) -> None:
    """Let all buckets of a long rest count a little less, and with them what was known of the bias before it."""
    keep = 1.0 - state.bucket[COUNT] / state.rest_sums[COUNT]
    for i in range(state.rest_sums.shape[0]):
        state.rest_sums[i] *= keep
    state.rest_bias_variance += wandered(s.bucket_ns * 1e-9, s)


@compiled
def weigh_bias(duration_s: float, s: Settings, state: ChestState) -> None:
    """Weigh what the rest shows of the bias against what was known before it."""
    sums = state.rest_sums
    shown = fitted_bias(state) if s.sways else mean_of(sums, RATE)
    left = FIT_S / duration_s if s.sways else np.sqrt(2.0)
    seen = (left * s.sway_sd_rad / duration_s) ** 2 + LEAST_NOISE_RADPS**2
    gain = state.rest_bias_variance / (state.rest_bias_variance + seen)
    for i in range(3):
        state.gyro_bias_radps[i] = state.rest_bias_radps[i] + gain * (shown[i] - state.rest_bias_radps[i])
    state.bias_variance = (1.0 - gain) * state.rest_bias_variance


@compiled
def forget_slowly(dt_s: float, s: Settings, state: ChestState) -> None:
    """Trust the bias less as time passes."""
    state.bias_variance += wandered(dt_s, s)


@compiled
def wandered(dt_s: float, s: Settings) -> float:
    """Return by what variance a bias changes in a time that is short beside WANDER_S [rad^2/s^2]."""
    return 2.0 * s.bias_wander_radps**2 * dt_s / WANDER_S


@compiled
def settle(stamp_ns: int, state: ChestState) -> None:
    """Take back the way that an unknown speed went: what is left of it now is what it was off by all the time.

    Who moves for a moment and comes to rest with a speed that nobody has was knocked meanwhile, and stayed.
    """
    if state.settle_ns != NO_STAMP:
        for i in range(2):
            state.position_m[i] -= state.velocity_mps[i] * max(stamp_ns - state.settle_ns, 0) * 1e-9
    elif not state.walking and norm(state.velocity_mps) > LEFT_MPS and stamp_ns - state.rest_end_ns < MOMENT_NS:
        state.position_m[:] = state.even_m
        state.levelled += 1
    state.settle_ns = NO_STAMP

"""Rest: its detection (Cheng eq. 1), its begin and its end. What it corrects: `rest_correction`.

Eq. 1 compares mean |f| - |g| and mean |w| with thresholds and leaves out the absolute value of the first, so a free
fall would be a rest. Here the magnitude stands inside the mean, (1/k) sum ||f| - g|: a body that bounces has a mean
|f| of g too. g is aSF of eq. 2 once there was a rest, before that the mean |f| of the window itself, since an
accelerometer may be off by more than the threshold; w is without the bias that is known. A gyro whose bias is larger
than the threshold would never rest: that is for `unknown_bias`.

The samples are summed in buckets, a tenth of a window each; one in which the body moves ends the rest and is not taken
in. Where the force points elsewhere than so far, though no rate has shown it, the sensor was knocked: the rest begins
anew, and so it does after a gap, in which anything may have happened.
"""

from pdr_core.chest.ahead import chest_yaw_rad
from pdr_core.chest.rest_correction import correct, settle
from pdr_core.chest.rest_fit import COUNT, FORCE, FORCE_NORM, RATE, RATE_NORM, mean_of, take_in
from pdr_core.chest.settings import Settings
from pdr_core.chest.state import BUCKETS, SEEN, SEEN_FORCE, SEEN_OFF, SEEN_RATE, ChestState
from pdr_core.chest.unknown_bias import constant, refer_rate, take_bias, take_rate
from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Triple, difference, norm

PLAUSIBLE = 0.06  # share of gravity by which an accelerometer may be off
KNOCKED = 0.05  # share of gravity by which the force moves: 3 degrees, people sway by some tenths of one


@compiled
def judge(stamp_ns: int, force_mps2: Triple, rate_radps: Triple, s: Settings, state: ChestState) -> None:
    """Take a sample, unscaled, into the open bucket; close it when it is full, which may begin or end a rest."""
    if state.bucket_ns == NO_STAMP or stamp_ns < state.bucket_ns:
        state.rest_reference_mps2 = norm(force_mps2)
        state.rest_reference_radps[:] = rate_radps
        begin_bucket(stamp_ns, state)
    elif stamp_ns - state.bucket_ns >= s.bucket_ns:
        close_bucket(stamp_ns, s, state)
    b = state.bucket
    b[COUNT] += 1.0
    for i in range(3):
        b[RATE + i] += rate_radps[i]
        b[FORCE + i] += force_mps2[i]
    b[FORCE_NORM] += norm(force_mps2)
    b[RATE_NORM] += norm(difference(rate_radps, state.gyro_bias_radps))
    take_in(stamp_ns, force_mps2, rate_radps, state)
    state.ring[state.ring_next, SEEN_OFF] += abs(norm(force_mps2) - state.rest_reference_mps2)
    take_rate(rate_radps, state)


@compiled
def begin_bucket(stamp_ns: int, state: ChestState) -> None:
    """Open an empty bucket, in the next place of the ring."""
    state.bucket_ns = stamp_ns
    state.bucket[:] = 0.0
    state.ring_next = (state.ring_next + 1) % BUCKETS
    state.ring[state.ring_next] = 0.0


@compiled
def close_bucket(stamp_ns: int, s: Settings, state: ChestState) -> None:
    """Judge the window that ends now, and take the bucket into the rest or end it."""
    row, b = state.ring[state.ring_next], state.bucket
    row[SEEN], row[SEEN_FORCE], row[SEEN_RATE] = b[COUNT], b[FORCE_NORM], b[RATE_NORM]
    state.ring_filled = min(BUCKETS, state.ring_filled + 1)
    quiet = still(row[SEEN_OFF], row[SEEN_RATE], row[SEEN], s)
    if state.resting and not quiet:
        end_rest(state)
    elif state.resting and turned(s, state):
        begin_rest(stamp_ns, state)
    elif state.resting:
        correct(stamp_ns, s, state)
    elif quiet and state.ring_filled == BUCKETS and window_is_still(s, state):
        begin_rest(stamp_ns, state)
    elif constant(stamp_ns, s, state) and window_weighs(s, state):
        take_bias(state)
        begin_rest(stamp_ns, state)
    state.rest_reference_mps2 = reference_mps2(s, state)
    refer_rate(state)
    begin_bucket(stamp_ns, state)


@compiled
def reference_mps2(s: Settings, state: ChestState) -> float:
    """Return what |f| is compared with: aSF, and before the first rest the mean of the window."""
    if state.aligned:
        return s.gravity_mps2 / state.force_scale
    return state.ring[:, SEEN_FORCE].sum() / state.ring[:, SEEN].sum()


@compiled
def still(off: float, rate: float, samples: float, s: Settings) -> bool:
    """Return whether both means of eq. 1 are below their thresholds."""
    return off < s.static_accel_mps2 * samples and rate < s.static_gyro_radps * samples


@compiled
def window_is_still(s: Settings, state: ChestState) -> bool:
    """Return eq. 1 for the whole window; the window must be one of a body at rest also in its mean |f|."""
    off, rate, samples = state.ring[:, SEEN_OFF].sum(), state.ring[:, SEEN_RATE].sum(), state.ring[:, SEEN].sum()
    return window_weighs(s, state) and still(off, rate, samples, s)


@compiled
def window_weighs(s: Settings, state: ChestState) -> bool:
    """Return whether the mean |f| of the window is one that an accelerometer may show at rest."""
    mean = state.ring[:, SEEN_FORCE].sum() / state.ring[:, SEEN].sum()
    return abs(mean / s.gravity_mps2 - 1.0) < PLAUSIBLE


@compiled
def turned(s: Settings, state: ChestState) -> bool:
    """Return whether the force of the bucket points elsewhere than that of the rest so far."""
    if state.rest_sums[COUNT] == 0.0:
        return False
    moved = difference(mean_of(state.bucket, FORCE), mean_of(state.rest_sums, FORCE))
    return norm(moved) > KNOCKED * s.gravity_mps2


@compiled
def begin_rest(stamp_ns: int, state: ChestState) -> None:
    """Remember what was known of the bias; forget the walk. The rest is summed from the next bucket on."""
    state.resting, state.rest_start_ns = True, stamp_ns
    state.rest_sums[:] = 0.0
    state.rest_angle_rad[:] = 0.0
    settle(stamp_ns, state)
    state.velocity_mps[:] = 0.0
    state.held_m[:] = state.position_m
    state.held_yaw_rad = chest_yaw_rad(state.quat_xyzw, state)
    state.rest_bias_radps[:] = state.gyro_bias_radps
    state.rest_bias_variance = state.bias_variance
    state.step_start_ns = state.constant_ns = NO_STAMP
    state.since_rest, state.uneven, state.level_due = 0, 0, False
    state.feedback_radps[:] = 0.0
    state.walking = False
    state.rests += 1


@compiled
def end_rest(state: ChestState) -> None:
    """Let the chest move."""
    state.resting = False
    state.rest_end_ns = state.even_ns = state.bucket_ns
    state.even_m[:] = state.position_m


@compiled
def interrupt(state: ChestState) -> None:
    """End a rest, and forget the window that is judged: time has passed without a sample."""
    if state.resting:
        state.resting = False
        state.rest_end_ns = state.last_ns
    state.bucket_ns = state.constant_ns = NO_STAMP
    state.ring_filled = 0

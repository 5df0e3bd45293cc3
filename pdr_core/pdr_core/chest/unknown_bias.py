"""A gyro whose bias is larger than what eq. 1 takes for a rest, or was learnt of somebody who turned slowly.

Its rate without the known bias never falls below the threshold, so there would never be a rest. But a rate that is
constant for long, with a force that is one of a rest, is a bias: nobody turns so evenly. Then nothing that was known of
the bias counts any more.
"""

from pdr_core.chest.settings import Settings
from pdr_core.chest.state import BUCKETS, SEEN, SEEN_OFF, SEEN_SPREAD, SEEN_TURN, UNKNOWN_BIAS_VARIANCE, ChestState
from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import Triple, difference, norm

CONSTANT_NS = 2_000_000_000
LARGEST_RADPS = 0.087  # 5 deg/s: zero rate of an MPU-9250, data sheet


@compiled
def take_rate(rate_radps: Triple, state: ChestState) -> None:
    """Take the rate of a sample into the open bucket."""
    seen = state.ring[state.ring_next]
    seen[SEEN_SPREAD] += norm(difference(rate_radps, state.rest_reference_radps))
    for i in range(3):
        seen[SEEN_TURN + i] += rate_radps[i]


@compiled
def refer_rate(state: ChestState) -> None:
    """Compare the next bucket with the mean rate of the window."""
    samples = state.ring[:, SEEN].sum()
    for i in range(3):
        state.rest_reference_radps[i] = state.ring[:, SEEN_TURN + i].sum() / samples


@compiled
def constant(stamp_ns: int, s: Settings, state: ChestState) -> bool:
    """Return, as a bucket without a rest is closed, whether the rate has been constant so long that it is a bias."""
    seen = state.ring[state.ring_next]
    force_rests = seen[SEEN_OFF] < s.static_accel_mps2 * seen[SEEN]
    small = norm(state.rest_reference_radps) < LARGEST_RADPS
    if not (force_rests and small and seen[SEEN_SPREAD] < s.static_gyro_radps * seen[SEEN]):
        state.constant_ns = NO_STAMP
    elif state.constant_ns == NO_STAMP:
        state.constant_ns = stamp_ns
    long = state.constant_ns != NO_STAMP and stamp_ns - state.constant_ns >= CONSTANT_NS
    return long and state.ring_filled == BUCKETS


@compiled
def take_bias(state: ChestState) -> None:
    """Take the mean rate of the window for the bias, of which nothing else is known."""
    state.gyro_bias_radps[:] = state.rest_reference_radps
    state.bias_variance = UNKNOWN_BIAS_VARIANCE

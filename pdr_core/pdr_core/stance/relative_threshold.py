"""A threshold that follows the gait: a foot stands where the statistic is small beside that of its last swing.

A fixed threshold of the GLRT suits one gait: between crawling and running the best one differs 350-fold. But a stance
is always far calmer than the swing before it. So with M the largest statistic of the last moments, longer than a
stance and shorter than two strides,

    threshold = max(floor, min(ceiling, share * M))

which does not depend on the size of the motion. The floor keeps a foot that has rested for longer in stance. It is that
of a good sensor, or twice what the sensor at hand shows in its quietest moments (`quiet`, the smallest M so far): noise
and a turn-on bias of the gyro raise the statistic of a resting foot.

The stance is never perfectly still, and the statistic tells how still: the median speed of a standing foot is about
.0025 sqrt(T) m/s. The noise of a zero velocity follows it. Neighbouring samples err alike, so above 200 Hz, where the
figures were measured, the noise grows with the rate: more samples of one stance tell no more.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.sliding_maximum import MaximumState, fresh_maximum, push_maximum
from pdr_core.records import Floats, Stamps

USUAL_INTERVAL_NS = 5_000_000
QUIET_FACTOR = 2.0


class ThresholdLimits(NamedTuple):
    """The numbers of the threshold and of the zero velocity's noise."""

    memory_ns: int
    share: float
    floor: float
    ceiling: float
    quiet_max: float
    still_sd_mps: float
    sd_per_root_mps: float


class ThresholdState(NamedTuple):
    """The memory of the threshold."""

    recent: MaximumState
    first_ns: Stamps  # (1,) or NO_STAMP
    last_ns: Stamps  # (1,)
    quiet: Floats  # (1,) 0: not known yet


def fresh_threshold() -> ThresholdState:
    """Return the memory of a threshold that has seen nothing."""
    return ThresholdState(fresh_maximum(), np.full(1, NO_STAMP), np.full(1, NO_STAMP), np.zeros(1))


@compiled
def thresholds(
    stamp_ns: Stamps, statistic: Floats, limits: ThresholdLimits, state: ThresholdState
) -> tuple[Floats, Floats]:
    """Return for the next samples, (n,), the threshold and the noise [m/s] of a zero velocity at each."""
    n = stamp_ns.shape[0]
    threshold, sd_mps = np.empty(n), np.empty(n)
    for i in range(n):
        crowded = 1.0 if state.last_ns[0] == NO_STAMP else USUAL_INTERVAL_NS / (stamp_ns[i] - state.last_ns[0])
        threshold[i] = next_threshold(stamp_ns[i], statistic[i], limits, state)
        speed_mps = max(limits.still_sd_mps, limits.sd_per_root_mps * np.sqrt(statistic[i]))
        sd_mps[i] = speed_mps * np.sqrt(max(1.0, crowded))
        state.last_ns[0] = stamp_ns[i]
    return threshold, sd_mps


@compiled
def next_threshold(stamp_ns: int, statistic: float, limits: ThresholdLimits, state: ThresholdState) -> float:
    """Return the threshold for the next sample. A statistic of infinity (the gyro is off) says nothing of the gait."""
    if state.first_ns[0] == NO_STAMP or stamp_ns - state.last_ns[0] > GAP_NS:
        state.first_ns[0] = stamp_ns
    recent = push_maximum(stamp_ns, statistic if np.isfinite(statistic) else 0.0, limits.memory_ns, state.recent)
    if stamp_ns - state.first_ns[0] >= limits.memory_ns:
        state.quiet[0] = min(recent, state.quiet[0] if state.quiet[0] > 0.0 else limits.quiet_max)
    floor = max(limits.floor, QUIET_FACTOR * state.quiet[0])
    return max(floor, min(limits.ceiling, limits.share * recent))

"""The soft rest test: how well does a rest tell the gyro bias? A weight instead of a threshold.

While the foot does not move, the angular rate is the bias. But a foot "at rest" wobbles, and a wobble taken for a bias
turns the whole track. So every window of a rest is weighed by its own unrest: integrate the rate, fit a straight line
to each axis of the angle; its slope is the rate, and `s_phi`, the largest rms about it, the unrest. The slope of a
wobble of rms s_phi over a time T, correlated over about 0.25 s, deviates by s_phi sqrt(12 * 0.25 / T) / T. With a floor
and an allowance for a steady turn, the weight is

    s_b^2 = floor^2 + (1.5 s_phi sqrt(12 * 0.25 / T) / T)^2 + 2 (turn / T)^2

The window with the least s_b speaks for the rest, once, when the rest ends. ZARU in each stance (Gui eq. 23) would
take the 3-4 deg/s at which a standing foot pivots for a bias; it needs this proven rest instead.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import norm
from pdr_core.records import Flags, Floats, ImuBlock, Stamps

CAPACITY = 8192  # samples of a rest that are remembered


class RestLimits(NamedTuple):
    """The numbers of the rest test."""

    moving_radps: float
    smoothing_ns: int
    guard_ns: int
    shortest_ns: int
    longest_ns: int
    later_ns: int
    floor_radps: float
    turn_rad: float
    drift_radps2: float


class RestState(NamedTuple):
    """The memory of the rest test: the rest so far."""

    size: Stamps  # (1,) remembered samples
    first: Flags  # (1,) nothing has moved yet
    stamp_ns: Stamps  # (CAPACITY,)
    angle_rad: Floats  # (CAPACITY, 3) integrated rate
    path_rad: Floats  # (CAPACITY,) integrated magnitude of the rate


def fresh_state() -> RestState:
    """Return the memory of a test that has seen nothing."""
    return RestState(
        np.zeros(1, np.int64),
        np.ones(1, np.bool_),
        np.zeros(CAPACITY, np.int64),
        np.zeros((CAPACITY, 3)),
        np.zeros(CAPACITY),
    )


@compiled
def rests(imu: ImuBlock, limits: RestLimits, state: RestState) -> tuple[Floats, Floats]:
    """Return the mean rate [rad/s] (n, 3) and its deviation (n,) at the samples where a rest ends; 0 elsewhere."""
    n = imu.stamp_ns.shape[0]
    rate, sd = np.zeros((n, 3)), np.zeros(n)
    for i in range(n):
        if interrupted(imu.stamp_ns[i], state):
            rate[i], sd[i] = ended(limits, state)
        remember(imu.stamp_ns[i], imu.gyro_radps[i], state)
        if imu.gyro_sd_radps[i] < 0.0 or moving(limits, state):
            rate[i], sd[i] = ended(limits, state)
    return rate, sd


@compiled
def interrupted(stamp_ns: int, state: RestState) -> bool:
    """Return whether samples are missing before this one, or the clock has jumped back."""
    if state.size[0] == 0:
        return False
    step_ns = stamp_ns - state.stamp_ns[state.size[0] - 1]
    return step_ns < 0 or step_ns > GAP_NS


@compiled
def ended(limits: RestLimits, state: RestState) -> tuple[Floats, float]:
    """Return what the rest has shown, and begin the next one."""
    evidence = best_window(limits, state)
    state.size[0] = 0
    state.first[0] = False
    return evidence


@compiled
def remember(stamp_ns: int, rate_radps: Floats, state: RestState) -> None:
    """Append a sample; where the memory is full, forget its older half."""
    k = state.size[0]
    if k == CAPACITY:
        k = CAPACITY // 2
        state.angle_rad[:k] = state.angle_rad[k:].copy()
        state.stamp_ns[:k] = state.stamp_ns[k:].copy()
        state.path_rad[:k] = state.path_rad[k:].copy()
    state.stamp_ns[k] = stamp_ns
    if k == 0:
        state.angle_rad[0] = 0.0
        state.path_rad[0] = 0.0
    else:
        dt = (stamp_ns - state.stamp_ns[k - 1]) * 1e-9
        state.angle_rad[k] = state.angle_rad[k - 1] + rate_radps * dt
        state.path_rad[k] = state.path_rad[k - 1] + norm(rate_radps) * dt
    state.size[0] = k + 1


@compiled
def moving(limits: RestLimits, state: RestState) -> bool:
    """Return whether the mean rate over the last moments is that of a moving foot."""
    newest = state.size[0] - 1
    oldest = max(0, newest - 1)
    while oldest > 0 and state.stamp_ns[newest] - state.stamp_ns[oldest] < limits.smoothing_ns:
        oldest -= 1
    duration_s = (state.stamp_ns[newest] - state.stamp_ns[oldest]) * 1e-9
    if duration_s <= 0.0:
        return False
    return (state.path_rad[newest] - state.path_rad[oldest]) / duration_s > limits.moving_radps


@compiled
def best_window(limits: RestLimits, state: RestState) -> tuple[Floats, float]:
    """Return the mean rate (3,) and deviation of the window with the least deviation; a deviation of 0: none.

    The first rest may be short; a later one must be long, because the stances of a walk are short rests too. Windows
    grow by a fifth and begin a tenth of their length apart.
    """
    rate, best_sd = np.zeros(3), 0.0
    length_ns = limits.shortest_ns if state.first[0] else limits.later_ns
    stop_ns = state.stamp_ns[state.size[0] - 1] - limits.guard_ns
    start_ns = state.stamp_ns[0] + (0 if state.first[0] else limits.guard_ns)
    while length_ns <= limits.longest_ns and start_ns + length_ns <= stop_ns:
        end_ns = stop_ns
        while end_ns - length_ns >= start_ns:
            first = np.searchsorted(state.stamp_ns[: state.size[0]], end_ns - length_ns)
            last = np.searchsorted(state.stamp_ns[: state.size[0]], end_ns)
            sd = np.hypot(window_sd(state, first, last, limits), limits.drift_radps2 * (stop_ns - end_ns) * 1e-9)
            if last - first > 4 and (best_sd == 0.0 or sd < best_sd):
                duration_s = (state.stamp_ns[last - 1] - state.stamp_ns[first]) * 1e-9
                rate = (state.angle_rad[last - 1] - state.angle_rad[first]) / duration_s
                best_sd = sd
            end_ns -= length_ns // 10
        length_ns += length_ns // 5
    return rate, best_sd


@compiled
def window_sd(state: RestState, first: int, last: int, limits: RestLimits) -> float:
    """Return s_b [rad/s] of the samples first:last."""
    tau_s = (state.stamp_ns[first:last] - state.stamp_ns[first]) * 1e-9
    tau_s = tau_s - np.mean(tau_s)
    unrest_rad = 0.0
    for axis in range(3):
        angle = state.angle_rad[first:last, axis] - np.mean(state.angle_rad[first:last, axis])
        slope = np.sum(tau_s * angle) / np.sum(tau_s**2)
        unrest_rad = max(unrest_rad, np.sqrt(np.mean((angle - slope * tau_s) ** 2)))
    duration_s = (state.stamp_ns[last - 1] - state.stamp_ns[first]) * 1e-9
    wobble = 1.5 * unrest_rad * np.sqrt(12.0 * 0.25 / duration_s) / duration_s
    return np.sqrt(limits.floor_radps**2 + wobble**2 + 2.0 * (limits.turn_rad / duration_s) ** 2)

"""The magnetic field while a foot stands quietly: one window, from which the field's change and direction are read.

In a quiet stance the foot hardly moves, so whatever bends the field around it, iron in the floor included, stays where
it is: seen from a frame that does not turn, the field is constant. The window turns each sample back to where the foot
was when it opened, by the rates without the estimated bias, and sums up what a straight line through them needs.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS
from pdr_core.eskf.state import FilterState
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import (
    Four,
    conjugate,
    from_rotation_vector,
    multiply,
    normalised,
    rows,
    to_rotation_vector,
)
from pdr_core.maths.vector import Triple, Vector, difference, mean, norm, rotated, scaled

SHORTEST_S, LONGEST_S = 0.06, 2.0  # RESEARCH: of windows that tell something, and in which the bias is constant
QUIET_RADPS = 0.3
QUIET_MPS = 0.0381  # the velocity noise of the default detector's statistic 300


class QuietField(NamedTuple):
    """What a window has shown. Vectors in the axes that the foot had when it opened, but `field_now_tesla`."""

    mean_tesla: Triple
    change_tesla_per_s: Triple
    change_sd: float  # [T/s] of each axis, by the noise of the samples
    turned_radps: Triple  # mean rate, without bias
    field_now_tesla: Triple  # the mean, in the axes of the foot as it stands now


@compiled
def quiet(stance: bool, velocity_sd_mps: float, rate_radps: Vector) -> bool:
    """Return whether a foot is so still that the field around it is constant; `rate_radps` without bias."""
    return stance and velocity_sd_mps <= QUIET_MPS and norm(rate_radps) < QUIET_RADPS


@compiled
def full(stamp_ns: int, state: FilterState) -> bool:
    """Return whether the open window is as long as one may be."""
    return stamp_ns - state.field_start_ns >= LONGEST_S * 1e9


@compiled
def gather(stamp_ns: int, rate_radps: Vector, field_tesla: Vector, field_sd_tesla: float, state: FilterState) -> None:
    """Take a quiet sample into the window, which it opens if none is; a deviation below 0: it has no field."""
    if state.field_open:
        step_s = (stamp_ns - state.last_ns) * 1e-9
        rate = difference(mean(state.last_rate_radps, rate_radps), state.gyro_bias_radps)
        turned = multiply(state.field_turn_xyzw, from_rotation_vector(scaled(step_s, rate)))
        state.field_turn_xyzw[:] = normalised(turned)
    else:
        open_window(stamp_ns, state)
    if field_sd_tesla >= 0.0:
        time_s = (stamp_ns - state.field_start_ns) * 1e-9
        field = rotated(rows(state.field_turn_xyzw), field_tesla)
        state.field_samples += 1
        state.field_time_sums[0] += time_s
        state.field_time_sums[1] += time_s**2
        state.field_variance_sum += field_sd_tesla**2
        for i in range(3):
            state.field_sum[i] += field[i]
            state.field_time_sum[i] += time_s * field[i]


@compiled
def open_window(stamp_ns: int, state: FilterState) -> None:
    """Begin a window at a stamp."""
    state.field_open = True
    state.field_start_ns = stamp_ns
    state.field_samples = 0
    state.field_turn_xyzw[:] = (0.0, 0.0, 0.0, 1.0)
    state.field_time_sums[:] = 0.0
    state.field_variance_sum = 0.0
    state.field_sum[:] = 0.0
    state.field_time_sum[:] = 0.0


@compiled
def told(state: FilterState) -> bool:
    """Return whether the window holds enough for a line."""
    long_enough = state.last_ns - state.field_start_ns >= SHORTEST_S * 1e9
    return long_enough and state.field_samples >= 3 and spread_s2(state) > 0.0


@compiled
def spread_s2(state: FilterState) -> float:
    """Return the sum of the squared times [s^2] about their mean."""
    return state.field_time_sums[1] - state.field_time_sums[0] ** 2 / state.field_samples


@compiled
def shown(state: FilterState) -> QuietField:
    """Return what the window has shown: least squares through its samples."""
    n, spread = state.field_samples, spread_s2(state)
    mean_s = state.field_time_sums[0] / n
    mean_field = scaled(1.0 / n, state.field_sum)
    change = scaled(1.0 / spread, difference(state.field_time_sum, scaled(mean_s, state.field_sum)))
    length_s = (state.last_ns - state.field_start_ns) * 1e-9
    turned = scaled(1.0 / length_s, to_rotation_vector(turn(state)))
    now = rotated(rows(conjugate(turn(state))), mean_field)
    return QuietField(mean_field, change, np.sqrt(state.field_variance_sum / n / spread), turned, now)


@compiled
def turn(state: FilterState) -> Four:
    """Return the turn of the foot within the window, where it stands now to where it was."""
    q = state.field_turn_xyzw
    return q[0], q[1], q[2], q[3]


@compiled
def continuous(stamp_ns: int, state: FilterState) -> bool:
    """Return whether a sample follows the last one without a gap."""
    return 0 < stamp_ns - state.last_ns <= GAP_NS

"""One swing between two stances: velocity by integration, the drift taken off, position by integration (Qiu eq. 23-27).

Qiu eq. 23 moves the position by the mean velocity of the interval, in which the acceleration is already, and adds
a tau^2 / 2 on top, from the force with gravity in it. Right is, with a = C(q) f - g,

    v_k = v_{k-1} + tau/2 (a_{k-1} + a_k)        p_k = p_{k-1} + tau/2 (v_{k-1} + v_k).

Where the swing ends, the velocity e beyond that of a standing foot is the error. With s from 0 to 1 for how it has
grown, e s is taken off the velocity before the position is summed up. A steady error of the acceleration makes s the
share of the time (eq. 24-26). But most of e comes with the shock of the heel, which falls between two samples. Where
the noise of each interval is known, s is its share of the variance, the best estimate if the noise is white. In the
paper a standing foot is at rest; here it may roll, at a velocity that comes with the samples.

What is left: white noise makes the velocity a random walk whose end is known, a bridge of variance V s (1 - s). V is
the variance of e, which e^2 tells. With A = int s dt and B = int A dt the displacement by then has the variance

    V (2 B - A^2) + u^2 (t - A)^2 + w^2 A^2,

u and w being how still the foot stands at both ends. For a swing of length T with even s it is V T^2 / 12 and
(u^2 + w^2) T^2 / 4.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NO_STAMP
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import added, norm, row, scaled
from pdr_core.records import Flags, Floats, Stamps

UNKNOWN_ACCEL_MPS2 = 0.5  # error of the acceleration in a swing that does not end, where no swing has told it yet
SHORTEST_S = 0.1  # a shorter swing does not tell it

# fmt: off
LAYOUT = np.dtype([
    ("adrift", np.bool_),                     # the foot has not stood since the start or a gap
    ("stamp_ns", np.int64),                   # of the last sample given out
    ("accel_mps2", np.float64, 3),            # there
    ("velocity_mps", np.float64, 3),
    ("free_mps", np.float64, 3),
    ("position_m", np.float64, 3),
    ("still_sd_mps", np.float64),
    ("accel_sd_mps2", np.float64),            # error of the acceleration in the last swing
    ("contradicted_s", np.float64),           # time in stances that cannot be, since the foot stood
    ("open", np.int64),                       # swings so far that did not end
    ("first_open_ns", np.int64),
], align=True)
# fmt: on
DriftState = np.record


class Accelerations(NamedTuple):
    """n samples in the world frame, and how they hang together."""

    stamp_ns: Stamps  # (n,)
    accel_mps2: Floats  # (n, 3) without gravity
    drift: Floats  # (n,) how much of the drift comes with the interval from the sample before, in any unit
    still_mps: Floats  # (n, 3) velocity of the sensor, should the foot stand: 0, or that of rolling
    still_sd_mps: Floats  # (n,) how still it then is
    stance: Flags  # (n,)
    whole: Flags  # (n,) the interval from the sample before can be integrated


class Track(NamedTuple):
    """n samples of the track. A deviation of the velocity that is infinite: nobody knows it."""

    position_m: Floats  # (n, 3)
    velocity_mps: Floats  # (n, 3) without drift
    free_mps: Floats  # (n, 3) with all the drift since the start or the last gap
    velocity_sd_mps: Floats  # (n,) of one axis
    moved_sd_m: Floats  # (n,) of one axis of the displacement since the foot stood
    stands: Flags  # (n,) the foot stands
    closed: Flags  # (n,) or its swing has ended in a stance


def fresh_state() -> DriftState:
    """Return the memory before the first sample: at the origin."""
    state = np.zeros(1, LAYOUT).view(np.recarray)[0]
    state.adrift = True
    state.accel_sd_mps2 = UNKNOWN_ACCEL_MPS2
    state.stamp_ns = state.first_open_ns = NO_STAMP
    return state


def empty_track(count: int) -> Track:
    """Return room for `count` samples."""
    position, velocity, free = (np.empty((count, 3)) for _ in range(3))
    stands, closed = (np.zeros(count, np.bool_) for _ in range(2))
    return Track(position, velocity, free, np.empty(count), np.empty(count), stands, closed)


@compiled
def interval_s(block: Accelerations, first: int, i: int, state: DriftState) -> float:
    """Return the time since the sample before, for a swing that begins after the last sample given out."""
    before_ns = block.stamp_ns[i - 1] if i > first else state.stamp_ns
    return (block.stamp_ns[i] - before_ns) * 1e-9


@compiled
def gained_mps(block: Accelerations, first: int, i: int, state: DriftState) -> Floats:
    """Return by how much the velocity grows over the interval before sample i, (3,): the trapezium of eq. 23."""
    before = row(block.accel_mps2, i - 1) if i > first else scaled(1.0, state.accel_mps2)
    return np.array(scaled(0.5 * interval_s(block, first, i, state), added(before, row(block.accel_mps2, i))))


@compiled
def drift_mps(block: Accelerations, first: int, last: int, state: DriftState) -> tuple[float, float]:
    """Return the size of the drift at the end of a swing, should it end there, and how long it has lasted [s]."""
    velocity = state.velocity_mps.copy()
    for i in range(first, last + 1):
        velocity += gained_mps(block, first, i, state)
    return norm(velocity - block.still_mps[last]), (block.stamp_ns[last] - state.stamp_ns) * 1e-9


@compiled
def integrate(block: Accelerations, first: int, stop: int, state: DriftState, out: Track) -> None:
    """Write the velocity with its drift."""
    velocity = state.velocity_mps.copy()
    for i in range(first, stop):
        velocity += gained_mps(block, first, i, state)
        out.velocity_mps[i] = velocity
        out.free_mps[i] = state.free_mps + velocity - state.velocity_mps


@compiled
def remember(block: Accelerations, i: int, stands: bool, closed: bool, state: DriftState, out: Track) -> None:
    """Write where sample i is and note it as the last one given out."""
    out.position_m[i] = state.position_m
    out.stands[i], out.closed[i] = stands, closed
    state.stamp_ns = block.stamp_ns[i]
    state.accel_mps2[:] = block.accel_mps2[i]
    state.velocity_mps[:] = out.velocity_mps[i]
    state.free_mps[:] = out.free_mps[i]
    state.still_sd_mps = block.still_sd_mps[i]
    state.contradicted_s = 0.0 if stands else state.contradicted_s


@compiled
def close(block: Accelerations, first: int, last: int, state: DriftState, out: Track) -> None:
    """Take the drift off the swing first..last, whose last sample stands; within a stance it has but that one."""
    integrate(block, first, last + 1, state, out)
    error = out.velocity_mps[last] - block.still_mps[last]
    variance, whole = norm(error) ** 2 / 3.0, block.drift[first : last + 1].sum()
    begin_mps2, end_mps2 = float(state.still_sd_mps) ** 2, block.still_sd_mps[last] ** 2
    swing_s = (block.stamp_ns[last] - state.stamp_ns) * 1e-9
    time_s, share, A, B = 0.0, 0.0, 0.0, 0.0
    for i in range(first, last + 1):
        dt_s, before, A_before = interval_s(block, first, i, state), share, A
        share = min(1.0, share + block.drift[i] / whole) if i < last else 1.0
        time_s, A = time_s + dt_s, A + 0.5 * dt_s * (before + share)
        B += 0.5 * dt_s * (A_before + A)
        bridge_m2 = max(0.0, variance * (2.0 * B - A**2))
        out.moved_sd_m[i] = np.sqrt(bridge_m2 + begin_mps2 * (time_s - A) ** 2 + end_mps2 * A**2)
        ends_mps2 = begin_mps2 * (1.0 - share) ** 2 + end_mps2 * share**2
        out.velocity_sd_mps[i] = np.sqrt(variance * share * (1.0 - share) + ends_mps2)
        out.velocity_mps[i] -= share * error
        out.velocity_mps[i] = out.velocity_mps[i] if i < last else block.still_mps[last]
        state.position_m[:] += 0.5 * dt_s * (state.velocity_mps + out.velocity_mps[i])
        remember(block, i, i == last, True, state, out)
    if swing_s >= SHORTEST_S:
        state.accel_sd_mps2 = np.sqrt(variance) / swing_s


@compiled
def leave_open(block: Accelerations, first: int, stop: int, state: DriftState, out: Track) -> int:
    """Give out first:stop, a swing that does not end, as it is; from now on nobody knows the velocity."""
    if stop > first:
        state.open += 1
        state.first_open_ns = block.stamp_ns[first] if state.open == 1 else state.first_open_ns
        integrate(block, first, stop, state, out)
        time_s = 0.0
        for i in range(first, stop):
            dt_s = interval_s(block, first, i, state)
            time_s += dt_s
            out.velocity_sd_mps[i] = state.accel_sd_mps2 * time_s
            out.moved_sd_m[i] = 0.5 * state.accel_sd_mps2 * time_s**2
            state.position_m[:] += 0.5 * dt_s * (state.velocity_mps + out.velocity_mps[i])
            remember(block, i, False, False, state, out)
    state.adrift = True
    return stop

"""The acceleration without its vibrations, at even stamps, from a sensor of any rate (Zhou section 2.2).

Zhou filters with a linear-phase FIR filter in a Hamming window. It delays every frequency alike, by half its length: so
a value belongs to the middle of the samples that it is made of, which is the stamp it gets here.

A Hamming window, .54 - .46 cos, ends with a step of .08. Counted whole, a sample that lies on an end stands for twice
the time that it should, and how many lie there depends on the rate: a motion of 3.2 Hz came out .6 % larger from 50 Hz
than from 200 Hz, and the strides with it. So the ends count half, as in the trapezoidal rule.

The filter is designed once, at 1 kHz, and its taps are read at the times at which samples are, whatever their rate, and
scaled to a sum of one. At even stamps that is, but for the ends, what `scipy.signal.firwin` designs. The outcome
is the same 50 times a second from a sensor of 20 or 400 Hz, so what is learned at one rate holds at another. Hence it
is the three axes that are filtered, and not their norm: a sensor that measures at a lower rate filters its axes too.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.conventions import GAP_NS, NANOSECONDS, nanoseconds
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, fresh, let_go, record
from pdr_core.maths.vector import Triple, row, within
from pdr_core.params import GaitParams
from pdr_core.records import Flags, Floats, ImuBlock, Stamps

GRID_NS = 20_000_000  # between two values: 50 Hz shows five times the cutoff
TAP_NS = 1_000_000
MOST_VALUES = GAP_NS // GRID_NS  # that one sample completes: after a longer time it begins anew
CAPACITY = 2048  # samples that are remembered; where there are more, the oldest are forgotten
MEMORY = record(
    [
        ("held", np.int64),
        ("first", np.int64),  # row of the first sample that a later value needs
        ("stamp_ns", np.int64, CAPACITY),
        ("accel_mps2", np.float64, (CAPACITY, 3)),
        ("begin_ns", np.int64),  # stamp of the first sample since the last gap
        ("given", np.int64),  # values given out since then
    ],
)


class EvenBlock(NamedTuple):
    """n low-passed accelerations at even stamps."""

    stamp_ns: Stamps  # (n,)
    accel_mps2: Floats  # (n, 3)
    fresh: Flags  # (n,) nothing is known of the time before: the first value, or one after a gap


class LowPass:
    """Samples of an accelerometer in, even ones out; a gap, or stamps that go back, begin anew."""

    def __init__(self, params: GaitParams) -> None:
        self._taps = taps(params.cutoff_hz, params.filter_s)
        self._memory = fresh(MEMORY)

    def run(self, imu: ImuBlock) -> EvenBlock:
        """Take the next samples; one that was not measured, or is no number, is left out."""
        return low_passed(imu, self._taps, self._memory[0])


def taps(cutoff_hz: float, filter_s: float) -> Floats:
    """Return a low-pass filter of odd length, one tap a millisecond: a sinc in a Hamming window with half ends."""
    half = nanoseconds(0.5 * filter_s) // TAP_NS
    from scipy.signal import firwin  # here, since it loads the optimiser, which takes its time at every start

    row = firwin(2 * half + 1, cutoff_hz, window="hamming", fs=NANOSECONDS / TAP_NS)
    row[[0, -1]] *= 0.5
    return row


@compiled
def low_passed(imu: ImuBlock, taps: Floats, s: Memory) -> EvenBlock:
    """Return the values, (m,), whose samples are all there with the next ones."""
    n, room = 0, MOST_VALUES * imu.stamp_ns.shape[0]
    even = EvenBlock(np.empty(room, np.int64), np.empty((room, 3)), np.empty(room, np.bool_))
    for i in range(imu.stamp_ns.shape[0]):
        force = row(imu.accel_mps2, i)
        if imu.accel_sd_mps2[i] >= 0.0 and within(force, np.inf):
            remember(imu.stamp_ns[i], force, s)
            n = give(n, taps, s, even)
    return EvenBlock(even.stamp_ns[:n], even.accel_mps2[:n], even.fresh[:n])


@compiled
def remember(stamp_ns: int, force_mps2: Triple, s: Memory) -> None:
    """Take a sample into the memory; after a gap it is the first one."""
    if s.held == 0 or not 0 <= stamp_ns - s.stamp_ns[s.held - 1] <= GAP_NS:
        s.held, s.first, s.given, s.begin_ns = 0, 0, 0, stamp_ns
    if s.held == CAPACITY:
        unneeded = s.first if s.first > 0 else CAPACITY // 2
        let_go(s.stamp_ns, unneeded, CAPACITY)
        let_go(s.accel_mps2, unneeded, CAPACITY)
        s.held, s.first = CAPACITY - unneeded, 0
    s.stamp_ns[s.held] = stamp_ns
    for axis in range(3):
        s.accel_mps2[s.held, axis] = force_mps2[axis]
    s.held += 1


@compiled
def give(n: int, taps: Floats, s: Memory, even: EvenBlock) -> int:
    """Write the values that the newest sample completes, from row n on; return the row after them."""
    reach_ns = (taps.shape[0] - 1) // 2 * TAP_NS
    middle_ns = s.begin_ns + reach_ns + s.given * GRID_NS
    while middle_ns + reach_ns <= s.stamp_ns[s.held - 1]:
        weigh(middle_ns - reach_ns, middle_ns + reach_ns, taps, s, even.accel_mps2[n])
        even.stamp_ns[n], even.fresh[n] = middle_ns, s.given == 0
        n, middle_ns = n + 1, middle_ns + GRID_NS
        s.given += 1
    return n


@compiled
def weigh(start_ns: int, end_ns: int, taps: Floats, s: Memory, out: Floats) -> None:
    """Write the weighted mean, (3,), of the samples from a stamp to another."""
    while s.stamp_ns[s.first] < start_ns:
        s.first += 1
    out[:] = 0.0
    total, i = 0.0, s.first
    while i < s.held and s.stamp_ns[i] <= end_ns:
        weight = tap(s.stamp_ns[i] - start_ns, taps)
        total += weight
        for axis in range(3):
            out[axis] += weight * s.accel_mps2[i, axis]
        i += 1
    out /= total


@compiled
def tap(after_ns: int, taps: Floats) -> float:
    """Return the filter at a time since its beginning, between two taps by their line."""
    i = min(after_ns // TAP_NS, taps.shape[0] - 2)
    share = after_ns / TAP_NS - i
    return (1.0 - share) * taps[i] + share * taps[i + 1]

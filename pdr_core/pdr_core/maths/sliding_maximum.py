"""The largest value of the last moments of a stream, at a constant cost per sample.

Only values that may still become the largest are remembered: each is smaller than the one before it (a monotone queue).
"""

from typing import NamedTuple

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats, Stamps

CAPACITY = 8192  # values; where it is exceeded, the oldest is forgotten


class MaximumState(NamedTuple):
    """The queue, a ring."""

    first: Stamps  # (1,) where it begins
    size: Stamps  # (1,)
    stamp_ns: Stamps  # (CAPACITY,)
    value: Floats  # (CAPACITY,)


def fresh_maximum() -> MaximumState:
    """Return an empty queue."""
    return MaximumState(np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(CAPACITY, np.int64), np.zeros(CAPACITY))


@compiled
def push_maximum(stamp_ns: int, value: float, window_ns: int, state: MaximumState) -> float:
    """Take the next value and return the largest of those whose stamps are at most `window_ns` older."""
    first, size = state.first[0], state.size[0]
    while size > 0 and state.value[(first + size - 1) % CAPACITY] <= value:
        size -= 1
    if size == CAPACITY:
        first, size = (first + 1) % CAPACITY, size - 1
    newest = (first + size) % CAPACITY
    state.stamp_ns[newest] = stamp_ns
    state.value[newest] = value
    size += 1
    while stamp_ns - state.stamp_ns[first] > window_ns:
        first, size = (first + 1) % CAPACITY, size - 1
    state.first[0] = first
    state.size[0] = size
    return state.value[first]

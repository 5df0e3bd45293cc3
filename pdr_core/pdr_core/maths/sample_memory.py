"""Samples of accelerometer and magnetometer in a memory of fixed size: what memories that keep both have in common."""

from typing import Any

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory, let_go
from pdr_core.maths.vector import Triple


def sample_rows(capacity: int) -> list[tuple[Any, ...]]:
    """Return the fields of a record that holds so many samples."""
    return [
        ("held", np.int64),
        ("stamp_ns", np.int64, capacity),
        ("accel_mps2", np.float64, (capacity, 3)),
        ("field_tesla", np.float64, (capacity, 3)),
        ("field_sd_tesla", np.float64, capacity),
    ]


@compiled
def add_sample(stamp_ns: int, force_mps2: Triple, field_tesla: Triple, field_sd_tesla: float, s: Memory) -> None:
    """Write a sample behind those that are held; there must be room."""
    s.stamp_ns[s.held], s.field_sd_tesla[s.held] = stamp_ns, field_sd_tesla
    s.accel_mps2[s.held] = force_mps2
    s.field_tesla[s.held] = field_tesla
    s.held += 1


@compiled
def let_samples_go(first: int, s: Memory) -> None:
    """Forget the samples before a row."""
    let_go(s.stamp_ns, first, s.held)
    let_go(s.accel_mps2, first, s.held)
    let_go(s.field_tesla, first, s.held)
    let_go(s.field_sd_tesla, first, s.held)
    s.held -= first

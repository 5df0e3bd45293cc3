"""Memories of fixed size in compiled code, each one numpy record: rows in order of time, let go in bulk when full.

A record costs a call of compiled code next to nothing, if it is handed over as an array of one; a tuple costs it each
of its numbers. So where calls are many, settings are packed likewise.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats, Stamps

Memory = Any  # a numpy record: its fields have their own types, which numpy does not tell


def record(fields: list[tuple[Any, ...]]) -> np.dtype:
    """Return the type of a record with these fields: name, type, and shape if it is an array."""
    return np.dtype((np.record, np.dtype(fields, align=True)))


def fresh(kind: np.dtype) -> NDArray[Any]:
    """Return a record of zeros, as an array of one."""
    return np.zeros(1, kind)


def packed(settings: tuple) -> NDArray[Any]:
    """Return a named tuple of numbers, arrays and such tuples as an array of one record with the same names."""
    return np.array([settings], layout(settings))


def layout(value: Any) -> np.dtype:
    """Return how a value is kept in a record."""
    if isinstance(value, tuple):
        names: tuple[str, ...] = value._fields  # type: ignore[attr-defined]
        return record([(name, layout(one)) for name, one in zip(names, value, strict=True)])
    kept = np.asarray(value)
    return np.dtype((kept.dtype, kept.shape))


@compiled
def let_go(column: Floats | Stamps, first: int, size: int) -> None:
    """Move the rows first:size of a column, (n,) or (n, k), to its beginning."""
    column[: size - first] = column[first:size].copy()


@compiled
def first_at(stamp_ns: Stamps, first: int, size: int, at_ns: int) -> int:
    """Return the first of the rows first:size, in ascending order, whose stamp is not before `at_ns`, or `size`."""
    low, high = first, size
    while low < high:
        middle = (low + high) // 2
        if stamp_ns[middle] < at_ns:
            low = middle + 1
        else:
            high = middle
    return low

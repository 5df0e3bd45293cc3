"""Runs of equal values in a row."""

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray


def equal_runs(values: NDArray[Any]) -> list[tuple[int, int]]:
    """Return the runs of equal values, first row and the one behind the last, in order; NaN equals nothing."""
    edges = np.flatnonzero(values[1:] != values[:-1]) + 1
    return list(pairwise([0, *edges.tolist(), len(values)])) if len(values) else []

"""Which rows of two tracks belong together, by their stamps."""

import numpy as np

from pdr_core.evaluation.resample import AtStamps
from pdr_core.records import Floats, Stamps, Truth


def nearest(estimate: Truth, truth: Truth, within_ns: int) -> tuple[Stamps, Floats, Floats]:
    """Return stamps (n,) and positions (n, 3) of the rows that are at most `within_ns` apart.

    As evo does it: each row of the shorter track takes the nearest of the longer one, the earlier of two equally near.
    """
    if len(truth.stamp_ns) <= len(estimate.stamp_ns):
        rows, partners = _pairs(truth.stamp_ns, estimate.stamp_ns, within_ns)
    else:
        partners, rows = _pairs(estimate.stamp_ns, truth.stamp_ns, within_ns)
    return truth.stamp_ns[rows], estimate.position_m[partners], truth.position_m[rows]


def interpolated(estimate: Truth, truth: Truth) -> tuple[Stamps, Floats, Floats]:
    """Return stamps (n,) and positions (n, 3) of the truth that lie within the estimate, which is interpolated."""
    stamps, first = np.unique(estimate.stamp_ns, return_index=True)
    wanted, rows = np.unique(truth.stamp_ns, return_index=True)
    resampled = AtStamps(wanted)
    resampled.add(stamps, estimate.position_m[first])
    covered = resampled.covered
    return wanted[covered], resampled.position_m[covered], truth.position_m[rows[covered]]


def _pairs(short_ns: Stamps, long_ns: Stamps, within_ns: int) -> tuple[Stamps, Stamps]:
    """Return which rows of the shorter track have a partner, and which rows of the longer one that is."""
    known_ns, row = np.unique(long_ns, return_index=True)
    if not len(known_ns):
        return row, row
    after = np.minimum(np.searchsorted(known_ns, short_ns), len(known_ns) - 1)
    before = np.maximum(after - 1, 0)
    earlier = np.abs(short_ns - known_ns[before]) <= np.abs(known_ns[after] - short_ns)
    best = np.where(earlier, before, after)
    near = np.flatnonzero(np.abs(short_ns - known_ns[best]) <= within_ns)
    return near, row[best[near]]

"""The one rule of pairing: a field belongs to the sample nearest to it, and a sample takes the nearest of its fields.

Where two are equally near, the earlier one counts.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.records import Flags, Stamps

NEVER_NS = 2**62


class Choice(NamedTuple):
    """What n samples take."""

    field: Stamps  # (n,) index of a field, -1: none
    settled_ns: Stamps  # (n,) once the fields have got so far beyond the sample, none can come that is nearer
    may_lose: Flags  # (n,) the next sample, which is not there yet, may be nearer to the field


def nearest(sample_ns: Stamps, reach_ns: Stamps, since_ns: int, field_ns: Stamps) -> Choice:
    """Return which of the ascending fields, (m,), the ascending samples, (n,), take, none beyond their reach, (n,).

    `since_ns`: how long the sample before the first one is ago.
    """
    apart_ns = np.empty(len(sample_ns) + 1, np.int64)
    apart_ns[0], apart_ns[1:-1], apart_ns[-1] = since_ns, sample_ns[1:] - sample_ns[:-1], NEVER_NS
    before_ns = np.minimum(reach_ns, (apart_ns[:-1] - 1) // 2)
    after_ns = np.minimum(reach_ns, apart_ns[1:] // 2)
    if not len(field_ns):
        return Choice(np.full(len(sample_ns), -1), after_ns, np.zeros(len(sample_ns), np.bool_))
    right = field_ns.searchsorted(sample_ns)
    left = right - 1
    left_ns = sample_ns - field_ns[np.maximum(left, 0)]
    right_ns = field_ns[np.minimum(right, len(field_ns) - 1)] - sample_ns
    left_fits = (left >= 0) & (left_ns <= before_ns)
    right_fits = (right < len(field_ns)) & (right_ns <= after_ns)
    takes_right = right_fits & ~(left_fits & (left_ns <= right_ns))
    field = np.where(takes_right, right, np.where(left_fits, left, -1))
    settled_ns = np.where(takes_right, right_ns, np.where(left_fits, np.minimum(left_ns, after_ns), after_ns))
    may_lose = takes_right & (right_ns > 0)
    may_lose[:-1] = False
    return Choice(field, settled_ns, may_lose)


def equal(sample_ns: Stamps, field_ns: Stamps) -> Stamps:
    """Return for each sample, (n,), the index of the first field, (m,), of its stamp that is not taken; -1: none."""
    there: dict[int, list[int]] = {}
    for i in np.flatnonzero(np.isin(field_ns, sample_ns))[::-1].tolist():
        there.setdefault(int(field_ns[i]), []).append(i)
    taken = [there[stamp].pop() if there.get(stamp) else -1 for stamp in sample_ns.tolist()]
    return np.array(taken, np.int64)

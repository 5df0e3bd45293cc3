"""All that the filter remembers between two samples. It can be copied, saved and restored."""

from typing import NamedTuple

import numpy as np

from pdr_core.eskf.error_state import SIZE, Nominal, at_origin
from pdr_core.records import Flags, Floats, Stamps


class Alignment(NamedTuple):
    """The first moments, in which the attitude comes from gravity alone."""

    running: Flags  # (1,)
    start_ns: Stamps  # (1,) -1: no sample yet
    force_sum: Floats  # (3,)
    samples: Stamps  # (1,)
    moving: Flags  # (1,) the foot did not rest


class Ends(NamedTuple):
    """Where the last two stances ended: index 0 the confirmed end, index 1 one that may still go on.

    `cross` holds the covariances of the errors now with the position errors at those two ends (stochastic cloning);
    it makes the covariance of a displacement exact, not the difference of two growing ones.
    """

    number: Stamps  # (1,) of the next step event
    stamp_ns: Stamps  # (2,) -1: none
    position_m: Floats  # (2, 3)
    covariance: Floats  # (2, 3, 3) of the position
    cross: Floats  # (15, 6)
    displacement_covariance: Floats  # (3, 3) from end 0 to end 1
    yaw_rad: Floats  # (2,)
    yaw_sd_rad: Floats  # (2,)


class Counts(NamedTuple):
    """What happened so far, for people to read."""

    samples: Stamps  # (1,)
    accepted: Stamps  # (1,) zero-velocity updates
    rejected: Stamps  # (1,) by the innovation gate
    released: Stamps  # (1,) accepted with inflated noise after a row of rejections
    gaps: Stamps  # (1,)
    longest_swing_s: Floats  # (1,) longest time without a zero-velocity update
    normalised_innovation: Floats  # (1,) of the last zero-velocity update


class FilterState(NamedTuple):
    """Estimate, covariance and memory of the filter."""

    nominal: Nominal
    P: Floats  # (15, 15)
    gravity_mps2: Floats  # (1,)
    last_ns: Stamps  # (1,) stamp of the last sample; -1: none
    last_force_mps2: Floats  # (3,) as measured
    last_rate_radps: Floats  # (3,) as measured
    last_gyro_sd_radps: Floats  # (1,)
    coasting: Flags  # (1,) the last interval was not integrated
    last_accepted_ns: Stamps  # (1,) stamp of the last accepted zero-velocity update; -1: none
    rejecting_since_ns: Stamps  # (1,) -1: not rejecting
    alignment: Alignment
    ends: Ends
    counts: Counts


def none_yet(count: int = 1) -> Stamps:
    """Return stamps that say "none"."""
    return np.full(count, -1, np.int64)


def zero() -> Stamps:
    """Return a counter at zero."""
    return np.zeros(1, np.int64)


def fresh_state() -> FilterState:
    """Return the memory of a filter that has seen nothing."""
    return FilterState(
        nominal=at_origin(),
        P=np.zeros((SIZE, SIZE)),
        gravity_mps2=np.zeros(1),
        last_ns=none_yet(),
        last_force_mps2=np.zeros(3),
        last_rate_radps=np.zeros(3),
        last_gyro_sd_radps=np.zeros(1),
        coasting=np.zeros(1, np.bool_),
        last_accepted_ns=none_yet(),
        rejecting_since_ns=none_yet(),
        alignment=Alignment(np.ones(1, np.bool_), none_yet(), np.zeros(3), zero(), np.zeros(1, np.bool_)),
        ends=Ends(
            zero(),
            none_yet(2),
            np.zeros((2, 3)),
            np.zeros((2, 3, 3)),
            np.zeros((SIZE, 6)),
            np.zeros((3, 3)),
            np.zeros(2),
            np.zeros(2),
        ),
        counts=Counts(zero(), zero(), zero(), zero(), zero(), np.zeros(1), np.zeros(1)),
    )

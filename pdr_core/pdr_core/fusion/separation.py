"""Two feet of one person are never farther apart than legs reach: an inequality, used where it is violated.

The place d of one foot seen from the other lies in an ellipsoid d' E d <= 1, of equal half axes in the plane and
another one upwards (Prateek et al. 2013 use a sphere; Shi et al. 2017 an ellipsoid). Where the estimated d lies beyond
it, the most likely d* on its surface minimises (d* - d)' P^-1 (d* - d), P being the covariance of d: with a Lagrange
multiplier m

    (P^-1 + m E) d* = P^-1 d,      d*' E d* = 1,      so d* = (I + m P E)^-1 d,

which comes nearer with m > 0: the root is found by halving an interval. There the surface has the normal n ~ E d*,
and d - d* ~ P n. What is known is only that n' d is not larger than n' d*: one number, and nothing of the directions
along the surface. To one foot it is a measurement of its own place by the other: the error n n'(d - d*), with the
other's variance n' P_o n along n and no information across. So each foot takes the share that its covariance has.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.records import Floats, PositionError

UNKNOWN_SD_M = 1e3  # along the surface


class Reach(NamedTuple):
    """The half axes of the ellipsoid, and how well they are known."""

    plan_m: float
    height_m: float
    sd_m: float

    @property
    def E(self) -> Floats:  # noqa: N802
        """The matrix (3, 3) of the ellipsoid."""
        return np.diag([1.0 / self.plan_m**2, 1.0 / self.plan_m**2, 1.0 / self.height_m**2])


def nearest_within(apart_m: Floats, covariance_m2: Floats, reach: Reach) -> Floats:
    """Return the most likely d (3,) on the surface, for one that lies beyond it and has a covariance (3, 3)."""
    E, low, high = reach.E, 0.0, 1.0
    PE = covariance_m2 @ E

    def at(m: float) -> Floats:
        return np.asarray(np.linalg.solve(np.eye(3) + m * PE, apart_m), dtype=np.float64)

    while at(high) @ E @ at(high) > 1.0:
        high *= 2.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if at(middle) @ E @ at(middle) > 1.0 else (low, middle)
    return at(high)


def place_error(apart_m: Floats, own_m2: Floats, other_m2: Floats, reach: Reach) -> PositionError | None:
    """Return by how much a foot is off that is `apart_m` (3,) from the other; None: no farther than legs reach.

    `own_m2`, `other_m2` (3, 3) are the covariances of both places.
    """
    if not apart_m @ reach.E @ apart_m > 1.0:
        return None
    nearest_m = nearest_within(apart_m, own_m2 + other_m2, reach)
    n = reach.E @ nearest_m
    n /= np.linalg.norm(n)
    along, variance_m2 = np.outer(n, n), float(n @ other_m2 @ n) + reach.sd_m**2
    return PositionError(along @ (apart_m - nearest_m), variance_m2 * along + UNKNOWN_SD_M**2 * (np.eye(3) - along))

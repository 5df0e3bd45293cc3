"""The yaw measurement on a straight line (Gui eq. 24-25), with what the line itself may be off.

Gui compares a step's direction with that of the line and takes the difference for the yaw error. But a line is off its
direction, and all its strides are off by the same angle: were each of them taken for news, the filter would soon
believe the direction more than it deserves, and turn its track by what the walk is off. With e for the yaw error of the
estimate and o for what the estimate of the line's direction is off, a stride of the line shows

    r = heading - direction = e + o + n,       P = var e,  V = var o,  C = cov(e, o),  N = var n,

in which n is its own noise. Of the two unknowns the filter carries e and the line carries o, which it learns by
Kalman's formulas; C holds for any gain K of e, C - K (V + C) - K_o (P + C) + K K_o S:

    S = P + 2 C + V + N,    K_o = (V + C) / S,
    direction <- direction + K_o r,    V <- V - K_o (V + C),    C <- C - K_o (P + C).

Between strides P grows by itself and C stays. The filter has no place for o, so it is told what r says of e alone. The
part of o that is not correlated with e has the variance V - C^2 / P, and so

    r = h e + w,    h = 1 + C / P,    var w = V - C^2 / P + N:    the error r / h, with the variance var w / h^2.

Where a direction is known from elsewhere, C begins at 0 and becomes negative: soon the line tells only by how much the
estimate has turned since it began. Where nothing is known of it (V large) the first strides tell nothing and leave
V = P + N, C = -P: the line is held in the direction in which it began, and has learnt it when it ends.
"""

import math
from typing import NamedTuple

from pdr_core.maths.circular import TURN_RAD, wrapped_rad

SMALLEST_GAIN = 1e-6
SMALLEST_WEIGHT = 1e-6
UNKNOWN_RAD2 = 1e4  # variance of a direction of which nothing is known


class YawMeasurement(NamedTuple):
    """By how much the track is turned too far, and how well that is known."""

    error_rad: float
    sd_rad: float

    def turn_by_filter_rad(self, yaw_variance_rad2: float) -> float:
        """Return by how much the filter will turn its track, which it knows so well (Gui eq. 20-21)."""
        return -self.error_rad * yaw_variance_rad2 / (yaw_variance_rad2 + self.sd_rad**2)


class Heading(NamedTuple):
    """Where one stride goes, or several on average, in the estimate."""

    heading_rad: float
    noise_rad2: float  # variance by which it is off the line on its own
    yaw_variance_rad2: float  # of the estimate


class Line:
    """A straight line with its direction; there is one more after each `spacing_rad`, of which the nearest counts.

    A line of unknown direction learns it, with its variance.
    """

    def __init__(
        self, direction_rad: float, variance_rad2: float = UNKNOWN_RAD2, spacing_rad: float = math.inf
    ) -> None:
        self.direction_rad = direction_rad
        self.variance_rad2 = variance_rad2
        self._covariance_rad2 = 0.0
        self.spacing_rad = spacing_rad

    def repeated(self, off_rad2: float, spacing_rad: float) -> "Line":
        """Return another line that should have this direction, or one of those beside it, and is off it by so much."""
        return Line(self.direction_rad, self.variance_rad2 + off_rad2, spacing_rad)

    def weighted(self, weight: float) -> "Line":
        """Return the line with a direction that counts only by a weight of 0 .. 1."""
        return Line(self.direction_rad, self.variance_rad2 / max(weight, SMALLEST_WEIGHT), self.spacing_rad)

    def wander(self, variance_rad2: float) -> None:
        """Let the line bend a little, by an angle of this variance, from one stride to the next."""
        self.variance_rad2 += variance_rad2

    def off_rad(self, heading_rad: float) -> float:
        """Return a heading minus the direction that is nearest."""
        return wrapped_rad(heading_rad - self.direction_rad, min(self.spacing_rad, TURN_RAD))

    def fits(self, seen: Heading, gate: float) -> bool:
        """Tell whether the stride may be of this line, and of no other: the gate must end before the middle of two."""
        widest_rad = math.sqrt(gate * self._innovation_rad2(seen))
        return abs(self.off_rad(seen.heading_rad)) <= widest_rad < self.spacing_rad / 2.0

    def told(self, seen: Heading) -> YawMeasurement | None:
        """Take a stride in; return what the filter should be told, None if that is nothing."""
        P, V, C, S = seen.yaw_variance_rad2, self.variance_rad2, self._shared(seen), self._innovation_rad2(seen)
        error_rad, K_line = self.off_rad(seen.heading_rad), (V + C) / S
        self.direction_rad += K_line * error_rad
        self.variance_rad2 = V - K_line * (V + C)
        self._covariance_rad2 = C - K_line * (P + C)
        h = 1.0 + C / P
        if h**2 * P < SMALLEST_GAIN * S:
            return None
        return YawMeasurement(error_rad / h, math.sqrt(V - C**2 / P + seen.noise_rad2) / h)

    def _innovation_rad2(self, seen: Heading) -> float:
        return seen.yaw_variance_rad2 + 2.0 * self._shared(seen) + self.variance_rad2 + seen.noise_rad2

    def _shared(self, seen: Heading) -> float:
        """Return C; somebody else may have told the filter its yaw since, and then it cannot be so large any more."""
        P, V = seen.yaw_variance_rad2, self.variance_rad2
        return max(self._covariance_rad2, -min(P, math.sqrt(P * V)))

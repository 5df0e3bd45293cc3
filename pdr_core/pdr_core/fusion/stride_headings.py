"""The headings of the latest strides of a foot, and whether they lie on a straight line (paper 004, eq. 5 and 7)."""

from collections import deque
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.maths.circular import circular_mean_rad, wrapped_rad
from pdr_core.records import StepEvent

STRIDES = 5  # eq. 7


class Straight(NamedTuple):
    """What is allowed on a straight line: the thresholds of eq. 7, which the paper does not give."""

    sd_rad: float  # of the headings
    turn_rad: float  # of the latest one from the mean of those before


class StrideHeadings:
    """Takes strides of one foot; a heading is the direction of the displacement (eq. 5), as if nobody had turned it."""

    def __init__(self, straight: Straight, shortest_m: float) -> None:
        self._straight = straight
        self._shortest_m = shortest_m
        self._headings_rad: deque[float] = deque(maxlen=STRIDES + 1)
        self._toes_rad: deque[float] = deque(maxlen=STRIDES + 1)
        self._starts_ns: deque[int] = deque(maxlen=STRIDES + 1)
        self._last_ns: int | None = None
        self._last_yaw_rad = 0.0

    def add(self, step: StepEvent, taken_rad: float) -> None:
        """Take a stride of a foot that has been turned back by so much. A short or a lost one breaks the line."""
        turned_rad = wrapped_rad(step.yaw_rad - self._last_yaw_rad) if step.start_ns == self._last_ns else 0.0
        if step.length_m < self._shortest_m or step.start_ns != self._last_ns:
            for column in (self._headings_rad, self._toes_rad, self._starts_ns):
                column.clear()
        if step.length_m >= self._shortest_m:
            self._headings_rad.append(step.heading_rad + taken_rad)
            self._toes_rad.append(step.yaw_rad - 0.5 * turned_rad - step.heading_rad)
            self._starts_ns.append(step.start_ns)
        self._last_ns, self._last_yaw_rad = step.stamp_ns, step.yaw_rad

    def __len__(self) -> int:
        """Return how many there are, six at most."""
        return len(self._headings_rad)

    @property
    def straight(self) -> bool:
        """The strides go straight (eq. 7): their spread is small, and the latest has the direction of those before."""
        if len(self._headings_rad) <= STRIDES:
            return False
        *before, latest = self._headings_rad
        turned_rad = wrapped_rad(latest - circular_mean_rad(before))
        spread_rad = np.sqrt(self.variance_rad2)
        return bool(spread_rad <= self._straight.sd_rad and abs(turned_rad) <= self._straight.turn_rad)

    @property
    def variance_rad2(self) -> float:
        """How much the headings differ."""
        mean_rad = self.mean_rad()
        return float(np.sum([wrapped_rad(h - mean_rad) ** 2 for h in self._headings_rad])) / STRIDES

    def mean_rad(self, latest: int = STRIDES + 1) -> float:
        """Return the mean heading of the latest strides."""
        return circular_mean_rad(list(self._headings_rad)[-latest:])

    @property
    def duration_s(self) -> float:
        """From the start of the first of them to the end of the last."""
        return (self._last_ns - self._starts_ns[0]) / NANOSECONDS if self._last_ns and self._starts_ns else 0.0

    @property
    def toe_rad(self) -> float:
        """By how much the standing foot points to the left of where it goes."""
        return circular_mean_rad(self._toes_rad)


def walking_direction_rad(headings_rad: Sequence[float]) -> float:
    """Return the mean of the headings of both feet (eq. 6, which prints the mean of their errors alone)."""
    return circular_mean_rad(headings_rad)

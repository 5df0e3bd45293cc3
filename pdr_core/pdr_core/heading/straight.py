"""The straight-walk test (Gui eq. 10), with differences of headings that begin anew at 180 degrees."""

from collections import deque

import numpy as np

from pdr_core.maths.circular import circular_mean_rad, wrapped_rad


class LastStrides:
    """The headings of the last few strides."""

    def __init__(self, strides: int, straight_max_rad: float) -> None:
        self.headings_rad: deque[float] = deque(maxlen=strides)
        self._straight_max_rad = straight_max_rad

    def add(self, heading_rad: float) -> None:
        """Take the heading of the next stride."""
        self.headings_rad.append(heading_rad)

    def turn(self, angle_rad: float) -> None:
        """Turn all of them, as the filter turns its track."""
        for i, heading_rad in enumerate(self.headings_rad):
            self.headings_rad[i] = heading_rad + angle_rad

    def clear(self) -> None:
        """Forget them."""
        self.headings_rad.clear()

    @property
    def mean_rad(self) -> float:
        """Their mean."""
        return circular_mean_rad(self.headings_rad)

    @property
    def deviations_rad(self) -> list[float]:
        """By how much each is turned from their mean."""
        mean_rad = self.mean_rad
        return [wrapped_rad(heading_rad - mean_rad) for heading_rad in self.headings_rad]

    @property
    def largest_deviation_rad(self) -> float:
        """The largest of these, without its sign."""
        return float(np.max(np.abs(self.deviations_rad)))

    @property
    def straight(self) -> bool:
        """There are enough of them, and none is turned too far from their mean (Gui eq. 10)."""
        enough = len(self.headings_rad) == self.headings_rad.maxlen
        return enough and self.largest_deviation_rad < self._straight_max_rad

"""Which foot is the left one: in a walked turn the outer foot goes farther.

Where a foot is beside the other one, inertial navigation cannot know: each filter begins at an origin of its own. But
feet that are w apart go, while the body turns by a, ways that differ by w a: in a turn to the left the right foot's
strides are longer. So the length of strides, the right one's minus the left one's, has the slope +w over the turn
within them; where the sensors are swapped, -w. The slope is the least-squares one through the origin, its deviation
follows from the residuals.

The strides of both feet lie half a stride apart. What is compared with one stride is the mean of the other foot's two
that enclose it, so a person who speeds up evenly tells nothing.
"""

import math
from collections import deque
from collections.abc import Sequence

from pdr_core.maths.circular import wrapped_rad
from pdr_core.records import StepEvent

TURN_MAX_RAD = 1.2  # of a stride: on the spot feet do not go on arcs
TURNED_RAD2 = 1.0  # the squares of the turns of the strides add up to this before anything is said: two corners
SURE = 4.0  # deviations


class Sides:
    """Takes the steps of a left and a right foot, in this order of names, and tells whether they are swapped."""

    def __init__(self, feet: Sequence[str]) -> None:
        self._left = feet[0]
        self._strides: dict[str, deque[StepEvent]] = {foot: deque(maxlen=3) for foot in feet}
        self._turns_rad2 = 0.0
        self._products = 0.0
        self._lengths_m2 = 0.0
        self._count = 0

    def take(self, foot: str, step: StepEvent) -> None:
        """Take a step."""
        mine = self._strides[foot]
        if mine and step.start_ns != mine[-1].stamp_ns:
            mine.clear()
        mine.append(step)
        other = next(strides for name, strides in self._strides.items() if name != foot)
        if len(mine) == 3 and len(other) >= 2 and mine[1].stamp_ns < other[-1].stamp_ns <= step.stamp_ns:
            self._compare(foot, list(mine), list(other))

    def _compare(self, foot: str, mine: list[StepEvent], other: list[StepEvent]) -> None:
        turn_rad = 0.5 * wrapped_rad(other[-1].yaw_rad - other[-2].yaw_rad)
        turn_rad += 0.25 * (
            wrapped_rad(mine[2].yaw_rad - mine[1].yaw_rad) + wrapped_rad(mine[1].yaw_rad - mine[0].yaw_rad)
        )
        if abs(turn_rad) > TURN_MAX_RAD:
            return
        longer_m = 0.5 * (mine[1].length_m + mine[2].length_m) - other[-1].length_m
        right_longer_m = -longer_m if foot == self._left else longer_m
        self._turns_rad2 += turn_rad**2
        self._products += turn_rad * right_longer_m
        self._lengths_m2 += right_longer_m**2
        self._count += 1

    @property
    def width_m(self) -> float:
        """The slope: distance of the feet, negative where they are swapped; 0: nothing is known."""
        return self._products / self._turns_rad2 if self._turns_rad2 > 0.0 else 0.0

    @property
    def swapped(self) -> bool:
        """The sensor that is called the left one is on the right foot."""
        if self._turns_rad2 < TURNED_RAD2:
            return False
        residual_m2 = self._lengths_m2 - self.width_m * self._products
        sd_m = math.sqrt(max(residual_m2, 0.0) / max(self._count - 1, 1) / self._turns_rad2)
        return self.width_m < -SURE * sd_m

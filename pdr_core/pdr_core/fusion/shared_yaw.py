"""What a foot may take of a correction that both feet share, as the measurement that a Kalman filter wants.

The two feet compare each other: that tells by how much they differ, and nothing of what both have in common. So of its
yaw variance P a foot keeps C, the common half of all that has come in, and T = C + D is what remains, D being the
variance of half the difference. A filter that took the same correction as an independent measurement at every stride
would forget C and grow certain. What it must be told to turn by d, and to keep T, is the equivalent measurement

    y = d P / (P - T),      R = P T / (P - T):      its gain P / (P + R) = 1 - T / P gives d, and leaves T.

Between two corrections P grows from T by what is new, half of which is common again.
"""

from typing import NamedTuple

LEAST_GAIN = 1e-3


class Equivalent(NamedTuple):
    """An independent measurement of a turn."""

    turn_rad: float
    variance_rad2: float


class SharedYaw:
    """Keeps the books of one foot."""

    def __init__(self) -> None:
        self._common_rad2 = 0.0
        self._left_rad2 = 0.0

    def equivalent(self, turn_rad: float, difference_rad2: float, yaw_rad2: float) -> Equivalent | None:
        """Return what makes a filter with the yaw variance `yaw_rad2` turn back by `turn_rad`; None: it cannot yet."""
        new_rad2 = yaw_rad2 - self._left_rad2
        common_rad2 = self._common_rad2 + 0.5 * new_rad2
        if new_rad2 < 0.0:  # somebody else has told it more
            common_rad2 = self._common_rad2 * yaw_rad2 / self._left_rad2
        left_rad2 = common_rad2 + difference_rad2
        gain = 1.0 - left_rad2 / yaw_rad2 if yaw_rad2 > 0.0 else 0.0
        if gain < LEAST_GAIN:
            return None
        self._common_rad2, self._left_rad2 = common_rad2, left_rad2
        return Equivalent(turn_rad / gain, left_rad2 / gain)

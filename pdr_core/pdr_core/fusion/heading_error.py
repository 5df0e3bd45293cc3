"""The heading error of one foot between its strides: paper 004, eq. 8-11, four states.

The states are errors, estimated minus true: where the foot is along x and y of its world [m], by how much its track is
turned, counter-clockwise [rad], and how fast that grows [rad/s]. A stride of the length SL whose estimated direction is
h goes, with the heading error e, to p + SL (cos h, sin h) where p' + SL (cos(h - e), sin(h - e)) is right (eq. 8). So
the position error grows by SL (cos h - cos(h - e), sin h - sin(h - e)), whose derivative at e = 0 is

    SL (-sin h, cos h) = (-dy, dx),

the displacement turned by a right angle: the third column of the transition (eq. 10). The paper expands it into
products of sines and cosines at h + e, where the estimate already is; the tests compare ours with finite differences.
The drift turns the foot after the stride, as the paper has it. Eq. 11 calls the sigma of its noise a variance and
squares it: it is a deviation.

The measurement, on a straight line, is the heading minus the walking direction, H = (0, 0, 1, 0).
"""

import numpy as np

from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.kalman import correct, estimated_error, gain, innovation
from pdr_core.records import Floats

X, Y, TURN, DRIFT, SIZE = 0, 1, 2, 3, 4
H = np.eye(SIZE)[TURN : TURN + 1]


def transition(displacement_m: Floats, duration_s: float) -> Floats:
    """Return F (4, 4) of a stride with the estimated displacement (2,) or (3,) (eq. 10)."""
    F = np.eye(SIZE)
    F[X, TURN], F[Y, TURN] = -displacement_m[1], displacement_m[0]
    F[TURN, DRIFT] = duration_s
    return F


class HeadingError:
    """The four errors and their covariance."""

    def __init__(self, turn_rad: float, variance_rad2: float, drift_sd_radps: float, noise_sd_rad: float) -> None:
        """Begin with a measured turn; `noise_sd_rad` is what a stride adds to it (eq. 11)."""
        self.error = np.array([0.0, 0.0, turn_rad, 0.0])
        self.P = np.diag([0.0, 0.0, variance_rad2, drift_sd_radps**2])
        self._noise_rad2 = noise_sd_rad**2

    @property
    def turn_rad(self) -> float:
        """By how much the track is turned, counter-clockwise."""
        return float(self.error[TURN])

    def turn_before(self, time_s: float) -> tuple[float, float]:
        """Return the turn so long ago, had the drift been the same since, and its variance."""
        back = np.array([0.0, 0.0, 1.0, -time_s])
        return float(back @ self.error), float(back @ self.P @ back)

    @property
    def turn_variance_rad2(self) -> float:
        """How well that is known."""
        return float(self.P[TURN, TURN])

    def predict(self, displacement_m: Floats, duration_s: float) -> None:
        """Go on by a stride."""
        F = transition(displacement_m, duration_s)
        self.error = F @ self.error
        self.P = F @ self.P @ F.T
        self.P[TURN, TURN] += self._noise_rad2

    def measure(self, turn_rad: float, variance_rad2: float) -> None:
        """Take a heading minus the walking direction, of which half turns are not known."""
        residual = np.array([wrapped_rad(turn_rad - self.turn_rad, np.pi)])
        y = innovation(self.P, H, np.eye(1) * variance_rad2, residual)
        K = gain(y)
        self.error = self.error + estimated_error(K, y)
        correct(self.P, K, y)

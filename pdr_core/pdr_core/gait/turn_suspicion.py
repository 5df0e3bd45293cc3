"""Does the person turn? What the accelerometer says of it with the gyro off.

In axes that turn with the foot (rate w) its velocity v obeys dv/dt = a - w x v, and v is zero at both ends of a swing.
Of the axis across the walk, with u up and f ahead, that leaves

    integral of a_across dt = integral of (w_u v_f - w_f v_u) dt.

The first term is the turn times about the speed of the swing: to turn left, a foot that swings ahead must be pushed to
the left, as its own axes see it. The second term and the gravity that a rolling foot feels are a person's habit, much
the same in every stride. So the impulse across the walk is a straight line over the turn,

    turn = offset + slope * impulse + noise,

and a person's line is learnt while the gyro is on: recursive least squares from a prior that real walks gave. The
offset changes its sign from foot to foot, so its prior is zero. Of the swing counts the first part: at its end the
shock of the heel says nothing but noise.

What was tried besides and is of no use, or of none everywhere (measured on real walks, see docs): the leaning of a
standing foot, the duration of a stride, its largest and mean acceleration, the impulses ahead and up; and the field,
whose azimuth, strength and dip change from stance to stance indoors as much by iron as by turns.
"""

from math import cos, hypot, isfinite, pi, sin

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.params import DeadReckoningParams
from pdr_core.records import Floats
from pdr_core.records_gait import Angle

SLOPE, SLOPE_SD = 0.5, 0.2  # [rad per m/s] leave-one-out over real walks: 0.45 to 0.62
OFFSET_SD_RAD = 0.3  # left and right alike: 0.16 to 0.44 m/s times the slope
PRIOR_STRIDES = 4.0  # that the noise given by the parameters counts for


def across_mps(impulse_mps: Floats, deviation_rad: float) -> float:
    """Return the part of an impulse (2,), ahead and left of the foot, that points left of the walking direction."""
    return float(impulse_mps[1]) * cos(deviation_rad) - float(impulse_mps[0]) * sin(deviation_rad)


class TurnSuspicion:
    """Learns with the gyro on how a person turns; with the gyro off it tells the turn, badly, and suspects one."""

    def __init__(self, params: DeadReckoningParams) -> None:
        self._suspicion_rad = params.suspicion_rad
        self._sd_share = params.turn_sd_share
        self._held = Angle(0.0, params.held_turn_sd_rad)
        self._line = np.array([0.0, SLOPE])
        self._P = np.diag([OFFSET_SD_RAD, SLOPE_SD]) ** 2 / params.turn_sd_rad**2  # in units of the noise
        self._squares, self._strides = PRIOR_STRIDES * params.turn_sd_rad**2, PRIOR_STRIDES

    def learn(self, across_mps: float, turn_rad: float) -> None:
        """Take a stride whose turn the gyro has shown; `across_mps` is its impulse, see `across_mps`."""
        if not isfinite(across_mps + turn_rad):
            return
        x, noise = np.array([1.0, across_mps]), self._squares / self._strides
        told_rad = float(x @ self._line)
        spread = 1.0 + (self._sd_share * told_rad) ** 2 / noise + float(x @ self._P @ x)
        residual = turn_rad - told_rad
        self._squares += residual**2 / spread
        self._strides += 1.0
        K = self._P @ x / spread
        self._line = self._line + K * residual
        self._P = self._P - np.outer(K, K) * spread

    def turn(self, across_mps: float | None) -> Angle:
        """Return by how much the foot has turned in a stride, left is positive; None: nobody knows its impulse."""
        if across_mps is None or not isfinite(across_mps):
            return self._held
        turn_rad, sd_rad = told(across_mps, self._line, self._P, self._squares / self._strides)
        return Angle(turn_rad, min(hypot(sd_rad, self._sd_share * turn_rad), pi))

    def suspected(self, across_mps: float | None) -> bool:
        """Return whether the foot turns, or may turn for all that is known."""
        return across_mps is None or not isfinite(across_mps) or abs(self.turn(across_mps).rad) > self._suspicion_rad


@compiled
def told(across_mps: float, line: Floats, P: Floats, noise: float) -> tuple[float, float]:
    """Return the turn that a line tells, and its deviation with the covariance P (2, 2) in units of the noise."""
    spread = 1.0 + P[0, 0] + across_mps * (P[0, 1] + P[1, 0]) + across_mps**2 * P[1, 1]
    return line[0] + across_mps * line[1], np.sqrt(noise * spread)

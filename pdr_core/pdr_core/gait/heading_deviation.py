"""Heading deviation: the angle from where a foot points to where its person walks (Zhou section 3, eq. 16-21).

Zhou's x = (rate of the deviation, deviation) with the observation direction - heading. What is different here:

- Zhou names north-east-down axes, but his eq. 14 and 20 have x east. Here directions count counter-clockwise from x of
  ENU, and both arctangents have four quadrants, atan2(y, x): people wear sensors back to front.
- eq. 21 takes the largest velocity of each axis by itself. The two are not of one moment, and of a walk to the south
  or west they are those of the wrong moments. Here it is the velocity at the moment of the largest speed.
- Section 5 cites eq. 16 and 17 where it means eq. 20 and 21.
- Zhou takes the heading where the foot hits the ground, after the stride. But a turn is walked along an arc: the
  stride is its chord, which points half-way between the headings before and after. Taken after the stride, a turn
  by 60 deg shows a deviation 30 deg off (measured on real walks: rms 10 to 19 deg, half-way 6 to 10).
- The error of the filter's yaw turns track and foot alike, so the difference does not have it: of the direction's
  variance remains what the yaw does not explain, var(direction) - var(yaw). Adding both would count it twice.
- Time is that which is walked in the behaviour. A gait does not change while its person stands.
"""

from math import atan2, cos, hypot, isfinite, pi, sin

import numpy as np

from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.quaternion import matrix
from pdr_core.params import DeadReckoningParams
from pdr_core.records import Floats, NavBlock, StepEvent
from pdr_core.records_gait import Angle, Behaviour

UNKNOWN = Angle(0.0, pi)


def direction_of_displacement(step: StepEvent) -> Angle:
    """Return where a stride goes, counter-clockwise from x (Zhou eq. 20)."""
    return Angle(step.heading_rad, step.heading_sd_rad)


def direction_of_velocity(nav: NavBlock) -> Angle:
    """Return where a foot goes at its largest level speed in a stride, counter-clockwise from x (Zhou eq. 21).

    `nav` holds the estimates of the stride; UNKNOWN where the foot never moves.
    """
    R = np.array([matrix(quat_xyzw) for quat_xyzw in nav.quat_xyzw]).reshape(-1, 3, 3)
    velocity_mps = np.einsum("nij,nj->ni", R, nav.velocity_mps)
    speed_mps = np.hypot(velocity_mps[:, 0], velocity_mps[:, 1])
    if not np.nanmax(speed_mps, initial=0.0) > 0.0:
        return UNKNOWN
    i = int(np.nanargmax(speed_mps))
    heading_rad = atan2(velocity_mps[i, 1], velocity_mps[i, 0])
    covariance = R[i] @ nav.twist_covariance[i, :3, :3] @ R[i].T
    across = np.array([-sin(heading_rad), cos(heading_rad), 0.0])
    sd_rad = float(np.sqrt(max(across @ covariance @ across, 0.0))) / float(speed_mps[i])
    return Angle(heading_rad, min(pi, hypot(sd_rad, float(np.sqrt(nav.pose_covariance[i, 5, 5])))))


def chord_rad(yaw_before_rad: float, yaw_after_rad: float) -> float:
    """Return the heading half-way through a turn, which is that of the stride."""
    return wrapped_rad(yaw_before_rad + 0.5 * wrapped_rad(yaw_after_rad - yaw_before_rad))


class HeadingDeviation:
    """Learns one deviation for each behaviour, while the gyro is on."""

    def __init__(self, params: DeadReckoningParams) -> None:
        self._params = params
        self._filters: dict[Behaviour, DeviationFilter] = {}

    def learn(
        self,
        behaviour: Behaviour,
        step: StepEvent,
        yaw_before_rad: float,
        yaw_after: Angle,
        direction: Angle | None = None,
    ) -> None:
        """Take a stride: the yaw of the foot where it has hit the ground before and after it.

        `direction` is where it goes; None: as its displacement shows (Zhou prefers it too). What is no number, or too
        short to have a direction, tells nothing.
        """
        p, (seen_rad, seen_sd_rad) = self._params, direction or direction_of_displacement(step)
        turn_rad = wrapped_rad(yaw_after.rad - yaw_before_rad)
        own = max(seen_sd_rad**2 - yaw_after.sd_rad**2, 0.0)  # what the yaw's error does not explain
        variance = own + p.deviation_scatter_rad**2 + (p.turn_scatter * turn_rad) ** 2
        deviation_rad = wrapped_rad(seen_rad - chord_rad(yaw_before_rad, yaw_after.rad))
        if isfinite(deviation_rad + variance) and step.length_m >= p.deviation_shortest_m:
            duration_s = max(0.0, (step.stamp_ns - step.start_ns) * 1e-9)
            self._filters.setdefault(behaviour, DeviationFilter(p)).learn(duration_s, deviation_rad, variance)

    def deviation(self, behaviour: Behaviour) -> Angle:
        """Return the walking direction minus the heading of the foot (Zhou eq. 16); UNKNOWN if nothing told it."""
        known = self._filters.get(behaviour)
        return known.deviation if known else UNKNOWN


class DeviationFilter:
    """The linear Kalman filter of one behaviour: x = (rate [rad/s], deviation [rad]) (Zhou eq. 17-19)."""

    def __init__(self, params: DeadReckoningParams) -> None:
        self._walks = np.array([params.deviation_rate_walk_radps, params.deviation_walk_rad]) ** 2
        self._gate = params.deviation_gate
        self.x: Floats = np.zeros(2)
        self.P: Floats = np.diag([params.deviation_rate_walk_radps**2, pi**2])
        self.deviation = UNKNOWN

    def learn(self, duration_s: float, deviation_rad: float, variance: float) -> None:
        """Predict over a stride (eq. 18) and take its observation (eq. 19, H = [0 1]).

        A sidestep does not count as a stride ahead: beyond the gate the noise grows so that it stays there (Huber).
        """
        transition = np.array([[1.0, 0.0], [duration_s, 1.0]])
        self.x = transition @ self.x
        self.P = transition @ self.P @ transition.T + np.diag(self._walks * duration_s)
        residual = wrapped_rad(deviation_rad - self.x[1])
        variance = max(variance, residual**2 / self._gate - self.P[1, 1])
        K = self.P[:, 1] / (self.P[1, 1] + variance)
        I_KH = np.eye(2) - np.outer(K, [0.0, 1.0])
        self.x = self.x + K * residual
        self.P = I_KH @ self.P @ I_KH.T + variance * np.outer(K, K)
        self.deviation = Angle(wrapped_rad(self.x[1]), min(pi, float(np.sqrt(self.P[1, 1]))))

"""Strides as people make them: how long each part takes, how far and how high the foot goes, how far it tips.

The figures are round ones from real walks: foot rates of 6 to 10 rad/s and accelerations of 30 to 60 m/s^2 in walking.
"""

from dataclasses import dataclass, replace

from pdr_core.records_gait import Behaviour

STATURE_M = 1.75  # of the person whose strides the gaits below are


@dataclass(frozen=True)
class Gait:
    """One way of making a stride. It begins and ends with the foot flat on the ground."""

    length_m: float
    heel_off_s: float  # the heel rises, the contact stands
    swing_s: float  # from toe-off to heel strike
    strike_s: float  # from heel strike to foot flat, the contact stands
    flat_s: float  # the foot is still
    lift_m: float  # above the higher of both contacts
    push_pitch_rad: float  # largest, after toe-off: heel up
    strike_pitch_rad: float  # smallest, before the strike; negative: toe up
    behaviour: Behaviour = Behaviour.WALKING
    reach_m: float = 0.0  # how far ahead of the straight way it is in mid-swing

    def paced(self, factor: float) -> "Gait":
        """Return the same gait at `factor` times the speed: strides longer and times shorter by its root."""
        root = factor**0.5
        return replace(
            self,
            length_m=self.length_m * root,
            heel_off_s=self.heel_off_s / root,
            swing_s=self.swing_s / root,
            strike_s=self.strike_s / root,
            flat_s=self.flat_s / root,
        )

    def of_stature(self, stature_m: float) -> "Gait":
        """Return how a person of that stature makes it: lengths go with it, times with its root (Alexander 1976)."""
        scale = stature_m / STATURE_M
        sized = replace(self, length_m=self.length_m * scale, lift_m=self.lift_m * scale, reach_m=self.reach_m * scale)
        return sized._in_time(scale**0.5)

    def _in_time(self, share: float) -> "Gait":
        return replace(
            self,
            heel_off_s=self.heel_off_s * share,
            swing_s=self.swing_s * share,
            strike_s=self.strike_s * share,
            flat_s=self.flat_s * share,
        )

    @property
    def duration_s(self) -> float:
        """How long a stride takes."""
        return self.heel_off_s + self.swing_s + self.strike_s + self.flat_s

    def with_double_support(self, share: float) -> "Gait":
        """Return the same gait with both feet on the ground for a share of the stride; a run stays what it is.

        Each foot stands while the other swings and twice half of the share beside: (1 - share) / 2 is swing.
        """
        if self.swing_s > 0.5 * self.duration_s:
            return self
        swing_s = 0.5 * (1.0 - share) * self.duration_s
        return replace(self, swing_s=swing_s, flat_s=self.flat_s + self.swing_s - swing_s)


WALK = Gait(1.4, 0.18, 0.50, 0.12, 0.28, 0.12, 0.90, -0.35)  # 1.3 m/s
STROLL = Gait(0.87, 0.20, 0.50, 0.13, 0.37, 0.10, 0.65, -0.25)  # 0.7 m/s, in a room
RUN = Gait(2.25, 0.11, 0.55, 0.07, 0.02, 0.25, 1.20, -0.20, Behaviour.RUNNING)  # 3 m/s; at twice the speed a sprint
SHUFFLE = Gait(0.4, 0.15, 0.40, 0.10, 0.35, 0.03, 0.20, -0.05)
STAIRS_UP = Gait(0.56, 0.20, 0.55, 0.12, 0.33, 0.08, 0.60, -0.05)
STAIRS_DOWN = Gait(0.56, 0.20, 0.50, 0.12, 0.28, 0.08, 0.50, 0.20)  # comes down on the ball of the foot
SWING = Gait(
    0.0, 0.15, 1.40, 0.15, 0.0, 0.08, 0.30, -0.20, Behaviour.SWING, 0.10
)  # on the spot, as slow as a leg swings
RISE_M = 0.34  # of one foot on stairs: two steps


@dataclass(frozen=True)
class Stride:
    """One stride of one foot, and how long it stands afterwards beyond what its gait takes."""

    gait: Gait
    turn_rad: float = 0.0  # left is positive
    climb_m: float = 0.0
    pause_s: float = 0.0

    @property
    def duration_s(self) -> float:
        """How long it takes."""
        return self.gait.duration_s + self.pause_s

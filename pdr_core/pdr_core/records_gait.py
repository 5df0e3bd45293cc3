"""What the analysis of gait gives out: how the sensor sits on the foot, strides in figures, and what a person does."""

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

from pdr_core.records import Floats, StepEvent


@dataclass(frozen=True)
class Mounting:
    """How a sensor sits on a foot: the body's x points where the person walks, its z up while the foot is flat."""

    quat_xyzw: Floats  # (4,) body from foot: what the intake calls the foot's axes
    tilt_sd_rad: float
    yaw_sd_rad: float  # of the walking direction
    strides: int  # that tell it


CYCLE_POINTS = 101  # of a stride, one a percent of its duration, both ends included


@dataclass(frozen=True)
class Stride:
    """A step in the figures of gait analysis, see docs/gait.md; None: unknown."""

    step: StepEvent
    duration_s: float | None
    stance_s: float | None
    swing_s: float | None
    clearance_m: float | None  # largest height above the line between both stances
    turn_rad: float | None  # of the foot about the vertical since the stance before, left is positive
    heading_change_rad: float | None  # of the displacement since the stride before, left is positive
    toe_off_ns: int | None
    heel_strike_ns: int | None
    pitch_max_rad: float | None  # heel up is positive
    pitch_min_rad: float | None
    pitch_cycle_rad: Floats | None  # (CYCLE_POINTS,) from the beginning of the stride to its end

    @property
    def speed_mps(self) -> float | None:
        """Horizontal length by duration."""
        return self.step.length_m / self.duration_s if self.duration_s else None

    @property
    def cadence_per_min(self) -> float | None:
        """Steps of both feet a minute: two a stride."""
        return 120.0 / self.duration_s if self.duration_s else None


class Behaviour(Enum):
    """What the foot does; the values are those of pdr_msgs/StepEvent."""

    UNKNOWN = 0
    STANDING = 1
    SWING = 2  # it moves without walking
    WALKING = 3
    RUNNING = 4


@dataclass(frozen=True)
class GaitStep:
    """One stride of one foot as its accelerometer alone shows it: from a ground hit to the next.

    Two steps of a person. The accelerations are those of |a| - g over that time, with the low-passed specific force a
    and g that of the standing foot. A stride from standing begins where one would that stands as usual before it moves.
    """

    index: int  # 1, 2, 3 ...
    start_ns: int
    stamp_ns: int  # of the ground hit that ends it
    behaviour: Behaviour
    frequency_hz: float  # strides a second of this foot
    accel_mean_mps2: float
    accel_max_mps2: float
    accel_min_mps2: float
    accel_mean_abs_mps2: float  # mean of the absolute value


class Angle(NamedTuple):
    """An angle and how well it is known."""

    rad: float
    sd_rad: float


class FieldHeading(NamedTuple):
    """The yaw of a standing foot by its magnetic field."""

    rad: float
    sd_rad: float  # by which places differ
    common_sd_rad: float  # by which they are off together

"""What the analysis of gait gives out: how the sensor sits on the foot, and strides in figures."""

from dataclasses import dataclass

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

"""The true motion of a foot, whatever moves it, and what a course must offer."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.spatial.transform import Rotation

from pdr_core.records import Flags, Floats


@dataclass(frozen=True)
class Motion:
    """The motion of the sensor's place on the foot at n times, with exact derivatives."""

    position_m: Floats  # (n, 3) world frame
    velocity_mps: Floats  # (n, 3) world frame
    acceleration_mps2: Floats  # (n, 3) world frame, without gravity
    quat_xyzw: Floats  # (n, 4) world from foot
    rate_radps: Floats  # (n, 3) foot frame, relative to the world frame
    stance: Flags  # (n,) the contact stands: it neither slides nor lifts, but the foot may rock about it

    @property
    def still(self) -> Flags:
        """Where the foot neither moves nor turns, (n,): the part of stance of which zero velocity is exactly true."""
        moving = (self.velocity_mps, self.acceleration_mps2, self.rate_radps)
        return self.stance & ~np.any([column.any(axis=1) for column in moving], axis=0)


class Course(Protocol):
    """A motion that can be asked for any time."""

    @property
    def duration_s(self) -> float:
        """How long it takes, the rest at both ends included."""

    @property
    def strikes_s(self) -> Floats:
        """When the foot comes down, (strides,)."""

    def at(self, time_s: Floats) -> Motion:
        """Return the motion at ascending times (n,)."""


def attitude(euler_rad: Floats, euler_rate_radps: Floats) -> tuple[Floats, Floats]:
    """Return the quaternions world from foot (n, 4) and the rates in the foot frame (n, 3).

    The angles (n, 3) are roll, pitch, yaw about the fixed axes x, y, z (REP-103), as the mounting of the intake.
    """
    roll, pitch = euler_rad[:, 0], euler_rad[:, 1]
    roll_rate, pitch_rate, yaw_rate = euler_rate_radps.T
    rate_radps = np.column_stack(
        [
            roll_rate - yaw_rate * np.sin(pitch),
            pitch_rate * np.cos(roll) + yaw_rate * np.cos(pitch) * np.sin(roll),
            yaw_rate * np.cos(pitch) * np.cos(roll) - pitch_rate * np.sin(roll),
        ]
    )
    return Rotation.from_euler("xyz", euler_rad).as_quat(), rate_radps


def thinned(motion: Motion, every: int) -> Motion:
    """Return the first of every so many rows of a motion."""
    return Motion(*(getattr(motion, name)[::every] for name in motion.__dataclass_fields__))

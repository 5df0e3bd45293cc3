"""The motion of a foot after Gui section 5.1, eq. 27-30, with its exact derivatives.

Gui writes it for right-front-up axes and a heading clockwise from north; here the axes are forward-left-up and the yaw
is counter-clockwise from x. His pitch angle lifts the toe, so it turns the other way round the left axis. The
horizontal acceleration of eq. 28 jumps at toe-off and at heel strike; that is kept as printed. At the very instant of
a jump a sample is the mean of both sides, as any sensor with a symmetric filter gives, and it counts as swing.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdr_core.conventions import stamp_ns_from_seconds
from pdr_core.records import Floats
from pdr_core.simulation.motion import Motion, attitude

STEP_LENGTH_M = 1.2  # l_s, Table 1
STEP_HEIGHT_M = 0.15  # l_h
SWING_S = 1.0  # t_sw
STANCE_S = 0.5  # t_st
MAX_PITCH_RAD = 0.6  # theta_max
TURN_S = 0.5  # t_c


@dataclass(frozen=True)
class Phase:
    """A piece of the motion: a stance, a swing forward, a turn on the spot, or both at once: a swing along an arc."""

    duration_s: float
    forward_m: float = 0.0
    turn_rad: float = 0.0

    @property
    def stance(self) -> bool:
        """The foot neither moves nor turns."""
        return self.forward_m == 0.0 and self.turn_rad == 0.0


def steps(count: int, length_m: float = STEP_LENGTH_M) -> list[Phase]:
    """Return the phases of a straight walk."""
    return step(length_m) * count


def step(length_m: float, turn_rad: float = 0.0) -> list[Phase]:
    """Return the phases of one step; with a turn it is walked along an arc, and `length_m` is its chord."""
    return [Phase(SWING_S, forward_m=length_m, turn_rad=turn_rad), Phase(STANCE_S)]


def turn(angle_rad: float) -> list[Phase]:
    """Return the phases of a turn on the spot (eq. 30 for any angle)."""
    return [Phase(TURN_S, turn_rad=angle_rad), Phase(STANCE_S)]


class GuiCourse:
    """A row of phases, which begins at the origin along x (eq. 27). In stance the foot is perfectly still."""

    def __init__(self, phases: list[Phase]) -> None:
        self._stance = np.array([p.stance for p in phases])
        self._duration_s = np.array([p.duration_s for p in phases])
        self._starts_s = np.concatenate([[0.0], np.cumsum(self._duration_s)])
        self._turn_rad = np.array([p.turn_rad for p in phases])
        self._yaw_rad = np.cumsum(self._turn_rad) - self._turn_rad
        forward_m = np.array([p.forward_m for p in phases])
        chord_rad = self._yaw_rad + 0.5 * self._turn_rad
        self._stride_m = forward_m[:, None] * np.column_stack([np.cos(chord_rad), np.sin(chord_rad)])
        self._place_m = np.cumsum(self._stride_m, axis=0) - self._stride_m
        self._swing = (forward_m != 0.0).astype(float)
        self.duration_s = float(self._starts_s[-1])
        self.strikes_s = self._starts_s[1:][forward_m != 0.0]

    def at(self, time_s: Floats) -> Motion:
        """Return the motion at ascending times (n,)."""
        before, after = self._phase_at(time_s, "left"), self._phase_at(time_s, "right")
        position_m, velocity_mps, acceleration_after = self._translation(time_s, after)
        acceleration_before = self._translation(time_s, before)[2]
        return Motion(
            position_m,
            velocity_mps,
            0.5 * (acceleration_before + acceleration_after),
            *self._rotation(time_s, after),
            self._stance[before] & self._stance[after],
        )

    def _phase_at(self, time_s: Floats, side: str) -> NDArray[np.intp]:
        """Return the phase just before ("left") or after ("right") each time; a joint is met to the nanosecond."""
        joints_ns, now_ns = stamp_ns_from_seconds(self._starts_s), stamp_ns_from_seconds(time_s)
        found = np.searchsorted(joints_ns, now_ns, side="left" if side == "left" else "right")
        return np.clip(found - 1, 0, len(self._stance) - 1)

    def _raised(self, time_s: Floats, phase: NDArray[np.intp], cycles: float) -> tuple[Floats, Floats, Floats]:
        share = np.clip((time_s - self._starts_s[phase]) / self._duration_s[phase], 0.0, 1.0)
        return raised(2.0 * np.pi * cycles * share, 2.0 * np.pi * cycles / self._duration_s[phase])

    def _translation(self, time_s: Floats, phase: NDArray[np.intp]) -> tuple[Floats, Floats, Floats]:
        """Return position, velocity and acceleration, (n, 3) (eq. 28)."""
        stride, height = self._stride_m[phase], STEP_HEIGHT_M * self._swing[phase]
        along, lift = self._raised(time_s, phase, 0.5), self._raised(time_s, phase, 1.0)
        moved = [np.column_stack([stride * a[:, None], height * z]) for a, z in zip(along, lift, strict=True)]
        moved[0][:, :2] += self._place_m[phase]
        return moved[0], moved[1], moved[2]

    def _rotation(self, time_s: Floats, phase: NDArray[np.intp]) -> tuple[Floats, Floats]:
        """Return attitude (n, 4) and rate (n, 3) (eq. 29-30)."""
        toe_up, angle = MAX_PITCH_RAD * self._swing[phase], self._turn_rad[phase]
        (turned, turned_rate, _), (lift, lift_rate, _) = (self._raised(time_s, phase, c) for c in (0.5, 1.0))
        euler_rad = np.column_stack([np.zeros(len(phase)), -toe_up * lift, self._yaw_rad[phase] + angle * turned])
        return attitude(euler_rad, np.column_stack([np.zeros(len(phase)), -toe_up * lift_rate, angle * turned_rate]))


def raised(phase_rad: Floats, rate_radps: Floats) -> tuple[Floats, Floats, Floats]:
    """Return (1 - cos(phase)) / 2 and its first two derivatives by time, (n,) each (eq. 28-30)."""
    return (
        0.5 * (1.0 - np.cos(phase_rad)),
        0.5 * rate_radps * np.sin(phase_rad),
        0.5 * rate_radps**2 * np.cos(phase_rad),
    )

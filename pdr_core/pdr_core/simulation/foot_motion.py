"""The true motion of a foot after Gui section 5.1, eq. 27-30, with its exact derivatives.

Gui writes it for right-front-up axes and a heading clockwise from north; here the axes are forward-left-up and the yaw
is counter-clockwise from x. His pitch angle lifts the toe, so it turns the other way round the left axis. The
horizontal acceleration of eq. 28 jumps at toe-off and at heel strike; that is kept as printed.
"""

from dataclasses import dataclass

import numpy as np

from pdr_core.records import Floats

STEP_LENGTH_M = 1.2  # l_s, Table 1
STEP_HEIGHT_M = 0.15  # l_h
SWING_S = 1.0  # t_sw
STANCE_S = 0.5  # t_st
MAX_PITCH_RAD = 0.6  # theta_max
TURN_S = 0.5  # t_c


@dataclass(frozen=True)
class Phase:
    """A piece of the motion: a stance, a swing forward or a turn on the spot."""

    duration_s: float
    forward_m: float = 0.0
    turn_rad: float = 0.0

    @property
    def stance(self) -> bool:
        """The foot neither moves nor turns."""
        return self.forward_m == 0.0 and self.turn_rad == 0.0


@dataclass(frozen=True)
class FootMotion:
    """The motion at n times: what the world sees and what a sensor on the foot feels."""

    position_m: Floats  # (n, 3)
    velocity_mps: Floats  # (n, 3)
    acceleration_mps2: Floats  # (n, 3) without gravity
    pitch_rad: Floats  # (n,) about the left axis
    yaw_rad: Floats  # (n,)
    pitch_rate_radps: Floats  # (n,)
    yaw_rate_radps: Floats  # (n,)
    stance: np.ndarray  # (n,) bool


def steps(count: int, length_m: float = STEP_LENGTH_M) -> list[Phase]:
    """Return the phases of a straight walk."""
    return [Phase(SWING_S, forward_m=length_m), Phase(STANCE_S)] * count


def turn(angle_rad: float) -> list[Phase]:
    """Return the phases of a turn on the spot (eq. 30 for any angle)."""
    return [Phase(TURN_S, turn_rad=angle_rad), Phase(STANCE_S)]


def move(phases: list[Phase], time_s: Floats) -> FootMotion:
    """Return the motion at ascending times (n,), which begins at the origin along x (eq. 27)."""
    starts = np.concatenate([[0.0], np.cumsum([p.duration_s for p in phases])])
    which = np.clip(np.searchsorted(starts, time_s, side="right") - 1, 0, len(phases) - 1)
    yaws = np.concatenate([[0.0], np.cumsum([p.turn_rad for p in phases])])
    strides = np.array([[p.forward_m * np.cos(y), p.forward_m * np.sin(y)] for p, y in zip(phases, yaws, strict=False)])
    places = np.concatenate([np.zeros((1, 2)), np.cumsum(strides, axis=0)])
    duration = np.array([p.duration_s for p in phases])[which]
    share = np.clip((time_s - starts[which]) / duration, 0.0, 1.0)
    swing = np.array([p.forward_m != 0.0 for p in phases])[which].astype(float)
    angle = np.array([p.turn_rad for p in phases])[which]
    rate = np.pi / duration
    lift, lift_rate, lift_accel = raised(2.0 * np.pi * share, 2.0 * rate)
    along, along_rate, along_accel = raised(np.pi * share, rate)
    return FootMotion(
        position_m=np.column_stack([places[which] + strides[which] * along[:, None], STEP_HEIGHT_M * swing * lift]),
        velocity_mps=np.column_stack([strides[which] * along_rate[:, None], STEP_HEIGHT_M * swing * lift_rate]),
        acceleration_mps2=np.column_stack([strides[which] * along_accel[:, None], STEP_HEIGHT_M * swing * lift_accel]),
        pitch_rad=-MAX_PITCH_RAD * swing * lift,
        yaw_rad=yaws[which] + angle * along,
        pitch_rate_radps=-MAX_PITCH_RAD * swing * lift_rate,
        yaw_rate_radps=angle * along_rate,
        stance=np.array([p.stance for p in phases])[which],
    )


def raised(phase_rad: Floats, rate_radps: Floats) -> tuple[Floats, Floats, Floats]:
    """Return (1 - cos(phase)) / 2 and its first two derivatives by time, (n,) each (eq. 28-30)."""
    return (
        0.5 * (1.0 - np.cos(phase_rad)),
        0.5 * rate_radps * np.sin(phase_rad),
        0.5 * rate_radps**2 * np.cos(phase_rad),
    )

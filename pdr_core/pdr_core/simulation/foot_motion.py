"""A smooth foot: heel strike, rocking stance, toe-off, walked turns, stairs.

In stance the sole rolls over the ground like a wheel of radius h whose hub is the sensor: the contact below the sensor
stands and the sensor moves by w x (0, 0, h) = (h w_y, -h w_x, 0), as real feet do. In swing the wheel is carried to
its next contact. So the place of the sensor is everywhere the wheel's footpoint plus h times the pitch along the
heading, and as smooth as both. `stance` is the time from heel strike to toe-off, in which the footpoint stands; the
foot is still only while it is flat. Yaw and roll change in swing alone: a person walks a turn, the foot does not pivot.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from pdr_core.records import Floats
from pdr_core.simulation.curve import Curve
from pdr_core.simulation.gait import Gait, Stride
from pdr_core.simulation.motion import Motion, attitude

SENSOR_HEIGHT_M = 0.08  # h, of the sensor above the contact
REST_S = 3.0  # standing still at both ends
PUSH_SHARE, DROP_SHARE = 0.15, 0.85  # of the swing, where the heel is highest and the toe: the foot leaves turning
SWING_ROLL_RAD = 0.1  # in mid-swing: the outer edge down


class Swings(NamedTuple):
    """How one foot gets from stand to stand; the contact below the sensor is what stands."""

    gaits: list[Gait]
    toe_off_s: Floats  # (swings,)
    stands: Floats  # (swings + 1, 4) x, y, z, yaw: before the first swing and after each
    bow_m: Floats  # (swings, 2) by how much it is beside the straight line in mid-swing, x and y
    duration_s: float  # of the whole walk, the rest at both ends included
    side: float = 1.0  # of the body: 1 left, -1 right


class SwungFoot:
    """A foot that is swung from stand to stand."""

    def __init__(self, swings: Swings) -> None:
        self._toe_off_s = swings.toe_off_s
        self.strikes_s = swings.toe_off_s + [g.swing_s for g in swings.gaits]
        self.duration_s = swings.duration_s
        self._travel = self._through(*travel(swings.stands, self._toe_off_s, self.strikes_s))
        self._lift = self._through(*lift(swings, self.strikes_s))
        self._pitch = self._through(*pitch(swings.gaits, self._toe_off_s))

    def _through(self, first: Floats, key_s: Floats, values: Floats) -> Curve:
        """Return the curve from (m,) values through (swings, k) times and (swings, k, m) values to the end."""
        rows = np.concatenate([first[None], values.reshape(-1, len(first))])
        return Curve(np.concatenate([[0.0], key_s.ravel(), [self.duration_s]]), np.concatenate([rows, rows[-1:]]))

    def at(self, time_s: Floats) -> Motion:
        """Return the motion at ascending times (n,)."""
        travel, lift, pitch = self._travel.at(time_s), self._lift.at(time_s), self._pitch.at(time_s)
        rolled = along_heading(travel, pitch)
        moved = [
            np.column_stack([t[:, :2] + r + z[:, 2:], z[:, 0]]) for t, r, z in zip(travel, rolled, lift, strict=True)
        ]
        euler = [np.column_stack([z[:, 1], p[:, 0], t[:, 2]]) for t, p, z in zip(travel, pitch, lift, strict=True)]
        swings = np.searchsorted(self._toe_off_s, time_s, side="right")
        landed = np.searchsorted(self.strikes_s, time_s, side="right")
        return Motion(moved[0], moved[1], moved[2], *attitude(euler[0], euler[1]), swings == landed)


class FootCourse(SwungFoot):
    """A row of strides of one foot, which begins at rest at the origin along x and ends at rest.

    `places` are where it stands, (strides + 1, 4), as `stands` returns them, if not just there.
    """

    def __init__(self, strides: list[Stride], places: Floats | None = None) -> None:
        duration_s = np.array([s.duration_s for s in strides])
        toe_off_s = REST_S + np.cumsum(duration_s) - duration_s + [s.gait.heel_off_s for s in strides]
        whole_s = 2.0 * REST_S + float(duration_s.sum())
        way = stands(strides)
        stood = way if places is None else places
        super().__init__(Swings([s.gait for s in strides], toe_off_s, stood, reaches_m(strides, way), whole_s))


def stands(strides: Sequence[Stride]) -> Floats:
    """Return x, y, z and yaw before the first stride and after each, (strides + 1, 4), from the origin along x.

    A turn is walked along an arc: the stride is its chord, half-way between the headings before and after.
    """
    turn_rad, length_m, climb_m = np.array([(s.turn_rad, s.gait.length_m, s.climb_m) for s in strides]).reshape(-1, 3).T
    course_rad = np.cumsum(turn_rad) - 0.5 * turn_rad
    change = np.column_stack([length_m * np.cos(course_rad), length_m * np.sin(course_rad), climb_m, turn_rad])
    return np.concatenate([np.zeros((1, 4)), np.cumsum(change, axis=0)])


def reaches_m(strides: Sequence[Stride], way: Floats) -> Floats:
    """Return how far ahead each swing reaches on its way (strides + 1, 4), in the plan, (strides, 2)."""
    reach_m, yaw_rad = np.array([s.gait.reach_m for s in strides]), way[1:, 3]
    return np.column_stack([reach_m * np.cos(yaw_rad), reach_m * np.sin(yaw_rad)])


Derivatives = tuple[Floats, Floats, Floats]  # a quantity at n times and its first two derivatives


def along_heading(travel: Derivatives, pitch: Derivatives) -> Derivatives:
    """Return h pitch (cos yaw, sin yaw), how far the wheel has rolled, and its derivatives, (n, 2) each."""
    u, du, ddu = (SENSOR_HEIGHT_M * p for p in pitch)
    yaw, rate, change = (t[:, 2:] for t in travel)
    ahead = np.column_stack([np.cos(yaw), np.sin(yaw)])
    left = np.column_stack([-np.sin(yaw), np.cos(yaw)])
    bent = (u * change + 2.0 * du * rate) * left
    return u * ahead, du * ahead + u * rate * left, (ddu - u * rate**2) * ahead + bent


def travel(stands: Floats, toe_off_s: Floats, strike_s: Floats) -> tuple[Floats, Floats, Floats]:
    """Return x, y, yaw at first, (3,), times (swings, 2) and values (swings, 2, 3): before and after each swing."""
    plan = stands[:, [0, 1, 3]]
    return plan[0], np.column_stack([toe_off_s, strike_s]), np.stack([plan[:-1], plan[1:]], axis=1)


def lift(swings: Swings, strike_s: Floats) -> tuple[Floats, Floats, Floats]:
    """Return what is highest in mid-swing: at first, (4,), times (swings, 3) and values (swings, 3, 4).

    It is height, roll and, in the plan, the bow; before, amid and after each swing.
    """
    before_m, after_m = swings.stands[:-1, 2], swings.stands[1:, 2]
    values = np.zeros((len(strike_s), 3, 4))
    values[:, 0, 0], values[:, 2, 0] = before_m, after_m
    values[:, 1, 0] = np.maximum(before_m, after_m) + [g.lift_m for g in swings.gaits]
    values[:, 1, 1] = swings.side * SWING_ROLL_RAD
    values[:, 1, 2:] = swings.bow_m
    key_s = np.column_stack([swings.toe_off_s, 0.5 * (swings.toe_off_s + strike_s), strike_s])
    return np.array([swings.stands[0, 2], 0.0, 0.0, 0.0]), key_s, values


def pitch(gaits: list[Gait], toe_off_s: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the pitch at first, (1,), times (swings, 4) and values (swings, 4, 1): heel-off, push, drop, foot flat."""
    heel_off, swing, strike = (np.array([getattr(g, n) for g in gaits]) for n in ("heel_off_s", "swing_s", "strike_s"))
    key_s = toe_off_s[:, None] + np.column_stack([-heel_off, PUSH_SHARE * swing, DROP_SHARE * swing, swing + strike])
    values = [(0.0, g.push_pitch_rad, g.strike_pitch_rad, 0.0) for g in gaits]
    return np.zeros(1), key_s, np.array(values, dtype=np.float64).reshape(-1, 4, 1)

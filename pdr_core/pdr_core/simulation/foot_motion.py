"""A smooth foot: heel strike, rocking stance, toe-off, walked turns, stairs.

In stance the sole rolls over the ground like a wheel of radius h whose hub is the sensor: the contact below the sensor
stands and the sensor moves by w x (0, 0, h) = (h w_y, -h w_x, 0), as real feet do. In swing the wheel is carried to
its next contact. So the place of the sensor is everywhere the wheel's footpoint plus h times the pitch along the
heading, and as smooth as both. `stance` is the time from heel strike to toe-off, in which the footpoint stands; the
foot is still only while it is flat. Yaw and roll change in swing alone: a person walks a turn, the foot does not pivot.
"""

import numpy as np

from pdr_core.records import Floats
from pdr_core.simulation.curve import Curve
from pdr_core.simulation.gait import Stride
from pdr_core.simulation.motion import Motion, attitude

SENSOR_HEIGHT_M = 0.08  # h, of the sensor above the contact
REST_S = 3.0  # standing still at both ends
PUSH_SHARE, DROP_SHARE = 0.15, 0.85  # of the swing, where the heel is highest and the toe: the foot leaves turning
SWING_ROLL_RAD = 0.1  # outward in mid-swing


class FootCourse:
    """A row of strides, which begins at rest at the origin along x and ends at rest."""

    def __init__(self, strides: list[Stride]) -> None:
        gaits = [s.gait for s in strides]
        duration_s = np.array([s.duration_s for s in strides])
        self._toe_off_s = REST_S + np.cumsum(duration_s) - duration_s + [g.heel_off_s for g in gaits]
        self.strikes_s = self._toe_off_s + [g.swing_s for g in gaits]
        self.duration_s = 2.0 * REST_S + float(duration_s.sum())
        self._travel = self._through(*travel(strides, self._toe_off_s, self.strikes_s))
        self._lift = self._through(*lift(strides, self._toe_off_s, self.strikes_s))
        self._pitch = self._through(*pitch(strides, self._toe_off_s))

    def _through(self, key_s: Floats, values: Floats) -> Curve:
        """Return the curve from zero through (strides, k) times and (strides, k, m) values to the end."""
        m = values.shape[2]
        rows = np.concatenate([np.zeros((1, m)), values.reshape(-1, m)])
        return Curve(np.concatenate([[0.0], key_s.ravel(), [self.duration_s]]), np.concatenate([rows, rows[-1:]]))

    def at(self, time_s: Floats) -> Motion:
        """Return the motion at ascending times (n,)."""
        travel, lift, pitch = self._travel.at(time_s), self._lift.at(time_s), self._pitch.at(time_s)
        rolled = along_heading(travel, pitch)
        moved = [np.column_stack([t[:, :2] + r, z[:, 0]]) for t, r, z in zip(travel, rolled, lift, strict=True)]
        euler = [np.column_stack([z[:, 1], p[:, 0], t[:, 2]]) for t, p, z in zip(travel, pitch, lift, strict=True)]
        swings = np.searchsorted(self._toe_off_s, time_s, side="right")
        landed = np.searchsorted(self.strikes_s, time_s, side="right")
        return Motion(moved[0], moved[1], moved[2], *attitude(euler[0], euler[1]), swings == landed)


Derivatives = tuple[Floats, Floats, Floats]  # a quantity at n times and its first two derivatives


def along_heading(travel: Derivatives, pitch: Derivatives) -> Derivatives:
    """Return h pitch (cos yaw, sin yaw), how far the wheel has rolled, and its derivatives, (n, 2) each."""
    u, du, ddu = (SENSOR_HEIGHT_M * p for p in pitch)
    yaw, rate, change = (t[:, 2:] for t in travel)
    ahead = np.column_stack([np.cos(yaw), np.sin(yaw)])
    left = np.column_stack([-np.sin(yaw), np.cos(yaw)])
    bent = (u * change + 2.0 * du * rate) * left
    return u * ahead, du * ahead + u * rate * left, (ddu - u * rate**2) * ahead + bent


def travel(strides: list[Stride], toe_off_s: Floats, strike_s: Floats) -> tuple[Floats, Floats]:
    """Return times (strides, 2) and values (strides, 2, 3): x, y and yaw before and after each swing.

    A turn is walked along an arc: the stride is its chord, half-way between the headings before and after.
    """
    turn_rad = np.array([s.turn_rad for s in strides])
    length_m = np.array([s.gait.length_m for s in strides])
    course_rad = np.cumsum(turn_rad) - 0.5 * turn_rad
    change = np.column_stack([length_m * np.cos(course_rad), length_m * np.sin(course_rad), turn_rad])
    after = np.cumsum(change, axis=0)
    before = np.concatenate([np.zeros((1, 3)), after])[:-1]
    return np.column_stack([toe_off_s, strike_s]), np.stack([before, after], axis=1)


def lift(strides: list[Stride], toe_off_s: Floats, strike_s: Floats) -> tuple[Floats, Floats]:
    """Return times (strides, 3) and values (strides, 3, 2): height and roll before, amid and after each swing."""
    after_m = np.cumsum([s.climb_m for s in strides])
    before_m = np.concatenate([[0.0], after_m])[:-1]
    top_m = np.maximum(before_m, after_m) + [s.gait.lift_m for s in strides]
    height_m = np.column_stack([before_m, top_m, after_m])
    roll_rad = np.zeros_like(height_m)
    roll_rad[:, 1] = SWING_ROLL_RAD
    return np.column_stack([toe_off_s, 0.5 * (toe_off_s + strike_s), strike_s]), np.stack([height_m, roll_rad], axis=2)


def pitch(strides: list[Stride], toe_off_s: Floats) -> tuple[Floats, Floats]:
    """Return times (strides, 4) and values (strides, 4, 1): the pitch at heel-off, push, drop and foot flat."""
    gaits = [s.gait for s in strides]
    heel_off, swing, strike = (np.array([getattr(g, n) for g in gaits]) for n in ("heel_off_s", "swing_s", "strike_s"))
    key_s = toe_off_s[:, None] + np.column_stack([-heel_off, PUSH_SHARE * swing, DROP_SHARE * swing, swing + strike])
    values = [(0.0, g.push_pitch_rad, g.strike_pitch_rad, 0.0) for g in gaits]
    return key_s, np.array(values, dtype=np.float64).reshape(-1, 4, 1)

"""The motion of a card on the chest: the body goes along its way, bounces, sways, surges, leans and swings, and stands.

x ahead, y left, z up. With p counting steps, whole at each footfall: the body is lowest and fastest at a footfall, so

    z = -bounce cos 2 pi p,    x = surge sin 2 pi p,    y = sway sin pi p

beside its way; pitch swings once a step, roll and yaw once a stride. All of it grows with the start and dies with the
stop. A standing body is never still: it sways about the ankles, and so it does while it walks.
"""

from itertools import pairwise

import numpy as np
from scipy.interpolate import CubicSpline

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.records import Floats
from pdr_core.simulation.chest_person import AHEAD_M, HEIGHT_M, LEAN_SHARE, Person
from pdr_core.simulation.chest_steps import RAMP_STEPS, TURN_S, Steps, Stretch, Timeline, footfalls_s, timeline
from pdr_core.simulation.curve import Curve
from pdr_core.simulation.jet import Jet, turned
from pdr_core.simulation.motion import Motion, attitude

TURN_SHARE = 0.5  # of the oscillation that is left in a turn on the spot


class ChestCourse:
    """A person who stands, walks and turns, from the origin along x."""

    def __init__(self, person: Person, parts: list[Stretch], seed: int) -> None:
        self._person = person
        self._line = timeline(person, parts, seed)
        self.duration_s = self._line.duration_s
        self.strikes_s = footfalls_s(self._line)
        self._size = curve(size_keys(self._line), self.duration_s)
        self._yaw = curve(yaw_keys(self._line), self.duration_s)

    def at(self, time_s: Floats) -> Motion:
        """Return the motion at ascending times (n,)."""
        phase, size, yaw = self._phase(time_s), one(self._size, time_s), one(self._yaw, time_s)
        x, y, z, lean = self._way(time_s)
        sway_roll, sway_pitch = self._standing(time_s)
        p = self._person
        ahead = size.times(phase.by(2.0 * np.pi).sine()).by(p.surge_m).plus(sway_pitch.by(HEIGHT_M))
        left = size.times(phase.by(np.pi).sine()).by(p.sway_m).plus(sway_roll.by(-HEIGHT_M))
        ahead = Jet(ahead.value + AHEAD_M, ahead.rate, ahead.bend)
        beside_x, beside_y = turned(ahead, left, yaw)
        up = size.times(phase.by(2.0 * np.pi).cosine()).by(-p.bounce_m)
        moved = [x.plus(beside_x), y.plus(beside_y), z.plus(up)]
        euler = self._euler(phase, size, yaw, lean, sway_roll, sway_pitch)
        values, rates, bends = (np.column_stack(c) for c in zip(*moved, strict=True))
        first_m = np.array([AHEAD_M, 0.0, 0.0])
        angles, angle_rates, _ = (np.column_stack(c) for c in zip(*euler, strict=True))
        standing = (size.value == 0.0) & (size.rate == 0.0)
        return Motion(values - first_m, rates, bends, *attitude(angles, angle_rates), standing)

    def _euler(self, phase: Jet, size: Jet, yaw: Jet, lean: Jet, sway_roll: Jet, sway_pitch: Jet) -> list[Jet]:
        p = self._person
        stride, step = phase.by(np.pi), phase.by(2.0 * np.pi)
        roll, pitch, twist = (
            size.times(angle.sine(shift)).by(swing)
            for angle, shift, swing in zip((stride, step, stride), p.phase_rad, p.swing_rad, strict=True)
        )
        upright = Jet(np.full_like(yaw.value, p.lean_rad), np.zeros_like(yaw.value), np.zeros_like(yaw.value))
        return [roll.plus(sway_roll), pitch.plus(sway_pitch).plus(lean).plus(upright), yaw.plus(twist)]

    def _phase(self, time_s: Floats) -> Jet:
        """Return the count of steps: smooth, and whole at each footfall; it rests where the person stands."""
        out = [np.zeros_like(time_s) for _ in range(3)]
        for start_s, key_s in phase_keys(self._line, self._person.step_s):
            spline = CubicSpline(key_s, np.arange(len(key_s)), bc_type="natural")
            now = (time_s >= start_s) & (time_s < start_s + key_s[-1])
            for k in range(3):
                out[k][now] = spline(time_s[now] - start_s, k)
        return Jet(*out)

    def _way(self, time_s: Floats) -> tuple[Jet, Jet, Jet, Jet]:
        """Return x, y and z of the way, and by how much the trunk leans into its acceleration."""
        x, y, lean = (np.zeros((4, len(time_s))) for _ in range(3))
        for start_s, walked, direction_rad in self._line.walks:
            along = progress(walked, time_s - start_s)
            x, y = x + np.cos(direction_rad) * along, y + np.sin(direction_rad) * along
            lean[:2] += along[2:] * LEAN_SHARE / STANDARD_GRAVITY_MPS2
        return Jet(*x[:3]), Jet(*y[:3]), Jet(*np.zeros((3, len(time_s)))), Jet(*lean[:3])

    def _standing(self, time_s: Floats) -> tuple[Jet, Jet]:
        p = self._person
        turns = 2.0 * np.pi * p.standing_hz
        angle = turns * time_s[:, None] + p.standing_phase_rad[:, None, :]
        s, c = np.sin(angle), np.cos(angle)
        roll, pitch = (Jet(s[i] @ a, c[i] @ (a * turns), -s[i] @ (a * turns**2)) for i, a in enumerate(p.standing_rad))
        return roll, pitch


def progress(walked: Steps, time_s: Floats) -> Floats:
    """Return how far a stretch is walked at n times since its start, and three derivatives, (4, n).

    Between two footfalls the speed changes by a septic smoothstep S (see `curve.py`), whose integral is 7 u^5 - 14 u^6
    + 10 u^7 - 2.5 u^8.
    """
    keys, speed = walked.time_s, walked.speed_mps
    i = np.clip(np.searchsorted(keys, time_s, side="right") - 1, 0, len(keys) - 2)
    span, change = (keys[1:] - keys[:-1])[i], (speed[1:] - speed[:-1])[i]
    u = np.clip((time_s - keys[i]) / span, 0.0, 1.0)
    done = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(keys))])
    far = done[i] + span * (speed[i] * u + change * u**5 * (7.0 + u * (-14.0 + u * (10.0 - 2.5 * u))))
    fast = speed[i] + change * u**4 * (35.0 + u * (-84.0 + u * (70.0 - 20.0 * u)))
    push = change * 140.0 * (u * (1.0 - u)) ** 3 / span
    jerk = change * 420.0 * (u * (1.0 - u)) ** 2 * (1.0 - 2.0 * u) / span**2
    return np.array([far, fast, push, jerk])


Keys = list[tuple[float, float]]  # time [s] and value


def size_keys(line: Timeline) -> Keys:
    """Return how large the gait's oscillation is: it grows and dies with a start and a stop."""
    keys: Keys = []
    for start_s, walked, _ in line.walks:
        ends_s = walked.time_s[[0, RAMP_STEPS, -1 - RAMP_STEPS, -1]] + start_s
        keys += zip(ends_s.tolist(), (0.0, 1.0, 1.0, 0.0), strict=True)
    for start_s, _, _ in line.turns:
        keys += [(start_s, 0.0), (start_s + 0.5 * TURN_S, TURN_SHARE), (start_s + TURN_S, 0.0)]
    return sorted(keys)


def yaw_keys(line: Timeline) -> Keys:
    """Return where the body points."""
    return [key for start_s, before, after in line.turns for key in ((start_s, before), (start_s + TURN_S, after))]


def phase_keys(line: Timeline, step_s: float) -> list[tuple[float, Floats]]:
    """Return the start of everything in which there are steps, and when each ends since then, the start included."""
    walks = [(start_s, walked.time_s) for start_s, walked, _ in line.walks]
    count = max(2, round(TURN_S / step_s))
    stepping_s = np.array([TURN_S * i / count for i in range(count + 1)])
    return walks + [(start_s, stepping_s) for start_s, _, _ in line.turns]


def curve(keys: Keys, duration_s: float) -> Curve:
    """Return the smooth curve through keys; equal ones in a row are a rest, and it holds its ends."""
    first, last = (keys[0][1], keys[-1][1]) if keys else (0.0, 0.0)
    whole = [(0.0, first), *keys, (duration_s, last)]
    distinct = [whole[0], *(b for a, b in pairwise(whole) if b[0] > a[0])]
    time_s, value = np.array(distinct).T
    return Curve(time_s, value[:, None])


def one(curve: Curve, time_s: Floats) -> Jet:
    """Return a curve of one value."""
    return Jet(*(column[:, 0] for column in curve.at(time_s)))

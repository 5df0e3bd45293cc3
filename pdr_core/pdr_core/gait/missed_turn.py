"""What a foot turns from its stand to the gyro's first rate, or from the last one to its stand: signs and habits.

A foot leaves its stand faster and faster, much like a growing exponential: what it has turned when the gyro wakes is a
time constant times the rate w that the gyro finds, in the foot's own axes. Other signs add up to it, each a vector:

    turn = habit + sum of slope * sign + noise,       noise ~ (0, sd^2) about each axis.

The slopes are those of a least-squares plane that the three axes share. A stumble or a shuffle is no habit: strides
that are farther away than `FAR` times the median are left out of it, though not of the noise.

When the foot turns counts as well: one that tips too early feels gravity push it for longer. So the mean time of the
turns from the gyro's edge is learnt.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.records import Floats

LEAST, MOST = 8, 256  # turns that must be known, and that are remembered
FAR = 2.5


class Missed(NamedTuple):
    """What a foot has turned."""

    turn_rad: Floats  # (3,) in the axes of the foot
    sd_rad: float  # about each axis
    mean_time_s: float = 0.0  # of the turn, from the edge of the gyro


class Plane(NamedTuple):
    """What was learnt."""

    habit_rad: Floats  # (3,)
    slopes: Floats  # (signs,)


class MissedTurn:
    """Learns one of the two turns while the gyro is on all the time, and tells it when it is not."""

    def __init__(self) -> None:
        self._signs: list[Floats] = []
        self._turns: list[Floats] = []
        self._moments = self._squares = 0.0  # sums over all turns
        self._learnt: tuple[Plane, float] | None = None  # from these, with the noise

    def learn(self, signs: Floats, turn_rad: Floats, moment_rads: Floats) -> None:
        """Take the signs (signs, 3) of a turn, each a vector in the axes of the foot, and the turn (3,).

        `moment_rads` (3,): the sum of turn times time from the gyro's edge.
        """
        self._moments += float(moment_rads @ turn_rad)
        self._squares += float(turn_rad @ turn_rad)
        self._signs, self._turns = [*self._signs, signs][-MOST:], [*self._turns, turn_rad][-MOST:]
        self._learnt = None

    @property
    def ready(self) -> bool:
        """Return whether enough turns are known to tell others, and how well."""
        return len(self._signs) >= LEAST

    def told(self, signs: Floats) -> Missed:
        """Return what a foot has turned that shows these signs (signs, 3); ValueError: too little was learnt."""
        if not self.ready:
            raise ValueError("too few turns were learnt to tell one")
        if self._learnt is None:
            self._learnt = fitted(np.array(self._signs), np.array(self._turns))
        plane, sd_rad = self._learnt
        mean_time_s = self._moments / self._squares if self._squares > 0.0 else 0.0
        return Missed(plane.habit_rad + plane.slopes @ signs, sd_rad, mean_time_s)


class Pivot:
    """What is usual of turns about the vertical, (n,) [rad]; those that are far from the median do not count."""

    def __init__(self, turns_rad: Floats) -> None:
        away = np.abs(turns_rad - np.median(turns_rad))
        near = turns_rad[away <= FAR * np.median(away)]
        self.mean_rad, self.sd_rad = float(near.mean()), float(near.std())


def fitted(signs: Floats, turns_rad: Floats) -> tuple[Plane, float]:
    """Return the plane through most of the turns (n, 3), and the deviation of all of them from it about each axis."""
    far = np.linalg.norm(residuals(through(signs, turns_rad), signs, turns_rad), axis=1)
    near = far <= FAR * np.median(far)
    plane = through(signs[near], turns_rad[near])
    left = residuals(plane, signs, turns_rad)
    return plane, float(np.sqrt((left**2).sum() / (3 * len(left) - 3 - len(plane.slopes))))


def through(signs: Floats, turns_rad: Floats) -> Plane:
    """Return the least-squares plane; `signs` (n, signs, 3)."""
    mean, turn = signs.mean(axis=0), turns_rad.mean(axis=0)
    spread = (signs - mean).transpose(0, 2, 1).reshape(-1, signs.shape[1])
    slopes = np.linalg.lstsq(spread, (turns_rad - turn).ravel(), rcond=None)[0]
    return Plane(turn - slopes @ mean, slopes)


def residuals(plane: Plane, signs: Floats, turns_rad: Floats) -> Floats:
    """Return what the plane leaves over, (n, 3)."""
    return turns_rad - plane.habit_rad - np.einsum("k,nki->ni", plane.slopes, signs)

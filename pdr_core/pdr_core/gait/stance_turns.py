"""By how much a foot turns while its gyro sleeps: the gyro goes off behind the heel and on behind the toe.

**Leaving its stand** the foot shows by two signs how far it has turned when the gyro wakes (`missed_turn.py`): by the
rate that the gyro finds, and by the force. Of a foot that only turns by the angle t, up moves in its axes from u to
u - t x u. So with s for the specific force of the stand and f for that of the last `SHOWS_NS` before the gyro wakes,

    f x s / |s|^2 = t - (t u) u,

its tilt; a foot that speeds up besides shows a share of it. The slopes are much the same in all walks: 0.067 to 0.081 s
and 0.24 to 0.32; with the rate alone the tilt is off by twice as much.

**Coming to its stand** it turns by a habit and by the rate that the gyro saw last, and then it is level.

**About the vertical** both turns are habits: as a person sets the foot down, and pivots on it. They do not depend on
the turns of the strides. What counts is the twist of the whole turn about the up of the stand, for the way to a tilt
matters: of two turns by an angle b, whose tilts at their ends differ by a across it, the twists differ by a tan(b / 2),
as much as the habit itself. So where the signs leave the landing foot askew, its twist is that of the turn with which
the filter will have levelled it. Up at the last rate is known from the stand before, by the rates since.

A foot is level soon after it has landed; later its heel rises slowly, and the stillest part of all comes to lie there.
So the landing is levelled by the part that is stillest before that one; what the foot turns between both is its habit.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from pdr_core.conventions import NANOSECONDS
from pdr_core.gait.missed_turn import LEAST, MOST, Missed, MissedTurn, Pivot
from pdr_core.gait.stands import stillest
from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import Four, conjugate, from_rotation_vector, multiply, rows, to_rotation_vector
from pdr_core.maths.swing_twist import shortest_turn, twist_rad
from pdr_core.maths.vector import cross, rotated, row, scaled
from pdr_core.records import Floats, ImuBlock, Stamps, length

LIFT_NS = 250_000_000  # before the first rate: in that time the foot leaves its stand
LAND_NS = 200_000_000  # after the last one: then it stands
STILL_NS = 75_000_000  # the foot is levelled over the stillest part of a sleep that is so long
SHOWS_NS = 30_000_000  # before the first rate: there the force shows how far the foot is tipped
TIPPED_RAD = 0.15  # how uncertain the filter takes the tilt for: what is told, and when within the turn it turns
UNKNOWN = Missed(np.zeros(3), np.pi)


class Stand(NamedTuple):
    """Where a foot stands within a sleep, whose first and last samples are awake."""

    row: int
    force_mps2: Floats  # (3,) that it feels there
    up: Floats  # (3,) of unit length


class Stride(NamedTuple):
    """From stand to stand, with the gyro on: turns in the axes that the foot has when they begin, and their signs."""

    up: Floats  # (3,) in the stand before
    lift_signs: Floats
    lift: Four
    swing: Four
    rate_radps: Floats  # (3,) the last one
    land: Four  # from there to the stand after
    flat: Stand
    stands: Stand


class StanceTurns:
    """Learns both turns from whole sleeps that would have been, and tells them."""

    def __init__(self) -> None:
        self._landing, self._lifting = MissedTurn(), MissedTurn()
        self._lifted: tuple[Floats, Floats, Four] | None = None  # up, signs and turn of the last lift
        self._strides: list[Stride] = []
        self._pivot: Pivot | None = None  # of these
        self._told = 0  # strides since then

    @property
    def ready(self) -> bool:
        """Enough was learnt to let the gyro sleep."""
        return self._lifting.ready and len(self._strides) >= LEAST

    @property
    def share_about_up(self) -> float:
        """The share of the noise of a turn that acts about the vertical.

        The mean of n strides is off by itself, and k strides are off by k times as much: with s for the deviation of
        one, their variance is s^2 (k + k^2 / n), and that of the last one of them s^2 (1 + 2 k / n).
        """
        if not self.ready:
            return 1.0
        shared = sqrt(1.0 + 2.0 * self._told / len(self._strides))
        return min(1.0, shared * self._usual.sd_rad / (sqrt(2.0) * TIPPED_RAD))

    def learn(self, slept: ImuBlock, swing: Four | None) -> None:
        """Take a sleep with its rates, less their bias, from the last sample before it to the first one after it.

        `swing`: the turn from the first rate after the sleep before; None: nobody knows it.
        """
        stands, last, rates = stand(slept), length(slept) - 1, slept.gyro_radps
        flat = stand(slept, stands.row)
        near = min(flat.row, int(np.searchsorted(slept.stamp_ns, slept.stamp_ns[0] + LAND_NS)))
        leaves = max(stands.row, int(np.searchsorted(slept.stamp_ns, slept.stamp_ns[-1] - LIFT_NS)))
        land, lift = turned(slept.stamp_ns, rates, 0, flat.row), turned(slept.stamp_ns, rates, stands.row, last)
        signs = lift_signs(slept, stands)
        self._landing.learn(rates[:1], np.array(to_rotation_vector(land)), moment_rads(slept, 0, near, 0))
        self._lifting.learn(signs, np.array(to_rotation_vector(lift)), moment_rads(slept, leaves, last, last))
        if self._lifted and swing:
            to_stand = turned(slept.stamp_ns, rates, 0, stands.row)
            self._strides = [*self._strides, Stride(*self._lifted, swing, rates[0], to_stand, flat, stands)][-MOST:]
        self._lifted, self._pivot, self._told = (stands.up, signs, lift), None, 0

    def landing(self, rate_radps: Floats, up: Floats, flat: Stand) -> Missed:
        """Return the turn from the last rate (3,), where up is known (3,), to a stand."""
        if not self.ready:
            return UNKNOWN
        self._told += 1
        return self._land(rate_radps, up, flat, self._usual.mean_rad)

    def lifting(self, slept: ImuBlock, stands: Stand) -> Missed:
        """Return the turn from the stand in a sleep to the first rate, its last sample; rates less their bias."""
        return self._lift(lift_signs(slept, stands), stands.up) if self.ready else UNKNOWN

    def _lift(self, signs: Floats, up: Floats) -> Missed:
        told = self._lifting.told(signs)
        turn = from_rotation_vector(told.turn_rad)
        return with_turn(told, about(up, -twist_rad(turn, up), turn))

    def _land(self, rate_radps: Floats, up: Floats, flat: Stand, twist: float) -> Missed:
        told = self._landing.told(rate_radps[None])
        turn = from_rotation_vector(told.turn_rad)
        level = multiply(shortest_turn(rotated(rows(turn), flat.up), up), turn)
        return with_turn(told, about(up, twist - twist_rad(level, up), turn))

    @property
    def _usual(self) -> Pivot:
        if self._pivot is None:
            self._pivot = Pivot(np.array([self._left(stride) for stride in self._strides]))
        return self._pivot

    def _left(self, stride: Stride) -> float:
        """Return by how much the stride turns about the vertical beyond what is told without a pivot."""
        lift = from_rotation_vector(self._lift(stride.lift_signs, stride.up).turn_rad)
        before = multiply(lift, stride.swing)
        up = np.array(rotated(rows(conjugate(before)), stride.up))
        land = from_rotation_vector(self._land(stride.rate_radps, up, stride.flat, 0.0).turn_rad)
        told = levelled(multiply(before, land), stride)
        true = levelled(multiply(multiply(stride.lift, stride.swing), stride.land), stride)
        return float(twist_rad(multiply(true, conjugate(told)), stride.up))


def levelled(turn: Four, stride: Stride) -> Four:
    """Return a turn from stand to stand as a filter will have levelled it."""
    return multiply(shortest_turn(rotated(rows(turn), stride.stands.up), stride.up), turn)


def with_turn(told: Missed, turn: Four) -> Missed:
    """Return what was told with another turn, and as uncertain as the filter is to take it."""
    return Missed(np.array(to_rotation_vector(turn)), TIPPED_RAD, told.mean_time_s)


def stand(slept: ImuBlock, before: int | None = None) -> Stand:
    """Return where the foot is stillest, or was before a row of the sleep."""
    rows = stillest(slept, 1, max(2, length(slept) - 1 if before is None else before), STILL_NS)
    force_mps2 = slept.accel_mps2[rows].mean(axis=0)
    return Stand((rows.start + rows.stop) // 2, force_mps2, force_mps2 / np.linalg.norm(force_mps2))


def lift_signs(slept: ImuBlock, stands: Stand) -> Floats:
    """Return what shows how far a foot has turned from its stand to the last sample, (2, 3): rate, tilt by force."""
    first = int(np.searchsorted(slept.stamp_ns, slept.stamp_ns[-1] - SHOWS_NS))
    tilt = np.array(cross(slept.accel_mps2[first:].mean(axis=0), stands.force_mps2))
    return np.array([slept.gyro_radps[-1], tilt / float(stands.force_mps2 @ stands.force_mps2)])


def moment_rads(slept: ImuBlock, first: int, last: int, edge: int) -> Floats:
    """Return the sum (3,) of turn times time from an edge, over the rows first:last."""
    away_s = np.abs(slept.stamp_ns[first:last] - slept.stamp_ns[edge]) / NANOSECONDS
    return np.asarray((away_s * np.diff(slept.stamp_ns[first : last + 1]) / NANOSECONDS) @ slept.gyro_radps[first:last])


def whole(imu: ImuBlock) -> Four:
    """Return the turn from the first sample to the last one; rates less their bias."""
    return turned(imu.stamp_ns, imu.gyro_radps, 0, length(imu) - 1)


def carried(up: Floats, imu: ImuBlock) -> Floats:
    """Return in the axes of the foot at the last sample what is up (3,) at the first; rates less their bias."""
    return np.array(rotated(rows(conjugate(whole(imu))), up))


@compiled
def about(axis: Floats, angle_rad: float, turn: Four) -> Four:
    """Return a turn with another one about a unit axis before it, as the world sees both."""
    return multiply(from_rotation_vector((angle_rad * axis[0], angle_rad * axis[1], angle_rad * axis[2])), turn)


@compiled
def turned(stamp_ns: Stamps, rate_radps: Floats, first: int, last: int) -> Four:
    """Return the turn from sample `first` to sample `last`, in the axes that the foot had at first."""
    quat = (0.0, 0.0, 0.0, 1.0)
    for i in range(first, last):
        a, b = row(rate_radps, i), row(rate_radps, i + 1)
        both = (a[0] + b[0], a[1] + b[1], a[2] + b[2])
        quat = multiply(quat, from_rotation_vector(scaled(0.5e-9 * (stamp_ns[i + 1] - stamp_ns[i]), both)))
    return quat

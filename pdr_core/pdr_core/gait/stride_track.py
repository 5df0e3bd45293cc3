"""The track of strides and its covariance, compiled: what a stride, a stand and a heading make of it.

The formulas are derived in `dead_reckoning.py`.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdr_core.gait.between_steps import count, hold, move, room, write_stamps
from pdr_core.maths.circular import wrapped_rad
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import Innovation, correct, estimated_error, gain, innovation, normalised_squared
from pdr_core.maths.memory import Memory, record
from pdr_core.maths.quaternion import normalised, turned_about_up, yaw_rad
from pdr_core.maths.vector import inverse_positive, product
from pdr_core.params import DeadReckoningParams
from pdr_core.records import Floats, NavBlock

X, Y, Z, TILT, YAW, DEVIATION, SCALE, NORTH, SIZE = 0, 1, 2, 3, 5, 6, 7, 8, 9
HEADING_GATE = 9.0  # 3 standard deviations
TRACK = record(
    [
        ("stamp_ns", np.int64),
        ("position_m", np.float64, 3),
        ("quat_xyzw", np.float64, 4),  # world from foot
        ("P", np.float64, (SIZE, SIZE)),
        ("deviation", np.float64, 2),  # of the last stride, and its standard deviation [rad]
        ("north", np.float64, 2),  # by how much the field of this neighbourhood is off, and how far it may be [rad]
        ("length_m", np.float64),  # of the last stride
    ],
)
# What is told of a stride, (9,): length, turn, deviation and heading, each with its standard deviation, and that which
# headings have in common. NaN: not known.
LENGTH, TURN, DEVIATED, HEADING, TOLD = 0, 2, 4, 6, 9


class TrackLimits(NamedTuple):
    """The parameters; compiled code takes them packed."""

    period_ns: int  # of the estimates between strides
    held_turn_sd_rad: float
    deviation_scatter_rad: float
    turn_scatter: float
    climb_sd_m: float
    tilt_sd_rad: float
    field_wander: float


def track_limits(p: DeadReckoningParams) -> TrackLimits:
    """Derive the limits from the parameters."""
    scatter = p.deviation_scatter_rad, p.turn_scatter
    period_ns = round(1e9 / p.odom_rate_hz)
    return TrackLimits(period_ns, p.held_turn_sd_rad, *scatter, p.climb_sd_m, p.tilt_sd_rad, p.field_wander)


@compiled
def stand(until_ns: int, limits: NDArray[Any], memory: NDArray[Any]) -> NavBlock:
    """Return the estimates of a foot that stands until a stamp."""
    s, p = memory[0], limits[0]
    nav = room(count(s.stamp_ns, until_ns, p.period_ns))
    write_pause(nav, nav.stamp_ns.shape[0], until_ns, p, s)
    return nav


@compiled
def write_pause(nav: NavBlock, n: int, until_ns: int, p: TrackLimits, s: Memory) -> None:
    """Stand until a stamp, and write the n estimates until then."""
    write_stamps(nav, 0, n, s.stamp_ns, until_ns, p.period_ns)
    hold(nav, 0, n, s)
    s.stamp_ns = max(s.stamp_ns, until_ns)


@compiled
def stride(
    start_ns: int, stamp_ns: int, told: Floats, limits: NDArray[Any], memory: NDArray[Any]
) -> tuple[NavBlock, int, Floats, Floats, bool, bool]:
    """Take a stride of which is told, (TOLD,); return what came of it.

    That is: the estimates since the last stride, the stamp at which it begins, its displacement (3,) and the covariance
    of that, (3, 3), whether something of it was no number, and whether the heading contradicts the track.
    """
    s, p = memory[0], limits[0]
    usable, before_m, before_xyzw, before_P = make_usable(told, p, s), *pose(s)
    standing_ns = max(s.stamp_ns, start_ns)
    begin_ns = standing_ns if stamp_ns > standing_ns else start_ns  # the clock may jump back
    pause, moving = count(s.stamp_ns, start_ns, p.period_ns), count(begin_ns, stamp_ns, p.period_ns)
    nav = room(pause + moving)
    write_pause(nav, pause, start_ns, p, s)
    take_over(told[DEVIATED : DEVIATED + 2], s)
    covariance_m2 = walk(told, p, s)
    doubted = bool(np.all(np.isfinite(told[HEADING:]))) and see(told[HEADING:], p, s)
    s.stamp_ns = stamp_ns
    write_stamps(nav, pause, pause + moving, begin_ns, stamp_ns, p.period_ns)
    move(nav, pause, begin_ns, before_m, before_xyzw, before_P, s)
    return nav, begin_ns, s.position_m - before_m, covariance_m2, usable, doubted


@compiled
def pose(s: Memory) -> tuple[Floats, Floats, Floats]:
    """Return copies of the position, the attitude and their covariance, (6, 6)."""
    return s.position_m.copy(), s.quat_xyzw.copy(), s.P[:DEVIATION, :DEVIATION].copy()


@compiled
def make_usable(told: Floats, p: TrackLimits, s: Memory) -> bool:
    """Put numbers in the place of what is none; return whether all were numbers."""
    usable = bool(np.all(np.isfinite(told[:HEADING])))
    if not np.all(np.isfinite(told[LENGTH : LENGTH + 2])):
        told[LENGTH : LENGTH + 2] = s.length_m
    if not np.all(np.isfinite(told[TURN : TURN + 2])):
        told[TURN], told[TURN + 1] = 0.0, p.held_turn_sd_rad
    if not np.all(np.isfinite(told[DEVIATED : DEVIATED + 2])):
        told[DEVIATED : DEVIATED + 2] = s.deviation
    s.length_m = told[LENGTH]
    return usable


@compiled
def take_over(deviation: Floats, s: Memory) -> None:
    """Another deviation is known by itself: its error has nothing to do with that of the one before."""
    if deviation[0] != s.deviation[0] or deviation[1] != s.deviation[1]:
        s.deviation[:] = deviation
        forget(DEVIATION, s)
        s.P[DEVIATION, DEVIATION] = deviation[1] ** 2


@compiled
def forget(i: int, s: Memory) -> None:
    """Know nothing in common of an error and the others."""
    s.P[i] = 0.0
    s.P[:, i] = 0.0


@compiled
def walk(told: Floats, p: TrackLimits, s: Memory) -> Floats:
    """Go the stride; return the covariance (3, 3) of its displacement."""
    length_m, turn_rad, turn_sd_rad = told[LENGTH], told[TURN], told[TURN + 1]
    direction_rad = yaw_rad(s.quat_xyzw) + 0.5 * turn_rad + s.deviation[0]
    ahead = np.cos(direction_rad), np.sin(direction_rad)
    across = -length_m * ahead[1], length_m * ahead[0]
    change = np.zeros((SIZE, SIZE))  # of the errors: F - I
    noise = np.zeros((SIZE, 4))  # length, turn, direction of the stride, climb
    scatter_rad = np.hypot(p.deviation_scatter_rad, p.turn_scatter * turn_rad)
    for axis in range(2):
        change[axis, YAW], change[axis, DEVIATION], change[axis, SCALE] = (
            across[axis],
            across[axis],
            length_m * ahead[axis],
        )
        noise[axis, 0], noise[axis, 1] = ahead[axis] * told[LENGTH + 1], 0.5 * across[axis] * turn_sd_rad
        noise[axis, 2] = across[axis] * scatter_rad
        s.position_m[axis] += length_m * ahead[axis]
    noise[YAW, 1], noise[Z, 3] = turn_sd_rad, p.climb_sd_m
    covariance_m2 = carry(change, product(noise, noise.T), s)
    stand_anew(p.tilt_sd_rad, s)
    turn_by(turn_rad, s)
    return covariance_m2


@compiled
def carry(change: Floats, Q: Floats, s: Memory) -> Floats:
    """Replace P by F P F' + Q with F = I + change; return the part of change P change' + Q that a position has."""
    moved = product(change, s.P)
    both = product(change, moved.T) + Q  # P is symmetric
    for i in range(SIZE):
        for j in range(SIZE):
            s.P[i, j] += moved[i, j] + moved[j, i] + both[i, j]
    return both[:TILT, :TILT].copy()


@compiled
def stand_anew(tilt_sd_rad: float, s: Memory) -> None:
    """Let the foot stand tilted as before but for how places differ, which nobody measures."""
    tilt = s.P[TILT:YAW, TILT:YAW] + np.eye(2) * tilt_sd_rad**2
    forget(TILT, s)
    forget(TILT + 1, s)
    s.P[TILT:YAW, TILT:YAW] = tilt if tilt[0, 0] + tilt[1, 1] < 1.0 else 0.5 * np.eye(2)


@compiled
def turn_by(turn_rad: float, s: Memory) -> None:
    """Turn the foot about the vertical."""
    s.quat_xyzw[:] = normalised(turned_about_up(s.quat_xyzw, turn_rad))


@compiled
def see(heading: Floats, p: TrackLimits, s: Memory) -> bool:
    """Correct the track by a heading that the field tells: yaw + north's error + that of this place.

    One that contradicts counts less (Huber); left out, a track that has missed a turn would never come back. Returns
    whether it does.
    """
    let_north_wander(heading[2], p.field_wander, s)
    y = seen(heading[0] - yaw_rad(s.quat_xyzw) - s.north[0], heading[1] ** 2, s)
    doubted = normalised_squared(y) > HEADING_GATE
    if doubted:  # as uncertain as it would have to be
        S = y.residual.reshape(1, 1) ** 2 / HEADING_GATE
        y = Innovation(y.residual, y.HP, S, inverse_positive(S))
    correct_track(y, s)
    return doubted


@compiled
def take_heading(yaw_error_rad: float, yaw_error_sd_rad: float, memory: NDArray[Any]) -> None:
    """Correct the track by how much it is turned too far, which somebody else knows."""
    s = memory[0]
    H = np.zeros((1, SIZE))
    H[0, YAW] = 1.0
    correct_track(innovation(s.P, H, np.full((1, 1), yaw_error_sd_rad**2), np.full(1, -yaw_error_rad)), s)


@compiled
def seen(residual_rad: float, variance: float, s: Memory) -> Innovation:
    """Return what a heading says of yaw and north."""
    H = np.zeros((1, SIZE))
    H[0, YAW] = H[0, NORTH] = 1.0
    return innovation(s.P, H, np.full((1, 1), variance), np.full(1, wrapped_rad(residual_rad)))


@compiled
def correct_track(y: Innovation, s: Memory) -> None:
    """Correct the track by what was measured of its yaw, and what is known of north with it."""
    K = gain(y)
    error = estimated_error(K, y)
    correct(s.P, K, y)
    s.position_m[:] += error[:TILT]
    turn_by(error[YAW], s)
    s.north[0] = wrapped_rad(s.north[0] + error[NORTH])


@compiled
def let_north_wander(common_sd_rad: float, wander: float, s: Memory) -> None:
    """Let the error that places have in common change from stride to stride; another kind of field has another.

    It is a first-order Gauss-Markov process, whose deviation stays: farther on a building bends a field no more.
    """
    if common_sd_rad != s.north[1]:
        s.north[0], s.north[1] = 0.0, common_sd_rad
        forget(NORTH, s)
        s.P[NORTH, NORTH] = common_sd_rad**2
    else:
        kept = np.sqrt(1.0 - wander**2)
        s.P[NORTH] *= kept
        s.P[:, NORTH] *= kept
        s.P[NORTH, NORTH] += (wander * common_sd_rad) ** 2
        s.north[0] *= kept

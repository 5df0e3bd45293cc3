"""Estimates between dead reckoned steps, at an even rate: held while the foot stands, linear in a stride.

Nobody sees the foot in its swing, so the covariance says how far a real one is off the straight and even way: it
stands for the first half of a stride, from ground hit to heel off, and catches up with up to four times the mean
speed, lifted by a decimetre and tipped by half a radian. The angular rates of a gyro that is off are unknown.
"""

import numpy as np

from pdr_core.conventions import UNKNOWN_RATE_SD_RADPS
from pdr_core.maths.compiled import compiled
from pdr_core.maths.memory import Memory
from pdr_core.maths.quaternion import rows, turn_about_up_rad, turned_about_up
from pdr_core.maths.vector import Triple, added, difference, norm, rotated, scaled, transposed
from pdr_core.records import Floats, NavBlock

NANO = 1e-9
LONGEST_NS = 600_000_000_000  # a longer time than any pause: the clock has jumped, and only the end gets an estimate
SQUARE = 36  # numbers of a pose's covariance, in a row: so they are computed several at once
BEHIND = 0.35  # standard deviation in the middle of a stride, share of its length
LIFTED_M = 0.05
TIPPED_RAD = 0.5
SPEED_SHARE = 1.4  # of a foot that stands for 0.6 of a stride and moves like half a sine: deviation over mean speed
STANDING_MPS = 0.02


@compiled
def count(start_ns: int, end_ns: int, period_ns: int) -> int:
    """Return how many stamps come after the start, a period apart, and the end; none if it is not after the start."""
    passed_ns = end_ns - start_ns
    if passed_ns > LONGEST_NS:
        return 1
    return (passed_ns - 1) // period_ns + 1 if passed_ns > 0 else 0


@compiled
def room(n: int) -> NavBlock:
    """Return room for n estimates, without rates, and whose twists are uncertain alike along all axes."""
    shapes = np.empty((n, 3)), np.empty((n, 4)), np.empty((n, 3)), np.zeros((n, 3)), np.empty((n, 6, 6))
    return NavBlock(np.empty(n, np.int64), *shapes, np.zeros((n, 6, 6)))


@compiled
def write_stamps(nav: NavBlock, first: int, last: int, start_ns: int, end_ns: int, period_ns: int) -> None:
    """Write the stamps of the rows first:last: a period apart from the start on, and the end."""
    for i in range(first, last):
        nav.stamp_ns[i] = end_ns if i == last - 1 else start_ns + (i - first + 1) * period_ns


@compiled
def hold(nav: NavBlock, first: int, last: int, s: Memory) -> None:
    """Write the estimates first:last of a foot that stands; `s` is a TRACK of `stride_track.py`."""
    for i in range(first, last):
        nav.position_m[i] = s.position_m
        nav.quat_xyzw[i] = s.quat_xyzw
        nav.velocity_mps[i] = 0.0
        nav.pose_covariance[i] = s.P[:6, :6]
    write_twists(nav, first, last, STANDING_MPS)


@compiled
def move(nav: NavBlock, first: int, start_ns: int, before_m: Floats, before_xyzw: Floats, P: Floats, s: Memory) -> None:
    """Write the estimates from row `first` on of a foot on its way to where `s` has it at the last stamp.

    `before_m`, `before_xyzw` and `P`, (6, 6), are the pose at the start and its covariance.
    """
    n = nav.stamp_ns.shape[0]
    if n == first:
        return
    duration_ns = nav.stamp_ns[n - 1] - start_ns
    turn_rad = turn_about_up_rad(before_xyzw, s.quat_xyzw)
    change_m = difference(s.position_m, before_m)
    velocity_mps = scaled(1.0 / (duration_ns * NANO), change_m)
    sd_mps = np.hypot(SPEED_SHARE * norm(velocity_mps), STANDING_MPS)
    swing = swing_variances(change_m)
    covariances, before, after = nav.pose_covariance.reshape(n, SQUARE), P.ravel(), s.P[:6, :6].copy().ravel()
    for i in range(first, n):
        share = (nav.stamp_ns[i] - start_ns) / duration_ns
        nav.position_m[i] = added(before_m, scaled(share, change_m))
        nav.quat_xyzw[i] = turned_about_up(before_xyzw, share * turn_rad)
        nav.velocity_mps[i] = rotated(transposed(rows(nav.quat_xyzw[i])), velocity_mps)
        covariances[i] = (1.0 - share) * before + share * after
        for j in range(5):
            nav.pose_covariance[i, j, j] += 4.0 * share * (1.0 - share) * swing[j]
    write_twists(nav, first, n, sd_mps)


@compiled
def swing_variances(change_m: Triple) -> tuple[float, float, float, float, float]:
    """Return the variances of a foot in the middle of its swing about the even way: of its place, roll and pitch."""
    x, y, lifted, tipped = BEHIND * change_m[0], BEHIND * change_m[1], LIFTED_M**2, TIPPED_RAD**2
    return x**2 + lifted, y**2 + lifted, lifted, tipped, tipped


@compiled
def write_twists(nav: NavBlock, first: int, last: int, sd_mps: float) -> None:
    """Write for the rows first:last that the velocity is as uncertain along all axes, and the rate unknown."""
    for axis in range(3):
        nav.twist_covariance[first:last, axis, axis] = sd_mps**2
        nav.twist_covariance[first:last, 3 + axis, 3 + axis] = UNKNOWN_RATE_SD_RADPS**2

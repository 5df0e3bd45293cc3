"""The body between the feet: where it is, where it looks and how well that is known.

`base_footprint` lies on the floor midway between the feet (REP-120). With p the positions of both feet, P the larger
part of their covariances, d0 the expected place of the left foot seen from the right one, and S how far the real one
is from it,

    g = (P_r - P_l) / (P_l + P_r + S),     body = (1 + g) / 2 p_l + (1 - g) / 2 p_r - g d0 / 2.

That is what one measurement "p_l - p_r = d0, with the noise S" makes of the middle: feet that are known equally well
count alike, and the body follows the better one as the other gets lost (g = 1: only the left one is left).

The errors of the feet are correlated, nobody knows how much: what the heading fusion tells one it tells the other. So
the covariance of the sum is not that of independent errors but the bound that holds for any correlation (covariance
intersection, Julier and Uhlmann 1997): with A the covariance of what each foot contributes, A_l / w + A_r / (1 - w),
smallest at w = sqrt(tr A_l) / (sqrt(tr A_l) + sqrt(tr A_r)). Two feet alike then tell no more than one. One error is
known to be opposite: that of half the angle between the worlds of both feet. It goes out of the middle.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.quaternion import from_euler, rows, yaw_rad
from pdr_core.maths.vector import Matrix, Triple, difference, product, rotated
from pdr_core.records import Flags, Floats, NavBlock

STANDING_MPS = 0.3  # of two feet the one that is slower than this stands: it says where the floor is and where to
LEVEL_VARIANCE = 1e-6  # of roll and pitch, which are none
SWING_SD_MPS = 0.7  # by how much the speed of one foot differs from that of the body
X, Y, Z, YAW, SIZE = 0, 1, 2, 3, 4
AXES = (0, 1, 2, 5)  # of them among the six of a covariance


class Frame(NamedTuple):
    """Where a foot's own world lies in the body's: turned by a yaw about where the foot stood at the start."""

    start_m: Triple  # of the foot in its own world
    place_m: Triple  # where that is in the body's world
    place_sd_m: float  # how well that is known
    yaw_rad: float  # body's world from the foot's
    yaw_sd_rad: float  # how well that is known, by itself
    halved_sd_rad: float  # and by how much it may be too large for the left foot, and as much too small for the right
    toe_rad: float  # by how much a standing foot points to the left of the way the person walks
    toe_sd_rad: float


class Gait(NamedTuple):
    """What is known beforehand of a person's feet."""

    width_m: float  # distance of standing feet
    apart_sd_m: float  # by how much the feet of a walking person are elsewhere


class Moved(NamedTuple):
    """One foot in the body's world: x, y, z and yaw, their rates, and the covariances of both."""

    pose: Floats  # (4,)
    rate: Floats  # (4,)
    pose_covariance: Floats  # (4, 4) without what follows
    halved: Floats  # (4,) what the error moves that has the opposite sign for the other foot
    rate_covariance: Floats  # (4, 4)


def placed_m(frame: Frame, position_m: Floats) -> Floats:
    """Return positions (n, 3) of a foot's world in that of the body."""
    c, s = np.cos(frame.yaw_rad), np.sin(frame.yaw_rad)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return np.array(frame.place_m) + (position_m - np.array(frame.start_m)) @ turn.T


@compiled
def between(
    left: NavBlock, right: NavBlock, known: Flags, frames: tuple[Frame, Frame], gait: Gait, out: NavBlock
) -> None:
    """Write the body's estimates from those of the feet at the same n stamps; `known` (n, 2): which of them are."""
    for i in range(left.stamp_ns.shape[0]):
        a, b = moved(left, i, frames[0]), moved(right, i, frames[1])
        out.stamp_ns[i] = left.stamp_ns[i]
        write(combined(a, b, known[i, 0], known[i, 1], gait), i, out)


@compiled
def moved(nav: NavBlock, i: int, frame: Frame) -> Moved:
    """Return row i of a foot in the body's world, its yaw being that of the person."""
    c, s = np.cos(frame.yaw_rad), np.sin(frame.yaw_rad)
    R = rows(nav.quat_xyzw[i])
    velocity, rate = rotated(R, nav.velocity_mps[i]), rotated(R, nav.rate_radps[i])
    x, y, up = difference(nav.position_m[i], frame.start_m)
    pose, rates = np.empty(SIZE), np.empty(SIZE)
    pose[X], pose[Y] = frame.place_m[0] + c * x - s * y, frame.place_m[1] + s * x + c * y
    pose[Z] = frame.place_m[2] + up
    pose[YAW] = yaw_rad(nav.quat_xyzw[i]) + frame.yaw_rad - frame.toe_rad
    rates[X], rates[Y] = c * velocity[0] - s * velocity[1], s * velocity[0] + c * velocity[1]
    rates[Z], rates[YAW] = velocity[2], rate[2]
    turn = np.array([-(s * x + c * y), c * x - s * y, 0.0, 1.0])  # what an error of the frame's yaw moves
    of_pose = pose_covariance(nav.pose_covariance[i], turn, frame)
    of_rate = rate_covariance(nav.twist_covariance[i], R, c, s)
    return Moved(pose, rates, of_pose, turn * frame.halved_sd_rad, of_rate)


@compiled
def pose_covariance(covariance: Floats, turn: Floats, frame: Frame) -> Floats:
    """Return the covariance (4, 4) of x, y, z, yaw: that of the foot (6, 6), turned, and that of its frame.

    `turn` (4,) is what an error of the frame's yaw moves.
    """
    c, s = np.cos(frame.yaw_rad), np.sin(frame.yaw_rad)
    J = np.zeros((SIZE, 6))
    J[X, 0], J[X, 1], J[Y, 0], J[Y, 1], J[Z, 2], J[YAW, 5] = c, -s, s, c, 1.0, 1.0
    out = product(J, product(covariance, J.T))
    for j in range(SIZE):
        for k in range(SIZE):
            out[j, k] += turn[j] * turn[k] * frame.yaw_sd_rad**2
    out[X, X] += frame.place_sd_m**2
    out[Y, Y] += frame.place_sd_m**2
    out[YAW, YAW] += frame.toe_sd_rad**2
    return out


@compiled
def rate_covariance(covariance: Floats, R: Matrix, c: float, s: float) -> Floats:
    """Return the covariance (4, 4) of velocity and yaw rate in the body's world, from that in the foot's frame."""
    J = np.zeros((SIZE, 6))
    for j in range(3):
        J[X, j], J[Y, j], J[Z, j] = c * R[0][j] - s * R[1][j], s * R[0][j] + c * R[1][j], R[2][j]
        J[YAW, 3 + j] = R[2][j]
    return product(J, product(covariance, J.T))


@compiled
def combined(left: Moved, right: Moved, left_known: bool, right_known: bool, gait: Gait) -> Moved:
    """Return the body between two feet, of which one at least is known."""
    g = preference(left, right, left_known, right_known, gait)
    u = standing_share(left, right, left_known, right_known)
    v = yaw_share(u, left, right)
    of_left, of_right = (
        np.array([0.5 + 0.5 * g, 0.5 + 0.5 * g, u, v]),
        np.array([0.5 - 0.5 * g, 0.5 - 0.5 * g, 1 - u, 1 - v]),
    )
    turn = left.pose[YAW] - right.pose[YAW]
    pose = of_left * left.pose + of_right * right.pose
    pose[YAW] = right.pose[YAW] + v * (turn - 2.0 * np.pi * np.round(turn / (2.0 * np.pi)))
    pose[X] += 0.5 * g * gait.width_m * np.sin(pose[YAW])
    pose[Y] -= 0.5 * g * gait.width_m * np.cos(pose[YAW])
    share = 0.5 + 0.5 * g
    rate = share * left.rate + (1.0 - share) * right.rate
    even, halved = np.full(SIZE, share), of_left * left.halved - of_right * right.halved
    out = Moved(
        pose,
        rate,
        bound(of_left, left.pose_covariance, of_right, right.pose_covariance),
        halved,
        bound(even, left.rate_covariance, 1.0 - even, right.rate_covariance),
    )
    for j in range(SIZE):
        for k in range(SIZE):
            out.pose_covariance[j, k] += halved[j] * halved[k]
    for j in (X, Y):
        out.pose_covariance[j, j] += (0.5 * g * gait.apart_sd_m) ** 2
        out.rate_covariance[j, j] += (g * SWING_SD_MPS) ** 2
    return out


@compiled
def preference(left: Moved, right: Moved, left_known: bool, right_known: bool, gait: Gait) -> float:
    """Return g: 1 where the left foot alone counts, -1 where the right one alone does."""
    if not (left_known and right_known):
        return 1.0 if left_known else -1.0
    of_left = 0.5 * (left.pose_covariance[X, X] + left.pose_covariance[Y, Y])
    of_right = 0.5 * (right.pose_covariance[X, X] + right.pose_covariance[Y, Y])
    return (of_right - of_left) / (of_left + of_right + gait.apart_sd_m**2)


@compiled
def standing_share(left: Moved, right: Moved, left_known: bool, right_known: bool) -> float:
    """Return how much the left foot counts where a standing foot knows better: height and yaw."""
    if not (left_known and right_known):
        return 1.0 if left_known else 0.0
    of_left, of_right = stands(left), stands(right)
    return of_left / (of_left + of_right)


@compiled
def yaw_share(standing: float, left: Moved, right: Moved) -> float:
    """Return how much the left foot counts for the yaw: the standing foot, and the one whose yaw is known better."""
    of_left = standing * right.pose_covariance[YAW, YAW]
    of_right = (1.0 - standing) * left.pose_covariance[YAW, YAW]
    return of_left / (of_left + of_right)


@compiled
def stands(foot: Moved) -> float:
    """Return a weight that falls with the speed of a foot."""
    return 1.0 / (foot.rate[X] ** 2 + foot.rate[Y] ** 2 + foot.rate[Z] ** 2 + STANDING_MPS**2)


@compiled
def bound(of_left: Floats, left: Floats, of_right: Floats, right: Floats) -> Floats:
    """Return a covariance (4, 4) that holds for the sum of both weighted errors, however they are correlated."""
    a, b = np.empty((SIZE, SIZE)), np.empty((SIZE, SIZE))
    for j in range(SIZE):
        for k in range(SIZE):
            a[j, k], b[j, k] = of_left[j] * left[j, k] * of_left[k], of_right[j] * right[j, k] * of_right[k]
    root_a, root_b = np.sqrt(np.trace(a)), np.sqrt(np.trace(b))
    if root_a == 0.0 or root_b == 0.0:
        return a + b
    return a * ((root_a + root_b) / root_a) + b * ((root_a + root_b) / root_b)


@compiled
def write(body: Moved, i: int, out: NavBlock) -> None:
    """Write a body as row i: level, and the twist in its own frame, which the error of the yaw turns."""
    c, s = np.cos(body.pose[YAW]), np.sin(body.pose[YAW])
    ahead, left = c * body.rate[X] + s * body.rate[Y], c * body.rate[Y] - s * body.rate[X]
    q = from_euler(0.0, 0.0, body.pose[YAW])
    for j in range(4):
        out.quat_xyzw[i, j] = q[j]
    for j in range(3):
        out.position_m[i, j] = body.pose[j]
    out.velocity_mps[i, 0], out.velocity_mps[i, 1], out.velocity_mps[i, 2] = ahead, left, body.rate[Z]
    out.rate_radps[i, 2] = body.rate[YAW]
    J, by_yaw = np.eye(SIZE), np.array([left, -ahead, 0.0, 0.0]) * np.sqrt(body.pose_covariance[YAW, YAW])
    J[X, X], J[X, Y], J[Y, X], J[Y, Y] = c, s, -s, c
    twist = product(J, product(body.rate_covariance, J.T))
    for j in range(SIZE):
        for k in range(SIZE):
            out.pose_covariance[i, AXES[j], AXES[k]] = body.pose_covariance[j, k]
            out.twist_covariance[i, AXES[j], AXES[k]] = twist[j, k] + by_yaw[j] * by_yaw[k]
    for j in (3, 4):
        out.pose_covariance[i, j, j] = out.twist_covariance[i, j, j] = LEVEL_VARIANCE

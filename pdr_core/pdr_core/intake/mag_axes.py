"""How the axes of a magnetometer lie against those of the gyro: docs/magnetometer.md, "The axes"."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from pdr_core.conventions import GAP_NS, NANOSECONDS
from pdr_core.intake.mag_ellipsoid import ROBUST, deviation, inverse, repetition
from pdr_core.maths import quaternion
from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import mean, row, scaled
from pdr_core.records import Floats, ImuBlock, Stamps

WINDOW_S = 0.5  # between two fields that are compared
LARGEST_TURN_RAD = 2.0  # in a window
FEWEST = 50  # pairs
BIAS_WEIGHT = 0.5  # of one pair: a gyro bias of 0.05 rad/s counts like the noise of a field
SD_MAX_RAD = 0.0087  # 0.5 deg


class Axes(NamedTuple):
    """The rotation that turns rates from the gyro's axes into those in which the ellipsoid is a sphere."""

    R: Floats  # (3, 3)
    covariance: Floats  # (3, 3) [rad^2] of a small rotation in front of it


class Pairs(NamedTuple):
    """Fields at both ends of a window, of about length 1, and how the gyro turned between them."""

    before: Floats  # (n, 3)
    after: Floats  # (n, 3)
    turn: Floats  # (n, 3) 2 tan(angle / 2) along the axis
    duration_s: Floats  # (n,)


def found_axes(imu: ImuBlock, fields: Floats) -> Axes | None:
    """Return the axes that the gyro shows, None if it does not determine them. `fields`, (n, 3), of about length 1."""
    pairs = paired(imu, fields)
    if len(pairs.before) < FEWEST:
        return None
    R, bias = linear(pairs)

    def residual(p: Floats) -> Floats:
        return np.concatenate([mismatch(pairs, turned(p[:3]) @ R, p[3:]).ravel(), BIAS_WEIGHT * p[3:]])

    start = np.concatenate([np.zeros(3), bias])
    scale = ROBUST * deviation(residual(start))
    found = least_squares(residual, start, loss="soft_l1", f_scale=scale)
    rest = mismatch(pairs, turned(found.x[:3]) @ R, found.x[3:])
    covariance = inverse(found.jac.T @ found.jac) * deviation(rest) ** 2 * max(map(repetition, rest.T))
    if np.linalg.eigvalsh(covariance[:3, :3])[-1] > SD_MAX_RAD**2:
        return None
    return Axes(turned(found.x[:3]) @ R, covariance[:3, :3])


def mismatch(pairs: Pairs, R: Floats, bias: Floats) -> Floats:
    """Return by how much fields change otherwise than the gyro says, (n, 3), with its bias [rad/s] in their axes."""
    turn = pairs.turn @ R.T - pairs.duration_s[:, None] * bias
    return pairs.after - pairs.before - np.cross(0.5 * (pairs.before + pairs.after), turn)


def linear(pairs: Pairs) -> tuple[Floats, Floats]:
    """Return the rotation, (3, 3), and the bias, (3,), of least squares: the mismatch is linear in both."""
    halfway = cross_matrices(0.5 * (pairs.before + pairs.after))
    by_matrix = np.einsum("nij,nk->nijk", halfway, pairs.turn).reshape(-1, 9)
    by_bias = (-pairs.duration_s[:, None, None] * halfway).reshape(-1, 3)
    light = np.hstack([np.zeros((3, 9)), BIAS_WEIGHT * np.eye(3)])
    design = np.vstack([np.hstack([by_matrix, by_bias]), light])
    change = np.concatenate([(pairs.after - pairs.before).ravel(), np.zeros(3)])
    best = np.linalg.lstsq(design, change, rcond=None)[0]
    return nearest_rotation(best[:9].reshape(3, 3)), best[9:]


def paired(imu: ImuBlock, fields: Floats) -> Pairs:
    """Return every field with the one a window later, where the gyro has turned moderately and without a gap."""
    attitude, time_s, run = integrated(imu)
    there = np.flatnonzero(imu.field_sd_tesla >= 0.0)
    later = np.searchsorted(time_s[there], time_s[there] + WINDOW_S)
    a, b = there[later < len(there)], there[later[later < len(there)]]
    turn = (Rotation.from_quat(attitude[a]).inv() * Rotation.from_quat(attitude[b])).as_rotvec()
    angle = np.linalg.norm(turn, axis=1)
    lasted_s = time_s[b] - time_s[a]
    good = (run[a] == run[b]) & (lasted_s < 1.5 * WINDOW_S) & (angle < LARGEST_TURN_RAD)
    stretch = np.divide(np.tan(0.5 * angle), 0.5 * angle, out=np.ones_like(angle), where=angle > 1e-9)
    return Pairs(fields[a][good], fields[b][good], (turn * stretch[:, None])[good], lasted_s[good])


@compiled
def integrated(imu: ImuBlock) -> tuple[Floats, Floats, Stamps]:
    """Return attitude, (n, 4), from the gyro, time without jumps [s], (n,), and the number of gaps so far, (n,)."""
    n = imu.stamp_ns.shape[0]
    attitude, time_s, run = np.zeros((n, 4)), np.zeros(n), np.zeros(n, np.int64)
    attitude[:1, 3] = 1.0
    for i in range(1, n):
        step_ns = imu.stamp_ns[i] - imu.stamp_ns[i - 1]
        known = 0 < step_ns <= GAP_NS and imu.gyro_sd_radps[i] >= 0.0 and imu.gyro_sd_radps[i - 1] >= 0.0
        step_s = (step_ns if 0 < step_ns <= GAP_NS else GAP_NS) / NANOSECONDS
        rate = mean(row(imu.gyro_radps, i - 1), row(imu.gyro_radps, i))
        turn = quaternion.from_rotation_vector(scaled(step_s, rate))
        attitude[i] = quaternion.normalised(quaternion.multiply(attitude[i - 1], turn))
        time_s[i] = time_s[i - 1] + step_s
        run[i] = run[i - 1] + (0 if known else 1)
    return attitude, time_s, run


def turned(rotation_rad: Floats) -> Floats:
    """Return the matrix of a rotation vector."""
    return quaternion.matrix(quaternion.from_rotation_vector(rotation_rad))


def nearest_rotation(matrix: Floats) -> Floats:
    """Return the rotation that is nearest to a matrix (3, 3)."""
    U, _, Vt = np.linalg.svd(matrix)
    U[:, 2] *= np.linalg.det(U @ Vt)
    return U @ Vt


def cross_matrices(vectors: Floats) -> Floats:
    """Return [v x], (n, 3, 3), for each row."""
    out = np.zeros((len(vectors), 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        out[:, i, j], out[:, j, i] = -vectors[:, k], vectors[:, k]
    return out

"""What a calibration is worth: dip at rest, directions seen, and the error of the heading that it leaves."""

import numpy as np

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.intake.mag_axes import Axes, cross_matrices
from pdr_core.intake.mag_ellipsoid import COLUMNS, ROWS, Ellipsoid
from pdr_core.maths.magnetic import dip_rad
from pdr_core.records import Floats, ImuBlock

SLOW_RADPS, STEADY_MPS2 = 1.0, 0.5  # there the accelerometer shows gravity, a few degrees off
CELLS = 64  # of the sphere, for the coverage
LEAST_LEVEL = 0.05  # share of the field: at the poles nothing shows the heading
GOLDEN_RAD = np.pi * (3.0 - np.sqrt(5.0))


def dips_rad(imu: ImuBlock, field: Floats) -> Floats:
    """Return the dip of the fields, (n, 3) calibrated, of samples at which the accelerometer shows gravity."""
    slow = np.linalg.norm(imu.gyro_radps, axis=1) < SLOW_RADPS
    steady = np.abs(np.linalg.norm(imu.accel_mps2, axis=1) - STANDARD_GRAVITY_MPS2) < STEADY_MPS2
    rows = np.flatnonzero((imu.field_sd_tesla >= 0.0) & slow & steady)
    return np.array([dip_rad(imu.accel_mps2[i], field[i]) for i in rows])


def directions(n: int) -> Floats:
    """Return unit vectors, (n, 3), spread evenly over the sphere: a Fibonacci lattice."""
    z = 1.0 - (2.0 * np.arange(n) + 1.0) / n
    angle_rad = GOLDEN_RAD * np.arange(n)
    return np.column_stack([np.sqrt(1.0 - z * z) * np.cos(angle_rad), np.sqrt(1.0 - z * z) * np.sin(angle_rad), z])


def coverage(fields: Floats) -> float:
    """Return the share of all directions near which there are fields, (n, 3)."""
    return len(np.unique(np.argmax(fields @ directions(CELLS).T, axis=1))) / CELLS


def heading_sd_rad(ellipsoid: Ellipsoid, axes: Axes | None, dip: float) -> float:
    """Return the deviation of the heading by what is not known of the calibration, in the worst attitude.

    A small error e of a unit field u turns the heading by (its part along magnetic east) / cos(dip), and east may be
    any direction across u.
    """
    worst = 0.0
    for u in directions(CELLS):
        arm = np.linalg.solve(ellipsoid.shape, u)
        by_shape = np.zeros((3, 6))
        by_shape[ROWS, range(6)] = arm[COLUMNS]
        by_shape[COLUMNS[3:], range(3, 6)] = arm[ROWS[3:]]
        J = np.hstack([-ellipsoid.shape, by_shape])
        covariance = J @ ellipsoid.covariance @ J.T
        if axes:
            turn = cross_matrices(u[None])[0]
            covariance += turn @ axes.covariance @ turn.T
        across = np.eye(3) - np.outer(u, u)
        worst = max(worst, float(np.linalg.eigvalsh(across @ covariance @ across)[-1]))
    return float(np.sqrt(worst)) / max(LEAST_LEVEL, abs(np.cos(dip)))

"""The ellipsoid on which the fields of a turned magnetometer lie: docs/magnetometer.md, "The ellipsoid"."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from pdr_core.records import Floats

# the six entries of a symmetric matrix: rows and columns
ROWS, COLUMNS = np.array([0, 1, 2, 1, 0, 0]), np.array([0, 1, 2, 2, 2, 1])
ROBUST = 3.0  # standard deviations up to which a residual has about its full weight
MAD = 1.4826  # standard deviation of normal noise over its median magnitude
MOST_STEPS = 100  # ten are usual
SMALLEST_SD = 1e-9  # of the size: no noise, only rounding


class Ellipsoid(NamedTuple):
    """| shape (field - centre) | = radius."""

    centre_tesla: Floats  # (3,)
    shape: Floats  # (3, 3) symmetric, positive definite, determinant 1: the radius is the mean one
    radius_tesla: float
    residual_tesla: Floats  # (n,) distances of the fields from it
    covariance: Floats  # (9, 9) of centre / radius and the six entries of shape

    def sphere(self, field_tesla: Floats) -> Floats:
        """Return fields, (n, 3), on the unit sphere."""
        return (field_tesla - self.centre_tesla) @ self.shape / self.radius_tesla


def fitted(field_tesla: Floats) -> Ellipsoid | None:
    """Return the ellipsoid through fields, (n, 3), or None where they do not lie on one."""
    middle, size = field_tesla.mean(axis=0), field_tesla.std()
    fields = (field_tesla - middle) / size  # numbers of about 1
    start = algebraic(fields)
    best = geometric(fields, *start) if start else None
    if best is None:
        return None
    p, residual, covariance = best
    shape = symmetric(p[3:])
    scale = np.cbrt(np.linalg.det(shape))
    units = np.concatenate([np.full(3, scale), np.full(6, 1.0 / scale)])
    in_units = units[:, None] * covariance * units
    return Ellipsoid(middle + size * p[:3], shape / scale, float(size / scale), size * residual, in_units)


def algebraic(fields: Floats) -> tuple[Floats, Floats] | None:
    """Return centre and shape of the quadric x'Ex + 2 g'x + k = 0 of least squares; None if it is no ellipsoid.

    On it | shape (x - centre) | = 1.
    """
    design = np.column_stack([fields[:, ROWS] * fields[:, COLUMNS], fields, np.ones(len(fields))])
    design[:, 3:9] *= 2.0
    quadric = np.linalg.svd(design, full_matrices=False)[2][-1]
    E, g, k = symmetric(quadric[:6]), quadric[6:9], quadric[9]
    values, axes = np.linalg.eigh(E)
    if values[0] * values[2] <= 0.0:
        return None
    centre = -np.linalg.solve(E, g)
    squares = values / (centre @ E @ centre - k)  # of the inverse semi-axes
    return (centre, (axes * np.sqrt(squares)) @ axes.T) if squares.min() > 0.0 else None


def geometric(fields: Floats, centre: Floats, shape: Floats) -> tuple[Floats, Floats, Floats] | None:
    """Return the ellipsoid at the least distances from fields, (n, 3), those of outliers counting less.

    That is centre and six entries of shape, (9,), from those of one nearby; the distances; the covariance, (9, 9).
    None where there is no such ellipsoid.
    """

    def residual(p: Floats) -> Floats:
        return distance(fields, p[:3], symmetric(p[3:]))

    start = np.concatenate([centre, shape[ROWS, COLUMNS]])
    scale = ROBUST * deviation(residual(start))
    found = least_squares(residual, start, loss="cauchy", f_scale=scale, xtol=1e-12, max_nfev=MOST_STEPS)
    if not found.success or np.linalg.eigvalsh(symmetric(found.x[3:]))[0] <= 0.0:
        return None
    rest = residual(found.x)
    covariance = deviation(rest) ** 2 * repetition(rest) * inverse(found.jac.T @ found.jac)
    return found.x, rest, covariance


def distance(fields: Floats, centre: Floats, shape: Floats) -> Floats:
    """Return the distance, (n,), of fields from the ellipsoid | shape (field - centre) | = 1, to first order.

    Without the division, by how fast the length grows with the field, a fit to noise makes the shape too small.
    """
    sphere = (fields - centre) @ shape
    length = np.linalg.norm(sphere, axis=1)
    return (length - 1.0) * length / np.linalg.norm(sphere @ shape, axis=1)


def symmetric(entries: Floats) -> Floats:
    """Return the symmetric matrix of six entries."""
    out = np.empty((3, 3))
    out[ROWS, COLUMNS] = out[COLUMNS, ROWS] = entries
    return out


def deviation(residual: Floats) -> float:
    """Return the standard deviation of residuals without their outliers."""
    return max(SMALLEST_SD, MAD * float(np.median(np.abs(residual))))


def repetition(residual: Floats) -> float:
    """Return how many residuals in a row, (n,), tell as much as one: 1 + 2 (r1 + r2 + ...), while these are positive.

    r is the correlation with the residual so many places later. Source: Geyer 1992, initial positive sequence.
    """
    power, total = float(residual @ residual), 1.0
    for lag in range(1, len(residual) // 2):
        r = float(residual[lag:] @ residual[:-lag]) / power if power > 0.0 else 0.0
        if r <= 0.0:
            break
        total += 2.0 * r
    return total


def inverse(information: Floats) -> Floats:
    """Return the covariance of an information matrix; where nothing is known it is very large, not infinite."""
    return np.linalg.inv(information + 1e-18 * np.trace(information) * np.eye(len(information)))
